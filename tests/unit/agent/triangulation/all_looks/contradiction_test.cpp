// Looks that contradict each other: who is believed, and from where on it is a contradiction.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

#include "agent/triangulation/all_looks/locate.hpp"

#include "tests/unit/agent/triangulation/rooms.hpp"

namespace gazed::triangulation::all_looks::contradiction_test {
namespace {

using testing::HasSubstr;

constexpr double range_m = 0.6;
constexpr double prior_m = 1e-5;  // of the weak priors of the inverse depths

/// Without any error, but believed to have them.
Room exact_room(std::size_t later_looks) {
  Random random(31);
  RoomModel model{.looks = later_looks + 1, .range_m = range_m};
  model.exact = true;
  return random_room(model, random);
}

/// As a look would see a target that is somewhere else.
void move_target(Room& room, std::size_t look, const Eigen::Vector3d& by_m) {
  const geometry::Pose cam = geometry::cam_from_torso(room.true_head, room.true_readings[look]);
  room.looks[look].pixel =
      geometry::project(room.true_camera, cam * (room.torso_point_m + by_m)).value();
}

/// On look 1's ray, so that a pair by itself sees nothing wrong.
void move_along_the_ray(Room& room, std::size_t look, double share_of_range) {
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(room.true_head, room.true_readings[0]).inverse();
  move_target(room, look, share_of_range * (room.torso_point_m - torso_from_cam1.translation));
}

// The looks that are believed must be more than those that are not: the last `wrong` of `later`
// looks see the target elsewhere, each somewhere else, up to the first number that is no minority.
template <class Move>
void expect_the_majority(Move move) {
  for (std::size_t later = 2; later <= 7; ++later) {
    const Room exact = exact_room(later);
    Room room = exact;
    for (std::size_t wrong = 1; wrong <= (later + 1) / 2; ++wrong) {
      move(room, later + 1 - wrong, wrong);
      for (const Estimate& estimate : {room.locate(), room.locate_without_features()}) {
        const PointEstimate& point = estimate.point;
        const std::string what =
            std::to_string(wrong) + " of " + std::to_string(later) + ": " + point.reason;
        if (later - wrong > wrong) {
          EXPECT_EQ(point.status, Status::located) << what;
          EXPECT_NEAR(point.range_m, range_m, prior_m) << what;
          EXPECT_EQ(estimate.looks_used, later + 1 - wrong) << what;
        } else {
          EXPECT_EQ(point.status, Status::target_lost) << what;
          EXPECT_EQ(estimate.looks_used, 0U) << what;
        }
      }
    }
  }
}

TEST(Contradiction, TheMajorityIsBelievedAndNobodyWithoutOne) {
  expect_the_majority([](Room& room, std::size_t look, std::size_t count) {
    const double sign = count % 2 == 0 ? 1.0 : -1.0;
    const double size_m = 0.03 + 0.01 * static_cast<double>(count);
    move_target(room, look, sign * size_m * Eigen::Vector3d(0.0, 1.0, 0.4));
  });
}

TEST(Contradiction, SoItIsWhereEachPairByItselfSeesNothingWrong) {
  expect_the_majority([](Room& room, std::size_t look, std::size_t count) {
    constexpr std::array shares{-0.4, 1.5, -0.6, -0.75};
    move_along_the_ray(room, look, shares.at(count - 1));
  });
}

// One look in a thousand is dropped by chance: 99.9 % of chi-square with two degrees of freedom.
TEST(Contradiction, BeginsWhereOneInAThousandLooksIsByChance) {
  const Room exact = exact_room(7);
  for (const double gate_widening : {1.0, 2.0}) {
    const Gate gate{.epipolar_chi2_max = gate_widening * 10.828};
    for (const geometry::Pixel& direction :
         {geometry::Pixel(1.0, 0.0), geometry::Pixel(0.0, 1.0)}) {
      double agrees_px = 0.0, contradicts_px = 50.0;
      const auto with_a_look_off = [&](double by_px) {
        Room room = exact;
        room.looks[4].pixel += by_px * direction;
        return room.locate_without_features(gate);
      };
      for (int i = 0; i < 30; ++i) {
        const double middle_px = 0.5 * (agrees_px + contradicts_px);
        const bool agrees = with_a_look_off(middle_px).looks_used == 8;
        (agrees ? agrees_px : contradicts_px) = middle_px;
      }
      EXPECT_GT(agrees_px, 1.0);
      const Estimate just_dropped = with_a_look_off(contradicts_px);
      EXPECT_NEAR(just_dropped.looks[4].chi2, gate_widening * 13.816, 0.01);
      EXPECT_THAT(just_dropped.point.reason, HasSubstr("look 5 left out"));
    }
  }
}

/// A feature that is seen in look 1 and once more, off its epipolar line by so many of its sigmas.
Room room_with_a_feature_off_by(double sigmas) {
  Room room = exact_room(7);
  const auto elsewhere = std::numeric_limits<double>::quiet_NaN();
  for (FeatureObservations& feature : room.features) {
    const auto seen = [&](std::size_t k) { return feature.pixel[k].allFinite(); };
    std::size_t later = 1;
    while (later < room.looks.size() && !seen(later)) ++later;
    if (later == room.looks.size()) continue;
    for (std::size_t k = later + 1; k < room.looks.size(); ++k)
      feature.pixel[k].setConstant(elsewhere);
    const geometry::Pose later_from_1 =
        geometry::cam_from_torso(room.true_head, room.true_readings[later]) *
        geometry::cam_from_torso(room.true_head, room.true_readings[0]).inverse();
    const Eigen::Vector3d far =
        later_from_1.rotation *
        geometry::normalise(room.true_camera, feature.pixel[0]).value().homogeneous();
    const geometry::Pixel along =
        (feature.pixel[later] - geometry::project(room.true_camera, far).value()).normalized();
    feature.pixel[later] += sigmas * feature.sigma_px * geometry::Pixel(-along.y(), along.x());
    return room;
  }
  throw std::logic_error("no feature is seen twice");
}

// The features' limit is 99.9 % of chi-square, too, of what is left when this one has pulled at the
// robot a little, one among a hundred.
TEST(Contradiction, OfAFeatureBeginsWhereOneInAThousandIsByChance) {
  const double sigmas = std::sqrt(10.828);
  const std::size_t all = room_with_a_feature_off_by(0.0).locate().features_used;
  EXPECT_EQ(room_with_a_feature_off_by(0.95 * sigmas).locate().features_used, all);
  EXPECT_EQ(room_with_a_feature_off_by(1.1 * sigmas).locate().features_used, all - 1);
}

TEST(Contradiction, WhatALookWasFoundWithCounts) {
  Room room = exact_room(4);
  const double before = room.locate().point.inverse_range_sigma_per_m;
  for (Look& look : room.looks) look.covariance_px2 *= 100.0;
  EXPECT_GT(room.locate().point.inverse_range_sigma_per_m, 2.0 * before);
}

TEST(Contradiction, TheParallaxIsTheGreatestOfAllLooks) {
  const Room room = exact_room(4);
  double greatest_rad = 0.0;
  const auto ray = [&](std::size_t k) {
    const geometry::Pose torso_from_cam =
        geometry::cam_from_torso(room.true_head, room.true_readings[k]).inverse();
    return Eigen::Vector3d((room.torso_point_m - torso_from_cam.translation).normalized());
  };
  for (std::size_t k = 1; k < room.looks.size(); ++k)
    greatest_rad = std::max(greatest_rad, std::acos(ray(0).dot(ray(k))));
  EXPECT_NEAR(room.locate().point.parallax_rad, greatest_rad, 1e-5);
}

// Look 1's pixel defines the target: beside it, what an uncalibrated robot's centre may be off by
// is eight thousand of its standard deviations.
TEST(Contradiction, AnUncalibratedRobotsTwoLooksAgree) {
  Random random(38);
  for (int i = 0; i < 50; ++i) {
    Room room = random_room({.moves = Moves::pair, .range_m = 0.3, .features = 0}, random);
    room.rig.uncertainty.focal_sigma_px = 10.0;
    room.rig.uncertainty.centre_sigma_px = 8.0;
    room.rig.uncertainty.mount_offset_sigma_m = 2e-3;
    room.rig.uncertainty.mount_rotation_sigma_rad = 0.03;
    const auto estimate = room.locate_without_features();
    EXPECT_TRUE(std::isfinite(estimate.chi2)) << i;
    EXPECT_EQ(estimate.looks_used, 2U) << estimate.point.reason;
  }
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::contradiction_test
