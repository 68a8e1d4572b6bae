// Random vectors and angles.
#pragma once

#include <Eigen/Core>

#include "agent/base/random.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::triangulation {

class Random : public base::Random {
 public:
  using base::Random::Random;

  Eigen::Vector2d normal_2() {
    const double x = normal();
    return {x, normal()};
  }
  Eigen::Vector3d normal_3() {
    const Eigen::Vector2d xy = normal_2();
    return {xy.x(), xy.y(), normal()};
  }
};

/// Both angles normal about 0.
inline geometry::HeadAngles random_angles(double sigma_rad, Random& random) {
  const Eigen::Vector2d error = sigma_rad * random.normal_2();
  return {error.x(), error.y()};
}

}  // namespace gazed::triangulation
