#include "analysis/solids_profile.h"

#include <cmath>
#include <numeric>

#include "model/layer_measures.h"
#include "model/redistribution.h"
#include "model/sphere_slice.h"

namespace pigment::analysis {

namespace {

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0.0; }

// What fills `space` um^3: solids, and liquid in the rest (overlapping spheres can leave no room for it).
struct Filling {
  double solid_volume, solid_mass, space, liquid_density;
  double mass() const { return solid_mass + std::max(0.0, space - solid_volume) * liquid_density; }
};

// What all particles together have in a slice.
struct SliceTotal {
  double space, mass, solid_volume, number;  // mass: liquid included
};

// Volume, mass and number of each group of particles in each slice.
struct Groups {
  using Table = std::vector<std::vector<double>>;  // [group][slice]
  Table volume, mass, number;

  Groups(std::size_t groups, std::size_t slices)
      : volume(groups, std::vector<double>(slices, 0.0)), mass(volume), number(volume) {}
  std::size_t count() const { return volume.size(); }
  void add(std::size_t group, std::size_t slice, double part, double part_mass) {
    volume[group][slice] += part;
    mass[group][slice] += part_mass;
  }
  void count_centre(std::size_t group, std::size_t slice) { number[group][slice] += 1; }

  std::vector<GroupProfile> profiles(const std::vector<SliceTotal>& total) const {
    std::vector<GroupProfile> out;
    for (std::size_t g = 0; g < count(); ++g) {
      GroupProfile& of = out.emplace_back();
      of.number = number[g];
      const double all = std::accumulate(number[g].begin(), number[g].end(), 0.0);
      for (std::size_t s = 0; s < total.size(); ++s) {
        of.volume_fraction.push_back(ratio(volume[g][s], total[s].space));
        of.mass_fraction.push_back(ratio(mass[g][s], total[s].mass));
        of.solids_fraction.push_back(ratio(volume[g][s], total[s].solid_volume));
        of.number_fraction.push_back(ratio(number[g][s], total[s].number));
        of.share.push_back(ratio(number[g][s], all));
      }
    }
    return out;
  }
};

// 0 where there is but one: its profile is that of all.
std::size_t species_count(const Solids& solids) {
  int last = 0;
  for (const int species : solids.species) last = std::max(last, species);
  return last == 0 ? 0 : static_cast<std::size_t>(last) + 1;
}

std::vector<double> turned_over(const std::vector<double>& edges) {
  std::vector<double> turned(edges.rbegin(), edges.rend());
  for (double& z : turned) z = edges.back() - z;
  return turned;
}

}  // namespace

double dense_thickness(const std::vector<double>& edges, const std::vector<double>& volume_fraction,
                       double threshold, double wall_layer) {
  const std::size_t slices = volume_fraction.size();
  std::size_t s = 0;
  while (s < slices && volume_fraction[s] < threshold) ++s;
  if (s == slices || edges[s] - edges[0] > wall_layer) return 0;
  while (s + 1 < slices && volume_fraction[s + 1] >= threshold) ++s;
  if (s + 1 == slices || edges.back() - edges[s + 1] <= wall_layer) return edges.back() - edges.front();
  const double middle = 0.5 * (edges[s] + edges[s + 1]), next = 0.5 * (edges[s + 1] + edges[s + 2]);
  const double fall = (volume_fraction[s] - threshold) / (volume_fraction[s] - volume_fraction[s + 1]);
  return middle + fall * (next - middle) - edges[0];
}

