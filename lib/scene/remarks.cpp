#include "scene/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/dimensionless.h"
#include "scene/estimate.h"

namespace pigment::scene {
namespace {

// A model matters from here on.
constexpr double diffusion_share = 0.1;   // of its own diameter, how far a particle diffuses against the flow
constexpr double settling_share = 0.01;   // of the layer's thickness, how far the largest particle settles
constexpr double retardation_share = 0.95;  // of the unretarded attraction
constexpr double stable_barrier = 20, weak_barrier = 5;  // kT

constexpr double standard_gravity = 9.81;  // um/ms^2
constexpr double micrometre_per_second = 1e3;  // of a speed in um/ms

// The gap at which numbers are given: the Debye length where there is an electrostatic force, read off as its decay far
// from contact (near it ln(1 + exp(-kappa h)) decays more slowly); else 5 nm.
double typical_gap(const EqualPair& pair) {
  double length = 0.001;
  for (const double distance : {1.0, 3.0, 8.0}) {  // the first at 1 nm, then in decay lengths found so far
    const double h = distance * length, step = 0.01 * h;
    const double near = pair.law_force("electrostatic", h), far = pair.law_force("electrostatic", h + step);
    if (!(near > far && far > 0)) return 0.005;
    length = step / std::log(near / far);
  }
  return length;
}

std::string span(double a, double b) {
  return a == b ? fmt::format("{:.3g}", a) : fmt::format("{:.2g}..{:.2g}", std::min(a, b), std::max(a, b));
}

class Writer {
 public:
  explicit Writer(const Scene& scene)
      : scene_(scene), liquid_(liquid_at(scene.liquid, scene.liquid.temperature)) {
    if (scene.layer && !scene.species.empty()) {
      layer_ = estimate_layer(scene);
      if (scene.dewatering)
        rates_ = estimate_rates(dewatering::make_profile(*scene.dewatering, coating_of(scene)));
    }
  }

