// The lens for any number type: doubles for camera.hpp, and what a solver differentiates with.
#pragma once

#include <Eigen/Core>

namespace gazed::geometry {

/// u' = u (1 + k1 s + k2 s^2 + k3 s^3) + tangential part, s = |u|^2, for a point u of the plane
/// z = 1. `distortion`: k1, k2, p1, p2, k3.
template <class T>
[[nodiscard]] Eigen::Matrix<T, 2, 1> distorted(const T* distortion,
                                               const Eigen::Matrix<T, 2, 1>& u) {
  const T &k1 = distortion[0], &k2 = distortion[1], &p1 = distortion[2], &p2 = distortion[3],
          &k3 = distortion[4];
  const T &x = u.x(), &y = u.y();
  const T s = x * x + y * y;
  const T radial = 1.0 + s * (k1 + s * (k2 + s * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
          y * radial + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y};
}

}  // namespace gazed::geometry
