#include "stepping/parameters.h"

namespace pigment::stepping {

SteppingParameters read_stepping(config::Node node) {
  using P = SteppingParameters;
  P p;
  using I = P::Integrator;
  p.integrator = node.choice<I>("integrator", {{"auto", I::Automatic},
                                               {"explicit_euler", I::ExplicitEuler},
                                               {"explicit_midpoint", I::ExplicitMidpoint},
                                               {"linearly_implicit", I::LinearlyImplicit},
                                               {"newton_implicit", I::NewtonImplicit},
                                               {"extrapolated", I::Extrapolated},
                                               {"backward_differentiation", I::BackwardDifferentiation},
                                               {"convex_splitting", I::ConvexSplitting}}, "auto");
  if (node.has("time_step") && !node.is_word("time_step", "auto"))
    p.time_step = node.quantity("time_step", Dimension::Time, config::positive());
  else
    node.accept_word("time_step", "auto");
  p.tolerance = node.number("tolerance", 1e-2, config::strictly_between(0, 1));
  if (node.has("until") && !node.is_word("until", "auto"))
    p.until = node.quantity("until", Dimension::Time, config::positive());
  else
    node.accept_word("until", "auto");  // the end of the dewatering curve
  p.stop_when = node.choice<P::StopWhen>("stop_when", {{"immobile", P::StopWhen::Immobile}, {"stationary", P::StopWhen::Stationary}, {"until", P::StopWhen::Until}}, "immobile");
  if (node.has("solver_tolerance") && !node.is_word("solver_tolerance", "auto"))
    p.solver_tolerance = node.number("solver_tolerance", config::strictly_between(0, 1));
  else
    node.accept_word("solver_tolerance", "auto");
  p.immobile_rate = node.number("immobile_rate", 1e-2, config::strictly_between(0, 1));
  p.immobile_shrinkage = node.number("immobile_shrinkage", p.immobile_shrinkage, config::strictly_between(0, 1));
  if (p.stop_when == P::StopWhen::Stationary) {
    p.stationary_tolerance = node.number("stationary_tolerance", 0.02, config::strictly_between(0, 1));
    p.stationary_window = node.quantity("stationary_window", Dimension::Time, "1 s", config::positive());
  }
  p.protruding_limit = node.number("protruding_limit", 1e-2, config::strictly_between(0, 1));
  if (node.has("critical_pressure") && !node.is_word("critical_pressure", "auto"))
    p.critical_pressure = node.quantity("critical_pressure", Dimension::Pressure, config::positive());
  else
    node.accept_word("critical_pressure", "auto");
  return p;
}

double default_critical_pressure(const LiquidParameters& liquid) {
  constexpr double in_water = 5e3, water = 0.89;  // pN/um^2, mPa s at 25 degC
  return in_water * std::max(1.0, liquid_at(liquid, liquid.temperature).viscosity / water);
}

OutputParameters read_output(config::Node node) { return {node.quantity("every", Dimension::Time, "5 ms", config::positive())}; }

}  // namespace pigment::stepping
