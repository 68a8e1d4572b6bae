// Measures the errors of a registration over draws of the noise.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <gmock/gmock.h>
#include <string>

#include "bench.hpp"

namespace gazed::tracking::registration_test {

// The goal for clean images with camera noise of 2 levels: at 1 m and 0.1 rad this is 2 % of the
// range, below what the joints cost.
inline constexpr double error_max_px = 0.05;
// Mean over noise: what is left is the model and the sampling of sharp edges.
inline constexpr double bias_max_px = 0.03;
// Over noise of 2 levels; the smallest object has 38 px of outline.
inline constexpr double spread_max_px = 0.02;

struct Errors {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d spread = Eigen::Vector2d::Zero();  // standard deviation about the mean
  Eigen::Vector2d rms = Eigen::Vector2d::Zero();
  Eigen::Vector2d normalised = Eigen::Vector2d::Zero();  // root mean square of error / sigma
  double worst_px = 0.0;
  int refused = 0;
  std::string reason;
};

class RegistrationTest : public testing::Test {
 protected:
  // The errors of pixel_2 over `draws` of the noise. The angles of look 2 are reported as
  // move + joint_error.
  Errors measure(const Scene& scene, geometry::HeadAngles move, const Capture& capture_1,
                 const Capture& capture_2, int draws, geometry::HeadAngles joint_error = {}) {
    Registration registration({scene.camera, scene.head, bench.rig.uncertainty}, {});
    const Radiance look_1 = look(scene, scene.head_1), look_2 = look(scene, move);
    Errors errors;
    Eigen::Vector2d squares = Eigen::Vector2d::Zero();
    int found = 0;
    for (int draw = 0; draw < draws; ++draw) {
      const Shot shot_1 = expose(look_1, capture_1, bench.random);
      Shot shot_2 = expose(look_2, capture_2, bench.random);
      shot_2.head = move + joint_error;
      const auto pixel_1 =
          registration.choose_target(shot_1.view(), scene.object_px + winner_error);
      if (!pixel_1 || !on_object(scene, *pixel_1)) {
        ++errors.refused;
        errors.reason = pixel_1 ? "pixel_1 is not on the object" : "no target chosen";
        continue;
      }
      const RegistrationResult result = registration.find(shot_2.view());
      if (!result.match) {
        ++errors.refused;
        errors.reason = result.reason;
        continue;
      }
      ++found;
      const Eigen::Vector2d error = result.match->pixel_2 - true_pixel_2(scene, move, *pixel_1);
      errors.mean += error;
      squares += error.cwiseAbs2();
      errors.normalised += error.cwiseAbs2().cwiseQuotient(result.match->covariance_px2.diagonal());
      errors.worst_px = std::max(errors.worst_px, error.norm());
    }
    errors.mean /= found;
    errors.spread = (squares / found - errors.mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    errors.rms = (squares / found).cwiseSqrt();
    errors.normalised = (errors.normalised / found).cwiseSqrt();
    return errors;
  }

  static void expect_accurate(const Errors& errors) {
    EXPECT_EQ(errors.refused, 0) << errors.reason;
    EXPECT_LT(errors.worst_px, error_max_px);
    EXPECT_LT(errors.mean.norm(), bias_max_px);
    EXPECT_LT(errors.spread.maxCoeff(), spread_max_px);
  }

  Bench bench;
  const Capture clean;
  const Capture noisy{.noise_levels = 2.0};
};

}  // namespace gazed::tracking::registration_test
