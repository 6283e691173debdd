#include "model/species.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pigment {
namespace {

// A diameter outside this range is a slip of the unit, not a pigment. SI.
const config::Range diameter_range = config::between(1e-9, 1e-3);

void check_cuts(config::Node& block, SizeLaw& law) {
  if (!block.failed("min") && !block.failed("max") && law.min >= law.max)
    block.error("min", fmt::format("must be below max ({:.6g} um), found {:.6g} um", law.max, law.min));
}

// Log-normal by weight. Mean m and standard deviation s of the uncut law, both lengths, give
// (ln sigma_g)^2 = ln(1 + (s/m)^2) and median = m / sqrt(1 + (s/m)^2).
// Differs from [sand2010]: its eq. (26) is called log-normal and printed as a Gaussian of the diameter; read with both
// printed lengths (1.5 um, 10 um) as the moments of a log-normal, it has the median 0.2225 um.
void read_lognormal(config::Node& block, SizeLaw& law) {
  const bool by_median = block.has("median") || block.has("geometric_standard_deviation");
  const bool by_mean = block.has("mean") || block.has("standard_deviation");
  if (by_median && by_mean) {
    const char* extra = block.has("median") ? "median" : "geometric_standard_deviation";
    block.error(extra, "give either mean and standard_deviation, or median and geometric_standard_deviation");
    for (const char* key : {"mean", "standard_deviation"})
      if (block.has(key)) block.quantity(key, Dimension::Length);
    for (const char* key : {"median"})
      if (block.has(key)) block.quantity(key, Dimension::Length);
    if (block.has("geometric_standard_deviation")) block.number("geometric_standard_deviation");
  } else if (by_median) {
    law.median = block.quantity("median", Dimension::Length, diameter_range);
    law.geometric_standard_deviation =
        block.number("geometric_standard_deviation", config::Range{1, 100, false, true});
    const double variance_of_log = std::pow(std::log(law.geometric_standard_deviation), 2);
    law.mean = law.median * std::exp(0.5 * variance_of_log);
    law.standard_deviation = law.mean * std::sqrt(std::expm1(variance_of_log));
  } else {
    law.mean = block.quantity("mean", Dimension::Length, diameter_range);
    law.standard_deviation = block.quantity("standard_deviation", Dimension::Length, config::positive());
    const double growth = 1 + std::pow(law.standard_deviation / law.mean, 2);
    law.median = law.mean / std::sqrt(growth);
    law.geometric_standard_deviation = std::exp(std::sqrt(std::log(growth)));
  }
  law.min = block.quantity("min", Dimension::Length, diameter_range);
  law.max = block.quantity("max", Dimension::Length, diameter_range);
  check_cuts(block, law);
}

// Cut three standard deviations either side of the mean unless told otherwise.
void read_normal(config::Node& block, SizeLaw& law) {
  constexpr double reach = 3;
  law.mean = block.quantity("mean", Dimension::Length, diameter_range);
  law.standard_deviation = block.quantity("standard_deviation", Dimension::Length, config::positive());
  const bool read = !block.failed("mean") && !block.failed("standard_deviation");
  const double low = law.mean - reach * law.standard_deviation, high = law.mean + reach * law.standard_deviation;
  if (read && low < to_engine(Dimension::Length, diameter_range.min) && !block.has("min"))
    block.error("min", fmt::format("missing; {:g} standard deviations below the mean there is no diameter left "
                                   "to cut at; write e.g. \"min: {:.3g} um\"",
                                   reach, 0.1 * law.mean));
  else
    law.min = block.quantity("min", Dimension::Length, fmt::format("{:.9g} um", low), diameter_range);
  law.max = block.quantity("max", Dimension::Length, fmt::format("{:.9g} um", high), diameter_range);
  check_cuts(block, law);
}

SizeLaw read_size(config::Node block) {
  SizeLaw law;
  law.kind = block.choice<SizeLaw::Kind>("law", {{"lognormal", SizeLaw::Kind::Lognormal},
                                                 {"normal", SizeLaw::Kind::Normal},
                                                 {"monodisperse", SizeLaw::Kind::Monodisperse},
                                                 {"table", SizeLaw::Kind::Table}});
  switch (law.kind) {
    case SizeLaw::Kind::Lognormal: read_lognormal(block, law); break;
    case SizeLaw::Kind::Normal: read_normal(block, law); break;
    case SizeLaw::Kind::Monodisperse:
      law.diameter = law.mean = law.median = law.min = law.max =
          block.quantity("diameter", Dimension::Length, diameter_range);
      law.geometric_standard_deviation = 1;
      break;
    case SizeLaw::Kind::Table:
      law.file = block.file("file");
      // The rows themselves are the cut-offs unless these lie further in.
      law.min = block.optional_quantity("min", Dimension::Length, diameter_range).value_or(0);
      law.max = block.optional_quantity("max", Dimension::Length, diameter_range).value_or(0);
      if (law.min > 0 && law.max > 0) check_cuts(block, law);
      break;
  }
  return law;
}

}  // namespace

std::vector<Species> read_species(config::Node root) {
  std::vector<config::Node> blocks = root.blocks("particles");
  std::vector<Species> result;
  for (config::Node& block : blocks) {
    Species s;
    s.name = blocks.size() == 1 ? block.text("species", "pigment") : block.text("species");
    const bool taken =
        std::any_of(result.begin(), result.end(), [&](const Species& other) { return other.name == s.name; });
    if (taken && !s.name.empty()) block.error("species", fmt::format("\"{}\" is the name of an earlier species", s.name));
    s.parts = blocks.size() == 1 ? block.number("parts", 100.0, config::positive())
                                 : block.number("parts", config::positive());
    s.density = block.quantity("density", Dimension::Density, "2700 kg/m3", config::positive());
    // Beyond a volt: a slip of the unit.
    s.surface_potential =
        block.quantity("surface_potential", Dimension::Potential, "-25 mV", config::between(-1, 1));
    if (block.has("size"))
      s.size = read_size(block.block("size"));
    else
      block.error("size", "missing; write e.g. \"size: {law: monodisperse, diameter: 1 um}\"");
    result.push_back(std::move(s));
  }
  return result;
}

}  // namespace pigment
