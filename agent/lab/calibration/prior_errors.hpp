// What is believed before any picture, as residuals of a fit: each in its own standard deviations.
#pragma once

#include <cstddef>
#include <vector>

#include "agent/geometry/head.hpp"
#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

/// (x - mean) / sigma of the numbers that are not held.
struct PriorError {
  Prior prior;
  std::vector<int> free;

  template <class T>
  bool operator()(const T* parameters, T* residual) const {
    for (std::size_t i = 0; i < free.size(); ++i) {
      const int at = free[i];
      residual[i] = (parameters[at] - T(prior.mean[at])) / T(prior.sigma[at]);
    }
    return true;
  }
};

/// (angle - measured angle) / sigma of both axes of a look.
struct LookError {
  geometry::HeadAngles measured;
  double sigma_rad;

  template <class T>
  bool operator()(const T* look, T* residual) const {
    residual[0] = (look[0] - T(measured.yaw_rad)) / T(sigma_rad);
    residual[1] = (look[1] - T(measured.pitch_rad)) / T(sigma_rad);
    return true;
  }
};

}  // namespace gazed::lab::calibration