  std::vector<std::string> write() {
    amounts();
    numbers();
    models();
    cost();
    return std::move(lines_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    lines_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void amounts() {
    line("Amounts");
    line("  liquid at {:.4g} degC: viscosity {:.4g} mPa s, relative permittivity {:.4g}", liquid_.temperature - 273.15,
         liquid_.viscosity, liquid_.relative_permittivity);
    if (!layer_) {
      line("  no layer or no particles: nothing can be said of amounts");
      return;
    }
    line("  wet layer: {:.4g} um, {:.4g} wt% ({:.4g} vol%); dry coat weight {:.4g} g/m2", layer_->thickness,
         100 * layer_->mass_fraction, 100 * layer_->volume_fraction, 1e3 * layer_->dry_coat_weight);
    line("  about {:.0f} particles, diameters {} um, median by number {:.3g} um; mean gap {:.3g} nm", layer_->particles,
         span(layer_->smallest, layer_->largest), layer_->median, 1e3 * layer_->mean_gap);
    if (rates_)
      line("  liquid leaves at {} um/s (the fastest over the first hundredth), {:.4g} um of it in {:.4g} s",
           span(rates_->slowest * micrometre_per_second, rates_->fastest * micrometre_per_second), rates_->removed,
           1e-3 * rates_->duration);
    else
      line("  no dewatering: rates are unknown, and the numbers below leave them out");
  }

  EqualPair pair_of(const Species& species, double diameter) const {
    return {scene_.colloidal, liquid_, diameter / 2, species.surface_potential};
  }

  // Of one species: finest, median by number, coarsest.
  std::vector<double> diameters(std::size_t s) const {
    const SizeDistribution& d = layer_->sizes[s];
    if (d.monodisperse()) return {d.largest()};
    return {d.smallest(), d.diameter_at_number(0.5), d.largest()};
  }

  void numbers() {
    if (!layer_ || !rates_) return;
    line("Dimensionless numbers (2)-(4) of [sand2010]; a_char the radius, H the wet thickness, |F| electrostatic and van "
         "der Waals");
    for (std::size_t s = 0; s < scene_.species.size(); ++s) {
      const Species& species = scene_.species[s];
      const double gap = typical_gap(pair_of(species, 1));
      line("  {}: {:>10} {:>18} {:>18} {:>22} {:>22}", species.name, "diameter", "Re_p", "Pe",
           fmt::format("K_coll at {:.2g} nm", 1e3 * gap), fmt::format("K_coll at {:.3g} nm", 1e3 * layer_->mean_gap));
      const std::string margin(species.name.size() + 1, ' ');
      for (const double d : diameters(s)) {
        const double a = d / 2;
        const EqualPair pair = pair_of(species, d);
        const auto over_rates = [&](auto&& number) { return span(number(rates_->slowest), number(rates_->fastest)); };
        const auto k_coll = [&](double h) {
          const double f = pair.law_force("electrostatic", h) + pair.law_force("van_der_waals", h);
          if (f == 0) return std::string("no force");
          return over_rates([&](double u) { return colloidal_number(a, liquid_.viscosity, u, f); });
        };
        line("  {} {:>10} {:>18} {:>18} {:>22} {:>22}", margin, fmt::format("{:.3g} um", d),
             over_rates([&](double u) { return particle_reynolds(liquid_.density, a, u, liquid_.viscosity); }),
             over_rates([&](double u) {
               return peclet(liquid_.viscosity, a, layer_->thickness, u, liquid_.thermal_energy());
             }),
             k_coll(gap), k_coll(layer_->mean_gap));
      }
    }
  }

  void models() {
    line("Models: what the scene needs, and what it could drop");
    if (layer_ && rates_) {
      inertia();
      brownian();
      gravity();
    }
    rotation();
    colloidal();
    boundaries();
  }

  void inertia() {
    const double re = particle_reynolds(liquid_.density, layer_->largest / 2, rates_->fastest, liquid_.viscosity);
    line("  inertia: {} (Re_p at most {:.2g})", re < 0.1 ? "not needed, and not in the engine" : "would matter, and is not in the engine",
         re);
  }

  // Against a flow u a particle is spread over the length kT/(6 pi mu a u): in diameters, the inverse of Pe over one.
  void brownian() {
    const auto spread = [&](double d, double u) {
      return u > 0 ? 1 / peclet(liquid_.viscosity, d / 2, d, u, liquid_.thermal_energy()) : HUGE_VAL;
    };
    const double finest = spread(layer_->smallest, rates_->slowest), fast = spread(layer_->smallest, rates_->fastest);
    const bool needed = finest > diffusion_share;
    // Diameter up to which diffusion counts at the slowest rate: the spread in diameters goes with d^-2.
    const double up_to = layer_->smallest * std::sqrt(finest / diffusion_share);
    verdict("brownian", scene_.brownian.has_value(), needed,
            fmt::format("against the flow the finest particles spread over {} of their diameter{}", span(fast, finest),
                        needed && std::isfinite(up_to)
                            ? fmt::format("; it counts up to {:.2g} um", std::min(up_to, layer_->largest))
                            : ""));
    if (rates_->slowest <= 0) return;
    for (const double d : {layer_->smallest, std::sqrt(layer_->smallest * layer_->largest), layer_->largest}) {
      const double pe = peclet(liquid_.viscosity, d / 2, d, rates_->slowest, liquid_.thermal_energy());
      line("    {:.2g} um: Pe {:.2g} at the slowest rate, {}; without Brownian motion {}", d, pe,
           fmt::format("{:.2g} um of spread", d / pe),
           pe < 1 / diffusion_share ? "it would stay where the flow carries it, and cakes would end too sharply"
                                    : "its motion would hardly change");
      if (layer_->largest <= layer_->smallest) break;
    }
    if (scene_.brownian && scene_.brownian->model == forces::BrownianParameters::Model::KBrown)
      line("    model k_brown: near pairs are too cold by it (docs/physics.md); fluctuation_dissipation is not");
  }

  void gravity() {
    const double g = scene_.gravity ? scene_.gravity->acceleration : standard_gravity;
    double fastest = 0;
    for (std::size_t s = 0; s < scene_.species.size(); ++s) {
      const double a = layer_->sizes[s].largest() / 2;
      fastest = std::max(fastest, 2.0 / 9.0 * std::abs(scene_.species[s].density - liquid_.density) * g * a * a / liquid_.viscosity);
    }
    const double way = fastest * rates_->duration;
    verdict("gravity", scene_.gravity.has_value(), way > settling_share * layer_->thickness,
            fmt::format("the coarsest particle alone would settle at {:.2g} um/s, {:.2g} um in all", fastest * micrometre_per_second,
                        way));
  }

  void rotation() {
    const bool couples = scene_.hydrodynamics.model != resistance::HydrodynamicsParameters::Model::Drag;
    verdict("rotation", scene_.hydrodynamics.rotation, couples,
            couples ? "near pairs couple it to the motion through lubrication"
                    : "with drag alone nothing couples to it, and it is not solved for");
  }

  void colloidal() {
    if (scene_.colloidal.empty()) {
      line("  colloidal: no forces in the scene; only hydrodynamics keeps particles apart");
      return;
    }
    const auto has = [&](const char* name) {
      return std::any_of(scene_.colloidal.begin(), scene_.colloidal.end(), [&](const auto& law) { return law.name == name; });
    };
    for (std::size_t s = 0; s < scene_.species.size(); ++s) {
      const double d = layer_ ? diameters(s)[diameters(s).size() / 2] : 1.0;
      const EqualPair pair = pair_of(scene_.species[s], d);
      const EqualPair::Landscape land = pair.landscape();
      const double barrier = land.barrier.energy / liquid_.thermal_energy();
      const double well = land.secondary_minimum.energy / liquid_.thermal_energy();
      std::string text = fmt::format("two particles of {:.3g} um at {:.3g} mV: ", d, scene_.species[s].surface_potential);
      if (land.barrier.gap > 0)
        text += fmt::format("barrier {:.3g} kT at {:.3g} nm, ", barrier, 1e3 * land.barrier.gap);
      else
        text += "no barrier, ";
      text += well < 0 ? fmt::format("well outside it {:.2g} kT at {:.3g} nm", well, 1e3 * land.secondary_minimum.gap)
                       : std::string("no well outside it");
      text += barrier > stable_barrier  ? "; they stay apart"
              : barrier > weak_barrier ? "; they aggregate slowly"
              : land.barrier.gap == 0 && pair.energy(1e-4) > stable_barrier * liquid_.thermal_energy() ? "; they repel at every gap"
                                                                                                       : "; they aggregate";
      line("  {}: {}", scene_.species[s].name, text);
    }
    if (has("van_der_waals")) {
      const EqualPair pair(scene_.colloidal, liquid_, 0.5, scene_.species.empty() ? 0 : scene_.species.front().surface_potential);
      const double gap = typical_gap(pair), near = 2e-4;
      const double unretarded = pair.law_force("van_der_waals", near) * (near * near) / (gap * gap);
      if (unretarded != 0) {
        const double kept = pair.law_force("van_der_waals", gap) / unretarded;
        line("  retardation: {} (it leaves {:.0f} % of the attraction at {:.2g} nm)",
             kept < retardation_share ? "needed" : "could be dropped", 100 * kept, 1e3 * gap);
      }
      if (!has("born") && !has("steric"))
        line("  born: not in the scene; attraction without it has no bottom but the law's floor, add \"born: {{}}\"");
    }
  }

  void boundaries() {
    if (!scene_.substrate) line("  substrate: none; particles leave through z = 0");
    if (!scene_.free_surface)
      line("  free_surface: not in the scene; liquid is unlimited above and box edge z stays");
    if (!scene_.free_surface && scene_.dewatering && scene_.dewatering->evaporates())
      line("  evaporation: without a free_surface pigment-consolidate refuses it");
  }

  void cost() {
    const double duration = scene_.stepping.until.value_or(rates_ ? rates_->duration : 0);
    if (!layer_ || duration == 0) return;
    const CostEstimate c = estimate_cost(scene_, *layer_, duration);
    line("Cost of pigment-consolidate to {:.4g} s, roughly", 1e-3 * duration);
    line("  {:.0f} particles, {:.0f} near pairs, {:.0f} steps of {:.3g} ms ({}): {:.0f} s on one core", c.particles, c.pairs,
         c.steps, c.step, scene_.stepping.time_step ? "as given" : "what the error control takes on the average", c.seconds);
    line("  {:.0f} frames, {:.0f} MB before compression", c.frames, c.megabytes);
  }

  void verdict(const char* model, bool present, bool needed, const std::string& why) {
    const char* word = needed ? (present ? "needed" : "not in the scene, but would matter") : present ? "could be dropped" : "not needed";
    line("  {}: {} ({})", model, word, why);
  }

  const Scene& scene_;
  Liquid liquid_;
  std::optional<LayerEstimate> layer_;
  std::optional<RateEstimate> rates_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> remarks(const Scene& scene) { return Writer(scene).write(); }

}  // namespace pigment::scene
