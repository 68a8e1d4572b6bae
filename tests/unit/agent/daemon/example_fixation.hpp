// A located fixation with a different number in every field.
#pragma once

#include <Eigen/Core>

#include "agent/cycle/fixation.hpp"

namespace gazed::daemon {

inline cycle::Fixation example_fixation() {
  cycle::Fixation fixation;
  fixation.utime_us = 1'700'000'000'000'000;
  fixation.number = 3;
  fixation.views = 2;
  fixation.status = cycle::Status::located;
  fixation.reason = "relative sigma 5 %, a \"quoted\" word";
  fixation.estimate.point_m = {0.01, 0.02, 0.30};
  fixation.estimate.covariance_m2 = Eigen::Matrix3d::Identity() * 1e-4;
  fixation.estimate.torso_point_m = {0.35, 0.04, 0.19};
  fixation.estimate.torso_covariance_m2 << 4e-4, 1e-5, 2e-5, 1e-5, 9e-4, 3e-5, 2e-5, 3e-5, 1e-4;
  fixation.estimate.range_m = 0.30;
  fixation.estimate.range_sigma_m = 0.018;
  fixation.estimate.inverse_range_per_m = 1.0 / 0.30;
  fixation.estimate.inverse_range_sigma_per_m = 0.2;
  fixation.estimate.parallax_rad = 0.033;
  fixation.estimate.residual_px = 0.12;
  fixation.pixel_1 = {319.5, 240.25};
  fixation.pixel_2 = {400.75, 158.5};
  fixation.head_1 = {0.001, -0.002};
  fixation.head_2 = {0.108, 0.109};
  fixation.saliency = 0.75F;
  fixation.distinctness = 0.5F;
  fixation.duration_s = 0.2;
  return fixation;
}

}  // namespace gazed::daemon
