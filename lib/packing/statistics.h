#pragma once
// How good a packing is: achieved solids, smallest gap, sampled sizes against the law, flatness of the solids
// profile.
#include <string>
#include <vector>

#include "model/particles.h"
#include "model/size_distribution.h"

namespace pigment::packing {

// Kolmogorov-Smirnov: the largest distance between two cumulative curves and the probability that chance
// alone makes a distance at least as large for independent draws.
struct KolmogorovSmirnov {
  double distance = 0, p_value = 1;
};
// Of a sample against its law, by number and by weight (a particle counts with its volume; the effective
// sample size, (sum v)^2 / sum v^2, then stands for the count). A monodisperse species agrees with its law:
// distance 0.
KolmogorovSmirnov compare_numbers(std::vector<double> diameter, const SizeDistribution&);
KolmogorovSmirnov compare_weights(std::vector<double> diameter, const SizeDistribution&);
// Of each species of a layer.
struct SizeAgreement {
  std::size_t count = 0;
  KolmogorovSmirnov by_number, by_weight;
};
std::vector<SizeAgreement> compare_sizes(const Layer&, const std::vector<SizeDistribution>&);
// P(distance >= d) for n independent draws: Kolmogorov's limit with Stephens's correction for finite n
// [stephens1970].
double kolmogorov_probability(double distance, double effective_count);

// Volume fraction in equal slices from z = 0 to the top, from exact sphere sections.
struct ProfileFlatness {
  std::vector<double> edges;            // um
  std::vector<double> volume_fraction;  // slices
  double outer_bottom = 0,
         outer_top = 0;        // mean volume fraction of the outer 1 um (of a third of the layer, if less)
  double inner = 0;            // mean between the outer parts
  double inner_deviation = 0;  // s.d. of the slices wholly between the outer parts over their mean
};
ProfileFlatness measure_flatness(const Layer&, int slices);

// Smallest gap between two particles, to the substrate and to the surface; um.
struct SmallestGaps {
  double particles = 0, substrate = 0, surface = 0;
};
// Looks as far as a tenth of the largest radius, then farther until a pair is found; infinite with one
// particle.
SmallestGaps smallest_gaps(const Layer&);

// Solids that the particles and the box hold.
struct Solids {
  double volume_fraction = 0, mass_fraction = 0, coat_weight = 0;  // coat weight dry, engine units
};
Solids solids_of(const Layer&, double liquid_density);

}  // namespace pigment::packing
