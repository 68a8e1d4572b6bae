#include "agent/tracking/ball.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

#include "agent/base/image.hpp"

namespace gazed::tracking::ball_test {
namespace {

constexpr double focal_px = 550.0, radius_px = 50.0, radius_per_m = 0.3, inverse_depth_per_m = 3.0;
constexpr double shift_m = 0.04;
// Of slopes that tell nothing.
constexpr double unknown = 1e6;

/// Of an ellipse in the middle of the frame, so much wider than high.
Relief relief_of(double width_by_height) {
  const geometry::Pixel centre(320.0, 240.0);
  base::Image image(640, 480, base::PixelFormat::grey);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double across = (x - centre.x()) / width_by_height, down = y - centre.y();
      image.row(y)[x] = std::hypot(across, down) < radius_px ? 40 : 200;
    }
  }
  ObjectMask object;
  EXPECT_TRUE(object.segment(image.view(), centre));
  geometry::CameraModel camera;
  camera.focal_px = {focal_px, focal_px};
  camera.centre_px = centre;
  return {object, camera};
}

/// After so many looks in which the inside stands out by so many radii, each known to `sigma`.
BelievedBall after(int looks, double radii, double sigma, double width_by_height = 1.0) {
  BelievedBall dut;
  dut.begin(relief_of(width_by_height));
  WarpFit fit;
  fit.warp.inverse_depth_per_m = inverse_depth_per_m;
  fit.warp.relief_per_m = radii * radius_per_m;
  fit.relief_prior_sigma_per_m = radius_per_m;
  fit.shape_covariance.diagonal() << unknown, unknown, std::pow(sigma * radius_per_m, 2.0);
  for (int k = 0; k < looks; ++k) dut.see(fit, {});
  return dut;
}

// A fifth, whose standard deviation is twice that.
constexpr double undecided = 0.22, undecided_tolerance = 0.02;

TEST(BelievedBall, WhatTellsNothingMayBeEither) {
  const double square = std::pow(radius_px / focal_px, 2.0);
  const BelievedBall dut = after(0, 0.0, 1.0);
  EXPECT_NEAR(dut.probability(), undecided, undecided_tolerance);
  EXPECT_NEAR(dut.centre_correction(), undecided * square, 0.05 * square);
  EXPECT_GT(dut.centre_correction_sigma(), 0.4 * square);
}

TEST(BelievedBall, WhatDoesNotStandOutIsFlat) {
  EXPECT_LT(after(4, 0.0, 0.05).probability(), 0.2);
}

// A pattern stands out by the radius, a mirrored lamp by about half of it.
TEST(BelievedBall, WhatStandsOutIsABall) {
  EXPECT_GT(after(4, 0.9, 0.05).probability(), 0.9);
  EXPECT_GT(after(4, 0.4, 0.05).probability(), 0.6);
}

TEST(BelievedBall, ALookThatHardlyKnowsSaysLittle) {
  EXPECT_NEAR(after(1, 0.0, 0.95).probability(), undecided, 0.1);
}

/// After looks from both sides at what has these slopes in each of them, against the plane that
/// faces camera 1.
BelievedBall seen_from_both_sides(const std::array<double, 2>& slopes_per_m) {
  BelievedBall dut;
  dut.begin(relief_of(1.0));
  for (std::size_t k = 0; k < 2; ++k) {
    WarpFit fit;
    fit.warp.inverse_depth_per_m = inverse_depth_per_m;
    fit.warp.slope_per_m = {slopes_per_m[k], 0.0};
    fit.relief_prior_sigma_per_m = radius_per_m;
    fit.shape_covariance.diagonal() << 1e-4, 1e-4, radius_per_m * radius_per_m;
    PatchMotion motion;
    motion.cam2_from_cam1.translation = {k == 0 ? shift_m : -shift_m, 0.0, 0.0};
    dut.see(fit, motion);
  }
  return dut;
}

// t / (2 D^2).
TEST(BelievedBall, IsRoundFromEitherSide) {
  const double slope_per_m = 0.5 * shift_m * inverse_depth_per_m * inverse_depth_per_m;
  EXPECT_GT(seen_from_both_sides({slope_per_m, -slope_per_m}).probability(), 0.9);
}

TEST(BelievedBall, WhatKeepsItsPlaneIsADisc) {
  EXPECT_LT(seen_from_both_sides({0.0, 0.0}).probability(), 0.05);
  EXPECT_LT(seen_from_both_sides({0.2, 0.2}).probability(), 0.05);
}

TEST(BelievedBall, AnEllipseIsRarelyOne) {
  EXPECT_LT(after(0, 0.0, 1.0, 1.2).probability(), 0.1);
  EXPECT_GT(after(4, 0.9, 0.05, 1.2).probability(), 0.5);
}

TEST(BelievedBall, ANewTargetIsJudgedAnew) {
  BelievedBall dut = after(4, 0.0, 0.05);
  dut.begin(relief_of(1.0));
  EXPECT_NEAR(dut.probability(), undecided, undecided_tolerance);
}

}  // namespace
}  // namespace gazed::tracking::ball_test
