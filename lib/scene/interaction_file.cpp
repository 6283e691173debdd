#include "scene/interaction_file.h"

#include <cmath>
#include <numbers>

#include "forces/surface_spring.h"
#include "model/size_distribution.h"

namespace pigment::scene {
namespace {

using assembly::Facing;
using assembly::Partner;

// Below /interactions.
class CurveFile {
 public:
  explicit CurveFile(io::ResultFile& result) : result_(result) {}

  void add(const std::string& path, std::vector<std::size_t> shape, std::vector<double> values, Dimension dimension,
           io::Dataset::Storage storage = io::Dataset::Storage::Float64) {
    result_.datasets.push_back({"/interactions/" + path, std::move(shape), std::move(values), dimension, storage});
  }
  void add(const std::string& path, const std::vector<double>& values, Dimension dimension) { add(path, {values.size()}, values, dimension); }
  void species(const std::string& path, const std::vector<double>& values) {
    add(path, {values.size()}, values, Dimension::Number, io::Dataset::Storage::Int64);
  }
  // One row a facing, one column a gap.
  template <typename Entry>
  void matrix(const std::string& path, const std::vector<std::vector<Entry>>& rows, double Entry::*member, Dimension dimension) {
    std::vector<double> values;
    for (const auto& row : rows)
      for (const Entry& entry : row) values.push_back(entry.*member);
    add(path, {rows.size(), rows.front().size()}, std::move(values), dimension);
  }
  // names: of kn, kt, ks, kp, ksp.
  void curves(const std::string& group, const assembly::InteractionCurves& curves, const std::vector<std::string>& names) {
    using K = assembly::ResistanceScalars;
    const auto scalar = [&](int which, double K::*member, Dimension d) { matrix(group + "/" + names[which], curves.resistance, member, d); };
    scalar(0, &K::kn, Dimension::Resistance);
    scalar(1, &K::kt, Dimension::RotationalResistance);
    scalar(2, &K::ks, Dimension::Resistance);
    scalar(3, &K::kp, Dimension::RotationalResistance);
    scalar(4, &K::ksp, Dimension::ResistanceCoupling);
    using Term = forces::PairTerm;
    for (const auto& [law, terms] : curves.colloidal) {
      matrix(group + "/" + law + "/energy", terms, &Term::energy, Dimension::Energy);
      matrix(group + "/" + law + "/force", terms, &Term::force, Dimension::Force);
      matrix(group + "/" + law + "/stiffness", terms, &Term::stiffness, Dimension::SurfaceTension);
    }
  }

 private:
  io::ResultFile& result_;
};

// The sphere that stands for a species: that of mean volume, by number. Without species: 1 um in diameter.
struct Representative {
  double radius = 0.5, potential = -25;
};
std::vector<Representative> representatives_of(const Scene& scene) {
  std::vector<Representative> spheres;
  for (const Species& s : scene.species)
    spheres.push_back({0.5 * std::cbrt(6 * SizeDistribution(s.size).mean_volume() / std::numbers::pi), s.surface_potential});
  if (spheres.empty()) spheres.emplace_back();
  return spheres;
}

void add_pairs(CurveFile& file, const assembly::InteractionEvaluator& evaluator, const std::vector<std::string>& laws,
               const std::vector<Representative>& spheres) {
  std::vector<Facing> facings;
  std::vector<double> species_a, species_b, radius_a, radius_b;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i; j < spheres.size(); ++j) {
      facings.push_back({Partner::Sphere, spheres[i].radius, spheres[j].radius, spheres[i].potential, spheres[j].potential});
      species_a.push_back(static_cast<double>(i));
      species_b.push_back(static_cast<double>(j));
      radius_a.push_back(spheres[i].radius);
      radius_b.push_back(spheres[j].radius);
    }
  file.species("pair/species_a", species_a);
  file.species("pair/species_b", species_b);
  file.add("pair/radius_a", radius_a, Dimension::Length);
  file.add("pair/radius_b", radius_b, Dimension::Length);
  file.curves("pair", interaction_curves(evaluator, laws, facings, assembly::curve_gaps()),
              {"squeeze", "twist", "shear", "pump", "shear_pump"});
}

void add_boundary(CurveFile& file, const std::string& group, Partner partner, const assembly::InteractionEvaluator& evaluator,
                  const std::vector<std::string>& laws, const std::vector<Representative>& spheres) {
  std::vector<Facing> facings;
  std::vector<double> radius;
  for (const Representative& s : spheres) {
    facings.push_back({partner, s.radius, 0, s.potential, 0});
    radius.push_back(s.radius);
  }
  file.add(group + "/radius", radius, Dimension::Length);
  file.curves(group, interaction_curves(evaluator, laws, facings, assembly::curve_gaps()),
              {"perpendicular", "twist", "parallel", "rolling", "coupling"});
}

// From touching to where the particle has left, h = 2a.
void add_spring(CurveFile& file, const forces::FreeSurfaceParameters& surface, const std::vector<Representative>& spheres) {
  constexpr std::size_t points = 401;
  std::vector<double> protrusion, force, stiffness;
  for (const Representative& s : spheres)
    for (std::size_t k = 0; k < points; ++k) {
      const double h = 2 * s.radius * static_cast<double>(k) / (points - 1);
      const forces::SpringForce spring = forces::surface_spring(surface, s.radius, h);
      protrusion.push_back(h);
      force.push_back(spring.force);
      stiffness.push_back(spring.stiffness);
    }
  const std::vector<std::size_t> shape{spheres.size(), points};
  file.add("free_surface/protrusion", shape, protrusion, Dimension::Length);
  file.add("free_surface/spring_force", shape, force, Dimension::Force);
  file.add("free_surface/spring_stiffness", shape, stiffness, Dimension::SurfaceTension);
}

}  // namespace

io::ResultFile interaction_file_of(const Scene& scene, const assembly::InteractionEvaluator& evaluator) {
  const Liquid liquid = liquid_at(scene.liquid, scene.liquid.temperature);
  io::ResultFile result;
  result.kind = "interactions";
  CurveFile file(result);
  const std::vector<Representative> spheres = representatives_of(scene);
  std::vector<std::string> laws;
  for (const auto& [name, law] : scene.colloidal) {
    laws.push_back(name);
    result.numbers["cutoff_gap_" + name] = to_si(Dimension::Length, law->prepare(liquid)->cutoff_gap());
  }
  result.numbers["thermal_energy"] = to_si(Dimension::Energy, liquid.thermal_energy());
  result.numbers["viscosity"] = to_si(Dimension::Viscosity, liquid.viscosity);
  file.add("gap", assembly::curve_gaps(), Dimension::Length);
  add_pairs(file, evaluator, laws, spheres);
  if (scene.substrate) {
    const auto on_substrate = scene.substrate->colloidal ? laws : std::vector<std::string>{};
    add_boundary(file, "substrate", Partner::Wall, evaluator, on_substrate, spheres);
  }
  if (scene.free_surface) {
    add_boundary(file, "free_surface", Partner::Surface, evaluator, {}, spheres);
    if (scene.free_surface->model != forces::FreeSurfaceParameters::Model::Constraint) add_spring(file, *scene.free_surface, spheres);
  }
  return result;
}

}  // namespace pigment::scene
