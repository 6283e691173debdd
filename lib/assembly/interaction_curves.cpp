#include "assembly/interaction_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "resistance/scene_resistance.h"

namespace pigment::assembly {

namespace {

ResistanceScalars times(double mu, const resistance::PairScalars& k) {
  return {mu * k.squeeze, mu * k.twist, mu * k.shear, mu * k.pump, mu * k.shear_pump};
}
// side: +1 where the boundary's scalars are given for z away from it, -1 for z towards it.
ResistanceScalars times(double mu, const resistance::BoundaryScalars& k, int side) {
  return {mu * k.perpendicular, mu * k.twist, mu * k.parallel, mu * k.rolling, mu * (side * k.coupling)};
}

}  // namespace

InteractionEvaluator::InteractionEvaluator(const Interactions& interactions, const Liquid& liquid, Reach reach)
    : interactions_(interactions), viscosity_(liquid.viscosity) {
  if (reach == Reach::Untapered) interactions_.hydrodynamics.taper = resistance::no_taper;
  for (const auto& [name, law] : interactions.colloidal) laws_[name] = law->prepare(liquid);
}

ResistanceScalars InteractionEvaluator::resistance(const Facing& f, double gap) const {
  const resistance::HydrodynamicsParameters& model = interactions_.hydrodynamics;
  switch (f.partner) {
    case Partner::Sphere:
      return times(viscosity_, resistance::pair_term(model, f.radius_a, f.radius_b, gap));
    case Partner::Wall:
      if (!interactions_.substrate) return {};
      return times(viscosity_, resistance::wall_term(model, f.radius_a, gap), +1);
    case Partner::Surface: {
      const double roughness = interactions_.free_surface ? interactions_.free_surface->roughness : 0;
      return times(viscosity_, resistance::free_surface_term(model, f.radius_a, std::max(gap, roughness)), -1);
    }
  }
  return {};
}

bool InteractionEvaluator::acts_on(const Facing& f) const {
  if (f.partner == Partner::Surface) return false;
  return f.partner == Partner::Sphere || (interactions_.substrate && interactions_.substrate->colloidal);
}

forces::PairTerm InteractionEvaluator::evaluate(const forces::PreparedPairLaw& law, const Facing& f, double gap) const {
  if (f.partner == Partner::Sphere) return law.evaluate({gap, f.radius_a, f.radius_b, f.potential_a, f.potential_b});
  return law.evaluate({gap, f.radius_a, std::numeric_limits<double>::infinity(), f.potential_a,
                       interactions_.substrate->surface_potential.value_or(f.potential_a)});
}

forces::PairTerm InteractionEvaluator::colloidal(const std::string& name, const Facing& f, double gap) const {
  const auto law = laws_.find(name);
  if (law == laws_.end() || !acts_on(f)) return {};
  return evaluate(*law->second, f, gap);
}

forces::PairTerm InteractionEvaluator::total(const Facing& f, double gap) const {
  forces::PairTerm sum;
  if (!acts_on(f)) return sum;
  for (const auto& [name, law] : laws_) {
    const forces::PairTerm t = evaluate(*law, f, gap);
    sum.energy += t.energy;
    sum.force += t.force;
    sum.stiffness += t.stiffness;
  }
  return sum;
}

InteractionCurves interaction_curves(const InteractionEvaluator& evaluator, const std::vector<std::string>& laws,
                                     const std::vector<Facing>& facings, const std::vector<double>& gaps) {
  InteractionCurves curves;
  for (const Facing& f : facings) {
    auto& scalars = curves.resistance.emplace_back();
    for (double h : gaps) scalars.push_back(evaluator.resistance(f, h));
    for (const std::string& law : laws) {
      auto& terms = curves.colloidal[law].emplace_back();
      for (double h : gaps) terms.push_back(evaluator.colloidal(law, f, h));
    }
    if (laws.empty()) continue;
    auto& terms = curves.colloidal["total"].emplace_back();
    for (double h : gaps) terms.push_back(evaluator.total(f, h));
  }
  return curves;
}

std::vector<double> curve_gaps() {
  std::vector<double> gaps;
  for (int k = 0; k <= 600; ++k) gaps.push_back(std::pow(10.0, -5 + k / 100.0));
  return gaps;
}

}  // namespace pigment::assembly
