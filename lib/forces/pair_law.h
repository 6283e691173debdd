#pragma once
// A pair law: energy, force and stiffness of two spheres (or a sphere and the plane) as functions of their gap.
// A law is one file: a struct with its parameters, how a scene writes them, and the formula; the loop over pairs is here,
// instantiated in the law's own file so that the formula inlines. docs/adding-a-force.md walks through one.
//
// Signs: a positive force repels; force = -dE/dgap, stiffness = -dforce/dgap. Every law is finite at and below contact:
// under its floor gap it goes on with constant stiffness (C1). It acts in full up to three quarters of its cutoff gap and
// is switched off smoothly (C2, energy, force and stiffness consistent) from there to the cutoff.
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/node.h"
#include "model/liquid.h"

namespace pigment::forces {

struct PairGeometry {
  double gap = 0;                                 // um, surface to surface; negative in overlap
  double radius_a = 0, radius_b = 0;              // um; infinite for the plane
  double potential_a = 0, potential_b = 0;        // mV
  double reduced_radius() const {
    if (std::isinf(radius_b)) return radius_a;
    if (std::isinf(radius_a)) return radius_b;
    return radius_a * radius_b / (radius_a + radius_b);
  }
};

struct PairTerm {
  double energy = 0;     // pN um
  double force = 0;      // pN, repulsion positive
  double stiffness = 0;  // pN/um
};

// A law at one state of the liquid.
class PreparedPairLaw {
 public:
  virtual ~PreparedPairLaw() = default;
  virtual double cutoff_gap() const = 0;                           // um
  // An attraction that eases with distance everywhere: its energy is concave in the gap.
  virtual bool concave() const = 0;
  virtual PairTerm evaluate(const PairGeometry&) const = 0;        // not switched off at the cutoff
  virtual PairTerm switched(const PairGeometry&) const = 0;        // as the engine uses it
  // Adds force and stiffness of each pair (switched); arrays of equal length.
  virtual void add(std::span<const PairGeometry>, std::span<double> force, std::span<double> stiffness) const = 0;
  // The same with energies.
  virtual void add(std::span<const PairGeometry>, std::span<PairTerm>) const = 0;
};

class PairLaw {
 public:
  virtual ~PairLaw() = default;
  virtual std::unique_ptr<PreparedPairLaw> prepare(const Liquid&) const = 0;
};

struct PairLawEntry {
  std::string name;     // scene key under `colloidal` and name of the law's file
  std::string summary;  // one line with its source
  std::string example;  // a block for --help and the tests, "{debye_length: 5 nm}"
  std::unique_ptr<PairLaw> (*read)(config::Node law, config::Node colloidal);
};

// Every registered law, in the order of pair_laws.def.
const std::vector<PairLawEntry>& pair_laws();

// What a law's file supplies: struct Formula { double cutoff_gap, floor_gap; PairTerm operator()(const PairGeometry&) const; }
// (only called with gap >= floor_gap), the same as without_energy where the energy costs a function of its own, `static constexpr bool concave = true`
// where that holds, and a Law with `Formula prepare(const Liquid&) const`.
template <typename Formula>
class PreparedFormula final : public PreparedPairLaw {
 public:
  explicit PreparedFormula(Formula f) : formula_(f) {}
  double cutoff_gap() const override { return formula_.cutoff_gap; }
  bool concave() const override {
    if constexpr (requires { Formula::concave; }) return Formula::concave;
    else return false;
  }
  PairTerm evaluate(const PairGeometry& g) const override { return continued(g); }
  PairTerm switched(const PairGeometry& g) const override { return faded(g); }
  void add(std::span<const PairGeometry> pairs, std::span<double> force, std::span<double> stiffness) const override {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (pairs[p].gap >= formula_.cutoff_gap) continue;
      const PairTerm term = faded_force(pairs[p]);
      force[p] += term.force;
      stiffness[p] += term.stiffness;
    }
  }
  void add(std::span<const PairGeometry> pairs, std::span<PairTerm> sum) const override {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (pairs[p].gap >= formula_.cutoff_gap) continue;
      const PairTerm term = faded(pairs[p]);
      sum[p].energy += term.energy;
      sum[p].force += term.force;
      sum[p].stiffness += term.stiffness;
    }
  }

 private:
  PairTerm continued(const PairGeometry& g) const {
    if (g.gap >= formula_.floor_gap) return formula_(g);
    PairGeometry at_floor = g;
    at_floor.gap = formula_.floor_gap;
    const PairTerm f = formula_(at_floor);
    const double depth = formula_.floor_gap - g.gap;
    return {f.energy + depth * (f.force + 0.5 * depth * f.stiffness), f.force + depth * f.stiffness, f.stiffness};
  }
  // The energy, where it takes a function of its own, is left out where nothing asks for it: the logarithm of the double layer took 4 % of a step.
  PairTerm faded_force(const PairGeometry& g) const {
    if constexpr (requires { formula_.without_energy(g); })
      if (g.gap >= formula_.floor_gap && g.gap <= fading * formula_.cutoff_gap) return formula_.without_energy(g);
    return faded(g);
  }
  PairTerm faded(const PairGeometry& g) const {
    const double cutoff = formula_.cutoff_gap, begin = fading * cutoff;
    if (g.gap >= cutoff) return {};
    const PairTerm f = continued(g);
    if (g.gap <= begin) return f;
    const double width = cutoff - begin, t = (g.gap - begin) / width;
    const double w = 1 - t * t * t * (10 - 15 * t + 6 * t * t);
    const double dw = -30 * t * t * (1 - t) * (1 - t) / width;
    const double ddw = -60 * t * (1 - t) * (1 - 2 * t) / (width * width);
    return {f.energy * w, f.force * w - f.energy * dw, f.stiffness * w - 2 * f.force * dw + f.energy * ddw};
  }

  static constexpr double fading = 0.75;  // of the cutoff: from there on a law fades
  Formula formula_;
};

template <typename Law>
class PairLawOf final : public PairLaw {
 public:
  explicit PairLawOf(Law law) : law_(std::move(law)) {}
  std::unique_ptr<PreparedPairLaw> prepare(const Liquid& liquid) const override {
    return std::make_unique<PreparedFormula<decltype(law_.prepare(liquid))>>(law_.prepare(liquid));
  }

 private:
  Law law_;
};

template <typename Law>
PairLawEntry pair_law(std::string name, std::string summary, std::string example) {
  return {std::move(name), std::move(summary), std::move(example),
          [](config::Node law, config::Node colloidal) -> std::unique_ptr<PairLaw> {
            return std::make_unique<PairLawOf<Law>>(Law(law, colloidal));
          }};
}

}  // namespace pigment::forces
