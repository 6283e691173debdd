#pragma once
// Short names for the fixed-size vectors and matrices of the engine; aliases only.
#include <Eigen/Core>
#include <vector>

namespace pigment {
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec3Array = std::vector<Vec3>;  // one entry a particle
}  // namespace pigment
