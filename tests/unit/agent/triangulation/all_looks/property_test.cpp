// Whatever comes in: no crash, a status, and all of it or nothing.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "agent/triangulation/all_looks/locate.hpp"

#include "tests/unit/agent/triangulation/estimates.hpp"
#include "tests/unit/agent/triangulation/rooms.hpp"

namespace gazed::triangulation::all_looks::property_test {
namespace {

constexpr int problems = GAZED_RANDOM_PROBLEMS / 200;

/// What a status promises is there, and what it denies is not.
void expect_whole(const Estimate& estimate) {
  const PointEstimate& point = estimate.point;
  switch (point.status) {
    case Status::located:
      expect_filled(point, Filled::position);
      EXPECT_GT(point.range_m, 0.0);
      EXPECT_TRUE(point.torso_covariance_m2.allFinite());
      break;
    case Status::uncertain:
      EXPECT_TRUE(std::isfinite(point.inverse_range_sigma_per_m));
      expect_filled(point, std::isfinite(point.range_m) ? Filled::position : Filled::inverse_range);
      break;
    case Status::behind_camera:
      EXPECT_FALSE(std::isfinite(point.range_m));
      break;
    default:
      EXPECT_FALSE(std::isfinite(point.inverse_range_per_m)) << point.reason;
      EXPECT_FALSE(point.reason.empty());
  }
  EXPECT_LE(estimate.looks_used, looks_max);
  EXPECT_LE(estimate.features_used + estimate.features_rejected, features_max);
}

/// Anything that a double can be, and what is nearly right.
double anything(double right, Random& random) {
  switch (static_cast<int>(random.uniform(0.0, 9.0))) {
    case 0:
      return not_a_number;
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return -1e300;
    case 3:
      return 1e-300;
    case 4:
      return 0.0;
    case 5:
      return right + random.uniform(-500.0, 500.0);
    default:
      return right + 0.1 * random.normal();
  }
}

TEST(AllLooksProperty, GarbageInAnyPlaceGivesAStatus) {
  Random random(61);
  for (int i = 0; i < problems; ++i) {
    Room room = random_room({.looks = 2 + static_cast<std::size_t>(random.uniform(0.0, 7.0)),
                             .range_m = 0.5,
                             .features = 30},
                            random);
    const double share = random.uniform(0.0, 0.3);
    const auto spoil = [&](double& number) {
      if (random.uniform() < share) number = anything(number, random);
    };
    for (Look& look : room.looks) {
      spoil(look.pixel.x());
      spoil(look.pixel.y());
      spoil(look.head.yaw_rad);
      spoil(look.head.pitch_rad);
      if (random.uniform() < share) look.covariance_px2(0, 1) = anything(0.0, random);
      if (random.uniform() < share) look.covariance_px2(1, 1) = anything(0.2, random);
    }
    for (FeatureObservations& track : room.features) {
      for (geometry::Pixel& pixel : track.pixel) {
        spoil(pixel.x());
        spoil(pixel.y());
      }
      spoil(track.sigma_px);
    }
    expect_whole(room.locate());
  }
}

TEST(AllLooksProperty, AnyRobotGivesAStatus) {
  Random random(62);
  for (int i = 0; i < problems; ++i) {
    Room room = random_room({.looks = 4, .range_m = 0.5, .features = 20}, random);
    const auto spoil = [&](double& number) {
      if (random.uniform() < 0.1) number = anything(number, random);
    };
    geometry::Uncertainty& u = room.rig.uncertainty;
    for (double* sigma :
         {&u.pixel_sigma_px, &u.encoder_sigma_rad, &u.zero_sigma_rad, &u.focal_sigma_px,
          &u.centre_sigma_px, &u.mount_offset_sigma_m, &u.mount_rotation_sigma_rad}) {
      spoil(*sigma);
    }
    for (int axis = 0; axis < 3; ++axis) {
      spoil(room.rig.head.mount_offset_m(axis));
      spoil(room.rig.head.mount_rotation_rad(axis));
    }
    spoil(room.rig.camera.focal_px.x());
    spoil(room.rig.camera.centre_px.y());
    spoil(room.rig.camera.distortion[0]);
    spoil(room.rig.head.zero.yaw_rad);
    expect_whole(room.locate());
  }
}

TEST(AllLooksProperty, LooksAndFeaturesOfNothingGiveAStatus) {
  Random random(63);
  for (int i = 0; i < problems; ++i) {
    Room room = random_room({.looks = 5, .range_m = 0.5, .features = 40}, random);
    for (Look& look : room.looks) {
      look.head = {random.uniform(-2.0, 2.0), random.uniform(-0.7, 0.5)};
      look.pixel = {random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)};
    }
    for (FeatureObservations& track : room.features) {
      for (geometry::Pixel& pixel : track.pixel) {
        pixel = {random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)};
      }
    }
    const Estimate estimate = room.locate();
    expect_whole(estimate);
    EXPECT_NE(estimate.refinement, Refinement::used);
  }
}

