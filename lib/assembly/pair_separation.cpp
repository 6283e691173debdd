#include "assembly/pair_separation.h"

#include <algorithm>
#include <cmath>

#include "solve/lanes.h"

namespace pigment::assembly {

namespace {

using solve::Lanes;
using solve::lanes;
using solve::load;
using solve::transpose;
using Pairs = std::span<const neighbours::IndexPair>;

// Calls a kernel as it was compiled for this processor: the same bits either way.
template <typename Kernel, typename... Arguments>
PIGMENT_WIDE void run_wide(const Arguments&... arguments) {
  Kernel::run(arguments...);
}
template <typename Kernel, typename... Arguments>
void run(const Arguments&... arguments) {
  if (solve::wide_processor()) run_wide<Kernel>(arguments...);
  else Kernel::run(arguments...);
}

// Four pairs' particles; beyond the last pair, that one again.
struct Four {
  std::size_t first, count;
  std::int32_t i[lanes], j[lanes];
};
PIGMENT_INLINE void take(Pairs pairs, std::size_t first, Four& f) {
  f.first = first;
  f.count = std::min<std::size_t>(lanes, pairs.size() - first);
  for (std::size_t q = 0; q < lanes; ++q) {
    const neighbours::IndexPair& pair = pairs[first + std::min(q, f.count - 1)];
    f.i[q] = pair.i;
    f.j[q] = pair.j;
  }
}

struct Vector {
  Lanes x, y, z;
};
PIGMENT_INLINE void gather(const double* four, const std::int32_t (&index)[lanes], Vector& v, Lanes& last) {
  load(v.x, four + 4 * static_cast<std::size_t>(index[0]));
  load(v.y, four + 4 * static_cast<std::size_t>(index[1]));
  load(v.z, four + 4 * static_cast<std::size_t>(index[2]));
  load(last, four + 4 * static_cast<std::size_t>(index[3]));
  transpose(v.x, v.y, v.z, last);
}
PIGMENT_INLINE void gather(std::span<const Vec3> array, const Four& f, Vector& v) {
  for (std::size_t q = 0; q < lanes; ++q) {
    const Vec3& one = array[f.first + std::min(q, f.count - 1)];
    v.x[q] = one.x();
    v.y[q] = one.y();
    v.z[q] = one.z();
  }
}
PIGMENT_INLINE void gather(std::span<const double> array, const Four& f, Lanes& v) {
  for (std::size_t q = 0; q < lanes; ++q) v[q] = array[f.first + std::min(q, f.count - 1)];
}
PIGMENT_INLINE void scatter(const Vector& v, const Four& f, std::span<Vec3> array) {
  for (std::size_t q = 0; q < f.count; ++q) array[f.first + q] = {v.x[q], v.y[q], v.z[q]};
}
PIGMENT_INLINE void scatter(const Lanes& v, const Four& f, std::span<double> array) {
  for (std::size_t q = 0; q < f.count; ++q) array[f.first + q] = v[q];
}

// From i to j, and the last number of both.
PIGMENT_INLINE void difference(const double* four, const Four& f, Vector& d, Lanes& last_i, Lanes& last_j) {
  Vector from;
  gather(four, f.i, from, last_i);
  gather(four, f.j, d, last_j);
  d.x -= from.x;
  d.y -= from.y;
  d.z -= from.z;
}
PIGMENT_INLINE void difference(const std::vector<Sphere>& sphere, const Four& f, Vector& d, Lanes& radius_i, Lanes& radius_j) {
  difference(&sphere.data()->x, f, d, radius_i, radius_j);
}

PIGMENT_INLINE void length(const Vector& v, Lanes& r) {
  r = v.x * v.x + v.y * v.y + v.z * v.z;
  for (int q = 0; q < lanes; ++q) r[q] = std::sqrt(r[q]);
}

// Added and taken away it rounds to the nearest whole number, ties to even: the sum's last bit is a one.
constexpr double magic = 0x1.8p52;
PIGMENT_INLINE void take_nearest(Lanes& d, double width) { d -= width * ((d / width + magic) - magic); }

struct Separations {
  static PIGMENT_INLINE void run(const Cell& cell, const std::vector<Sphere>& sphere, Pairs pairs, std::span<Vec3> normal, std::span<double> gap,
                                 std::span<Vec3> separation) {
    for (std::size_t first = 0; first < pairs.size(); first += lanes) {
      Four f;
      take(pairs, first, f);
      Vector d;
      Lanes radius_i, radius_j, r;
      difference(sphere, f, d, radius_i, radius_j);
      take_nearest(d.x, cell.width_x);
      take_nearest(d.y, cell.width_y);
      length(d, r);
      scatter(r - radius_i - radius_j, f, gap);
      if (!separation.empty()) scatter(d, f, separation);
      scatter(Vector{d.x / r, d.y / r, d.z / r}, f, normal);
    }
  }
};

struct TwoStepSeparations {
  static PIGMENT_INLINE void run(const Cell& cell, const TwoStepSpheres& spheres, Pairs pairs, const TwoStepPairs& out) {
    for (std::size_t first = 0; first < pairs.size(); first += lanes) {
      Four f;
      take(pairs, first, f);
      Vector now, before, from, predicted;
      Lanes radius_i, radius_j, r;
      difference(spheres.before, f, before, radius_i, radius_j);
      difference(spheres.from, f, from, radius_i, radius_j);
      difference(spheres.predicted, f, predicted, radius_i, radius_j);
      difference(spheres.now, f, now, radius_i, radius_j);
      Lanes x = now.x, y = now.y;
      take_nearest(x, cell.width_x);
      take_nearest(y, cell.width_y);
      x -= now.x;
      y -= now.y;
      for (Vector* v : {&now, &before, &from, &predicted}) {
        v->x += x;
        v->y += y;
      }
      const Lanes contact = radius_i + radius_j;
      length(now, r);
      scatter(r - contact, f, out.gap);
      length(before, r);
      scatter(r - contact, f, out.gap_before);
      length(predicted, r);
      scatter(r - contact, f, out.gap_predicted);
      const Vector n{predicted.x / r, predicted.y / r, predicted.z / r};
      length(from, r);
      scatter(r - contact, f, out.gap_from);
      scatter(n.x * from.x + n.y * from.y + n.z * from.z - r, f, out.turn);
      scatter(n, f, out.normal);
      scatter(from, f, out.separation);
    }
  }
};

PIGMENT_INLINE void motion(const double* velocity, double dt, const Four& f, Vector& m) {
  Lanes unused_i, unused_j;
  difference(velocity, f, m, unused_i, unused_j);
  m.x *= dt;
  m.y *= dt;
  m.z *= dt;
}

struct MovedGaps {
  // The separation is given, or lies along the normal and is as long as the gap and both radii.
  static PIGMENT_INLINE void run(const double* velocity, double dt, const std::vector<Sphere>& sphere, Pairs pairs, std::span<const Vec3> separation,
                                 std::span<const double> gap_begin, std::span<const Vec3> normal, std::span<double> gap, std::span<double> along) {
    for (std::size_t first = 0; first < pairs.size(); first += lanes) {
      Four f;
      take(pairs, first, f);
      Vector n, m, d;
      Lanes radius_i, radius_j, r;
      for (std::size_t q = 0; q < lanes; ++q) {
        radius_i[q] = sphere[static_cast<std::size_t>(f.i[q])].radius;
        radius_j[q] = sphere[static_cast<std::size_t>(f.j[q])].radius;
      }
      gather(normal, f, n);
      motion(velocity, dt, f, m);
      if (separation.empty()) {
        gather(gap_begin, f, r);
        r = r + radius_i + radius_j;
        d = {n.x * r, n.y * r, n.z * r};
      } else {
        gather(separation, f, d);
      }
      d.x += m.x;
      d.y += m.y;
      d.z += m.z;
      length(d, r);
      scatter(r - radius_i - radius_j, f, gap);
      scatter(n.x * m.x + n.y * m.y + n.z * m.z, f, along);
    }
  }
};

struct LeastGaps {
  static PIGMENT_INLINE void run(const double* velocity, double dt, Pairs pairs, std::span<const double> gap_begin, std::span<const Vec3> normal,
                                 std::span<double> least) {
    for (std::size_t first = 0; first < pairs.size(); first += lanes) {
      Four f;
      take(pairs, first, f);
      Vector n, m;
      Lanes gap;
      gather(normal, f, n);
      gather(gap_begin, f, gap);
      motion(velocity, dt, f, m);
      scatter(gap + (n.x * m.x + n.y * m.y + n.z * m.z), f, least);
    }
  }
};

}  // namespace

void separations(const Cell& cell, const std::vector<Sphere>& sphere, Pairs pairs, std::span<Vec3> normal, std::span<double> gap,
                 std::span<Vec3> separation) {
  run<Separations>(cell, sphere, pairs, normal, gap, separation);
}

void separations(const Cell& cell, const TwoStepSpheres& spheres, Pairs pairs, const TwoStepPairs& out) {
  run<TwoStepSeparations>(cell, spheres, pairs, out);
}

void moved_gaps(const double* velocity, double dt, const std::vector<Sphere>& sphere, Pairs pairs, std::span<const Vec3> separation,
                std::span<const Vec3> normal, std::span<double> gap, std::span<double> along) {
  run<MovedGaps>(velocity, dt, sphere, pairs, separation, std::span<const double>(), normal, gap, along);
}

void moved_gaps(const double* velocity, double dt, const std::vector<Sphere>& sphere, Pairs pairs, std::span<const double> gap_begin,
                std::span<const Vec3> normal, std::span<double> gap, std::span<double> along) {
  run<MovedGaps>(velocity, dt, sphere, pairs, std::span<const Vec3>(), gap_begin, normal, gap, along);
}

void least_gaps(const double* velocity, double dt, Pairs pairs, std::span<const double> gap_begin, std::span<const Vec3> normal,
                std::span<double> least) {
  run<LeastGaps>(velocity, dt, pairs, gap_begin, normal, least);
}

}  // namespace pigment::assembly
