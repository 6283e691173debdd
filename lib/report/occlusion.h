#pragma once
// How much of the sky and of the key light the spheres around a point hide.
#include <vector>

#include "report/render.h"

namespace pigment::report {

struct Illumination {
  double sky = 1;  // fraction of the cosine-weighted hemisphere left open
  double key = 1;  // fraction of the key light that arrives
};

// A grid in which each cell lists the spheres that matter there: those closer than a few of their own radii.
// With similar shadows at every size the list's length does not depend on the size distribution.
class OccluderGrid {
 public:
  OccluderGrid(const std::vector<Sphere>&, const std::vector<CuttingPlane>&);
  // Light at a point with unit normal; `own` is the sphere the point lies on (-1: none). to_key: unit vector.
  Illumination light_at(const Vec3& point, const Vec3& normal, const Vec3& to_key, int own) const;

 private:
  const std::vector<Sphere>& spheres_;
  Vec3 lower_ = Vec3::Zero();
  double cell_ = 1;
  int count_[3] = {0, 0, 0};
  std::vector<std::size_t> begin_;  // of each cell's list, one more at the end
  std::vector<int> list_;

  template <typename Visit>
  void for_each_cell_near(const Sphere&, Visit) const;
};

}  // namespace pigment::report