/// Puts the first so many features behind the camera, at half a metre; returns how many of them a
/// later look sees.
std::size_t put_behind(Room& room, std::size_t count) {
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(room.true_head, room.true_readings[0]).inverse();
  std::size_t behind = 0;
  for (std::size_t i = 0; i < count; ++i) {
    FeatureObservations& track = room.features[i];
    const Eigen::Vector2d ray = geometry::normalise(room.true_camera, track.pixel[0]).value();
    const Eigen::Vector3d torso_point_m =
        torso_from_cam1 * Eigen::Vector3d(-0.5 * ray.x(), -0.5 * ray.y(), -0.5);
    bool seen = false;
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      const Eigen::Vector3d there =
          -(geometry::cam_from_torso(room.true_head, room.true_readings[k]) * torso_point_m);
      track.pixel[k] = geometry::project(room.true_camera, there)
                           .value_or(geometry::Pixel::Constant(not_a_number));
      seen = seen || room.true_camera.contains(track.pixel[k]);
    }
    behind += seen ? 1 : 0;
  }
  return behind;
}

TEST(AllLooksProperty, FeaturesBehindTheCameraAreNone) {
  Random random(64);
  Room room = random_room({.range_m = 0.5, .exact = true}, random);
  const std::size_t behind = put_behind(room, 30);
  const Estimate estimate = room.locate();
  expect_whole(estimate);
  EXPECT_EQ(estimate.refinement, Refinement::used);
  EXPECT_GE(estimate.features_rejected, behind);
  EXPECT_NEAR(estimate.point.range_m, 0.5, 1e-5);
}

/// They agree with each other and with the encoders, and are of no point all the same.
TEST(AllLooksProperty, ABackgroundMostlyBehindTheCameraIsDistrusted) {
  Random random(64);
  Room room = random_room({.range_m = 0.5, .exact = true}, random);
  const std::size_t behind = put_behind(room, 60);
  const Estimate estimate = room.locate();
  expect_whole(estimate);
  EXPECT_EQ(estimate.refinement, Refinement::distrusted);
  EXPECT_EQ(estimate.features_used, 0U);
  EXPECT_GT(estimate.features_rejected, behind);
  EXPECT_NEAR(estimate.point.range_m, 0.5, 1e-5);
}

/// The looks after the first, and the features, may come in any order.
TEST(AllLooksProperty, TheOrderDoesNotMatter) {
  constexpr double rounding = 1e-9;
  Random random(65);
  for (int i = 0; i < problems; ++i) {
    const Room room = random_room({.range_m = 0.5,
                                   .features = 60,
                                   .encoder_sigma_rad = i % 2 == 0 ? 1.5e-3 : 20e-3,
                                   .wrong_share = 0.2},
                                  random);
    Room other = room;
    std::reverse(other.looks.begin() + 1, other.looks.end());
    for (FeatureObservations& track : other.features) {
      std::reverse(track.pixel.begin() + 1,
                   track.pixel.begin() + static_cast<std::ptrdiff_t>(room.looks.size()));
    }
    std::rotate(other.features.begin(), other.features.begin() + 17, other.features.end());
    const Estimate a = room.locate(), b = other.locate();
    ASSERT_EQ(a.point.status, b.point.status);
    ASSERT_EQ(a.features_used, b.features_used);
    EXPECT_NEAR(a.point.inverse_range_per_m, b.point.inverse_range_per_m, rounding);
    EXPECT_NEAR(a.point.inverse_range_sigma_per_m, b.point.inverse_range_sigma_per_m, rounding);
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      EXPECT_LT(geometry::greatest_difference(a.head[k], b.head[room.looks.size() - k]), rounding);
    }
  }
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::property_test