SolidsProfile profile_solids(const Snapshot& frame, const Solids& solids, const Parameters& parameters,
                             ColumnGrid columns) {
  const auto slices = static_cast<std::size_t>(parameters.slices);
  const double area = frame.cell.area(), height = frame.cell.height, liquid_density = solids.liquid_density;
  SolidsProfile p;
  p.time = frame.time;
  const double thickness = frame.space_below(height);
  p.thickness = thickness;
  p.edges = equal_slices(height, parameters.slices);

  Groups all(1, slices), by_size(parameters.size_class_count(), slices), by_species(species_count(solids), slices);
  double solid_mass = 0, solid_volume = 0;
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const double a = solids.radius[i], z = frame.position[i].z(), sphere = Particles::sphere_volume(a);
    const std::size_t size = parameters.size_class(2 * a), species = by_species.count() > 0 ? static_cast<std::size_t>(solids.species[i]) : 0;
    for_each_slice(p.edges, a, z, [&](std::size_t s, double part) {
      const double mass = part / sphere * solids.mass[i];
      all.add(0, s, part, mass);
      by_size.add(size, s, part, mass);
      if (by_species.count() > 0) by_species.add(species, s, part, mass);
    });
    if (z <= height) {
      const double slice = std::max(0.0, z / height * static_cast<double>(slices));
      const std::size_t s = std::min(slices - 1, static_cast<std::size_t>(slice));
      all.count_centre(0, s);
      by_size.count_centre(size, s);
      if (by_species.count() > 0) by_species.count_centre(species, s);
    }
    solid_mass += solids.mass[i];
    solid_volume += sphere;
  }

  std::vector<SliceTotal> totals;
  double volume_below = 0, mass_below = 0;
  for (std::size_t s = 0; s < slices; ++s) {
    const double space = area * (frame.space_below(p.edges[s + 1]) - frame.space_below(p.edges[s])), v = all.volume[0][s], m = all.mass[0][s];
    const Filling slice{v, m, space, liquid_density};
    totals.push_back({space, slice.mass(), v, all.number[0][s]});
    volume_below += v;
    mass_below += m;
    p.volume_fraction.push_back(ratio(v, space));
    p.mass_fraction.push_back(ratio(m, slice.mass()));
    p.cumulative_share.push_back(ratio(volume_below, solid_volume));
    const Filling below{volume_below, mass_below, area * frame.space_below(p.edges[s + 1]), liquid_density};
    p.cumulative_mass_fraction.push_back(ratio(mass_below, below.mass()));
  }
  p.size_classes = by_size.profiles(totals);
  p.species = by_species.profiles(totals);

  p.mean_volume_fraction = ratio(solid_volume, area * thickness);
  p.porosity = 1 - ratio(volume_below, area * thickness);
  p.mean_mass_fraction =
      ratio(solid_mass, Filling{solid_volume, solid_mass, area * thickness, liquid_density}.mass());
  p.mass_centre = mass_centre(frame.position, solids.radius, solids.mass);
  p.z95 = height_below_which(0.95, frame.position, solids.radius);
  p.z99 = height_below_which(0.99, frame.position, solids.radius);
  if (columns.count() == 0) columns = columns_of(frame.cell, parameters.envelope_column);
  p.top_height = top_of_columns(frame.cell, frame.position, solids.radius, columns);
  p.top_envelope = spread_of(p.top_height).mean;
  p.protruding_fraction = protruding_fraction(height, frame.position, solids.radius);
  p.cake_thickness =
      dense_thickness(p.edges, p.volume_fraction, parameters.cake_solids, parameters.wall_layer);
  const std::vector<double> from_top(p.volume_fraction.rbegin(), p.volume_fraction.rend());
  p.skin_thickness =
      dense_thickness(turned_over(p.edges), from_top, parameters.cake_solids, parameters.wall_layer);
  return p;
}

namespace {

NonAffineInterval non_affine_interval(const Snapshot& before, const Snapshot& after) {
  NonAffineInterval interval;
  interval.time = after.time;
  const double dt = after.time - before.time;
  if (!(dt > 0)) return interval;
  std::vector<double> rise(before.position.size());
  for (std::size_t i = 0; i < rise.size(); ++i)
    rise[i] = (after.position[i].z() - before.position[i].z()) / dt;
  const NonAffineMotion motion =
      non_affine_motion(before.position, rise, before.cell.height, non_affine_slices(rise.size()));
  interval.velocity = motion.rms;
  interval.shrinkage_rate = (before.cell.height - after.cell.height) / dt;
  interval.judged = motion.degrees_of_freedom > 0 && interval.shrinkage_rate != 0;
  return interval;
}

}  // namespace

SolidsDevelopment follow_solids(const Frames& frames, const Solids& solids, const Parameters& parameters) {
  // A frame is read once: each interval keeps the frame before it, profiles are made with the later one.
  struct Measured {
    SolidsProfile profile;
    NonAffineInterval interval;
    Redistribution redistribution;
  };
  SolidsDevelopment result;
  if (frames.count == 0) return result;
  Frames kept = frames;
  Snapshot first;
  kept.read = [&](std::size_t k) {
    Snapshot frame = frames.read(k);
    if (k == 0) first = frame;
    return frame;
  };
  const ColumnGrid columns = columns_of(frames.read(0).cell, parameters.envelope_column);
  std::vector<std::size_t> all(frames.count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Measured> measured;
  if (frames.count > 1)
    measured = measure_intervals(kept, all, [&](const Snapshot& before, const Snapshot& after) {
      return Measured{profile_solids(after, solids, parameters, columns), non_affine_interval(before, after),
                      redistribution_between(before.position, after.position, solids.radius, before.cell.height, after.cell.height)};
    });
  else
    first = frames.read(0);
  result.profiles.push_back(profile_solids(first, solids, parameters, columns));
  for (Measured& m : measured) {
    const SolidsProfile& before = result.profiles.back();
    const double dt = m.profile.time - before.time;
    if (dt > 0)
      m.interval.mass_centre_rate =
          m.profile.thickness *
          (m.profile.mass_centre / m.profile.thickness - before.mass_centre / before.thickness) / dt;
    m.profile.shrinkage = 1 - m.profile.thickness / result.profiles.front().thickness;
    result.profiles.push_back(std::move(m.profile));
    result.intervals.push_back(m.interval);
  }
  // The stepper's rule: the first frame at which a whole window of frames has gone by and mass no longer moves between heights.
  std::deque<Redistribution> window;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    NonAffineInterval& interval = result.intervals[k];
    const bool shrunk = add_to_window(window, measured[k].redistribution, parameters.immobilisation_shrinkage);
    interval.redistribution = redistribution_ratio(window, parameters.immobilisation_shrinkage);
    if (!result.immobilisation_time && shrunk && interval.redistribution < parameters.immobilisation_ratio)
      result.immobilisation_time = interval.time;
  }
  return result;
}

}  // namespace pigment::analysis
