#include "agent/triangulation/all_looks/locate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/agent/triangulation/estimates.hpp"
#include "tests/unit/agent/triangulation/rooms.hpp"
#include "tests/unit/agent/triangulation/scenes.hpp"

namespace gazed::triangulation::all_looks::locate_test {
namespace {

using testing::HasSubstr;

/// Without any error, but believed to have them.
Room exact_room(std::size_t features = 100) {
  Random random(31);
  RoomModel model{.range_m = 0.6, .features = features};
  model.exact = true;
  return random_room(model, random);
}

/// As another look would see a target that has moved.
void move_target(Room& room, std::size_t look, const Eigen::Vector3d& by_m) {
  const geometry::Pose cam = geometry::cam_from_torso(room.true_head, room.true_readings[look]);
  room.looks[look].pixel =
      geometry::project(room.true_camera, cam * (room.torso_point_m + by_m)).value();
}

/// Of the weak priors of the inverse depths.
constexpr double prior_m = 1e-5;

TEST(AllLooks, ExactLooksGiveTheExactPoint) {
  const Room room = exact_room();
  for (const Estimate& estimate : {room.locate(), room.locate_without_features()}) {
    const PointEstimate& point = estimate.point;
    EXPECT_EQ(point.status, Status::located) << point.reason;
    expect_filled(point, Filled::position);
    EXPECT_LT((point.torso_point_m - room.torso_point_m).norm(), prior_m);
    EXPECT_NEAR(point.range_m, 0.6, prior_m);
    EXPECT_LT(point.residual_px, 1e-4);
    EXPECT_EQ(estimate.looks_used, 8U);
    EXPECT_EQ(estimate.degrees_of_freedom, 13);
    EXPECT_LT(estimate.chi2, 1e-6);
    EXPECT_THAT(point.reason, testing::Not(HasSubstr("left out")));
    for (std::size_t k = 0; k < room.looks.size(); ++k) {
      EXPECT_TRUE(estimate.looks[k].used);
      EXPECT_LT(geometry::greatest_difference(estimate.head[k], room.true_readings[k]), 1e-6);
    }
  }
}

TEST(AllLooks, CornersThatSlipMakeItLessSure) {
  Room room = exact_room();
  const double steady = room.locate().point.inverse_range_sigma_per_m;
  const double alone = room.locate_without_features().point.inverse_range_sigma_per_m;
  double before = steady;
  for (const double slip : {1.5, 3.0, 10.0}) {
    room.rig.uncertainty.corner_slip = slip;
    const PointEstimate point = room.locate().point;
    EXPECT_GT(point.inverse_range_sigma_per_m, before);
    EXPECT_LT(point.inverse_range_sigma_per_m, alone);
    EXPECT_NEAR(point.range_m, 0.6, prior_m);
    before = point.inverse_range_sigma_per_m;
  }
  // A target's own noise is not a corner's.
  EXPECT_EQ(room.locate_without_features().point.inverse_range_sigma_per_m, alone);
}

TEST(AllLooks, FeaturesMakeItSurer) {
  const Room room = exact_room();
  const Estimate with = room.locate(), without = room.locate_without_features();
  EXPECT_EQ(with.refinement, Refinement::used);
  EXPECT_GT(with.features_used, 80U);
  EXPECT_EQ(with.features_rejected, 0U);
  EXPECT_EQ(without.refinement, Refinement::none);
  EXPECT_EQ(without.features_used, 0U);
  EXPECT_LT(with.point.inverse_range_sigma_per_m, 0.85 * without.point.inverse_range_sigma_per_m);
}

TEST(AllLooks, AFewFeaturesAreNone) {
  Room room = exact_room();
  room.features.resize(7);
  EXPECT_EQ(room.locate().refinement, Refinement::none);
}

TEST(AllLooks, TheAnglesAreRefined) {
  Random random(32);
  double before = 0.0, after = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Room room = random_room({.encoder_sigma_rad = 20e-3}, random);
    const Estimate estimate = room.locate();
    ASSERT_EQ(estimate.refinement, Refinement::used);
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      // Of a later look against the first: a turn common to all looks moves nothing.
      const auto error = [&](geometry::HeadAngles first, geometry::HeadAngles later) {
        return later - first - (room.true_readings[k] - room.true_readings[0]);
      };
      before = std::max(before, std::abs(error(room.looks[0].head, room.looks[k].head).yaw_rad));
      after = std::max(after, std::abs(error(estimate.head[0], estimate.head[k]).yaw_rad));
    }
  }
  EXPECT_GT(before, 50e-3);
  EXPECT_LT(after, 12e-3);
}

TEST(AllLooks, AnotherObjectInOneLookIsDroppedAndNamed) {
  const Room exact = exact_room();
  for (std::size_t wrong = 1; wrong < exact.looks.size(); ++wrong) {
    Room room = exact;
    move_target(room, wrong, {0.0, 0.05, 0.02});
    const Estimate estimate = room.locate();
    const PointEstimate& point = estimate.point;
    EXPECT_EQ(point.status, Status::located) << point.reason;
    EXPECT_NEAR(point.range_m, 0.6, prior_m);
    EXPECT_EQ(estimate.looks_used, 7U);
    EXPECT_FALSE(estimate.looks[wrong].used);
    EXPECT_EQ(estimate.looks[wrong].status, Status::target_lost);
    EXPECT_THAT(point.reason, HasSubstr("look " + std::to_string(wrong + 1) + " left out"));
  }
}

TEST(AllLooks, ATargetThatMovesIsLost) {
  Room room = exact_room();
  for (std::size_t k = 1; k < room.looks.size(); ++k) {
    move_target(room, k, static_cast<double>(k) * Eigen::Vector3d(0.0, 0.01, 0.005));
  }
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::target_lost);
  expect_filled(estimate.point, Filled::residual);
  EXPECT_EQ(estimate.looks_used, 0U);
}

TEST(AllLooks, TwoLooksThatContradictEachOtherAreNoPoint) {
  Room room = exact_room();
  room.looks.resize(3);
  // Farther on look 1's ray: each pair by itself sees nothing wrong.
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(room.true_head, room.true_readings[0]).inverse();
  move_target(room, 2, 0.6 * (room.torso_point_m - torso_from_cam1.translation));
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::target_lost);
  EXPECT_THAT(estimate.point.reason, HasSubstr("contradict"));
}

TEST(AllLooks, WrongTracksAreRejected) {
  Random random(33);
  RoomModel model{.range_m = 0.6, .wrong_share = 0.3};
  for (int i = 0; i < 20; ++i) {
    const Room room = random_room(model, random);
    const Estimate estimate = room.locate();
    EXPECT_EQ(estimate.refinement, Refinement::used);
    EXPECT_GT(estimate.features_rejected, 20U);
    EXPECT_GT(estimate.features_used, 55U);
    const PointEstimate& point = estimate.point;
    EXPECT_LT(std::abs(point.inverse_range_per_m - room.inverse_range_per_m),
              4.0 * point.inverse_range_sigma_per_m);
  }
}

TEST(AllLooks, AOneTimeMismatchCostsOneLookOfItsTrack) {
  Room room = exact_room();
  const std::size_t before = room.locate().features_used;
  int mismatches = 0;
  for (FeatureObservations& track : room.features) {
    std::vector<std::size_t> seen;
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      if (track.pixel[k].allFinite()) seen.push_back(k);
    }
    if (seen.size() < 4) continue;
    track.pixel[seen[1]] += geometry::Pixel(9.0, -7.0);
    ++mismatches;
  }
  ASSERT_GT(mismatches, 5);
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.features_used, before);
  EXPECT_NEAR(estimate.point.range_m, 0.6, prior_m);
}

TEST(AllLooks, NoiseThatIsGreaterThanToldIsNoticed) {
  Random random(34);
  double told = 0.0, found = 0.0;
  for (int i = 0; i < 10; ++i) {
    Room room = random_room({.encoder_sigma_rad = 20e-3}, random);
    told += room.locate().point.inverse_range_sigma_per_m;
    for (FeatureObservations& track : room.features) track.sigma_px *= 0.5;
    const Estimate estimate = room.locate();
    EXPECT_EQ(estimate.refinement, Refinement::used);
    found += estimate.point.inverse_range_sigma_per_m;
  }
  EXPECT_NEAR(found, told, 0.05 * told);
}

TEST(AllLooks, FeaturesThatAreAnywhereAreDistrusted) {
  Random random(35);
  const Room room = random_room({.range_m = 0.6, .wrong_share = 1.0}, random);
  const Estimate estimate = room.locate(), without = room.locate_without_features();
  EXPECT_EQ(estimate.refinement, Refinement::distrusted);
  EXPECT_EQ(estimate.features_used, 0U);
  EXPECT_GT(estimate.features_rejected, 80U);
  EXPECT_EQ(estimate.point.inverse_range_per_m, without.point.inverse_range_per_m);
  EXPECT_EQ(estimate.point.reason, without.point.reason);
}

TEST(AllLooks, ABackgroundThatMovesIsDistrusted) {
  // As if the head had turned 30 mrad further than its encoders say, which know better.
  Room room = exact_room();
  for (FeatureObservations& track : room.features) {
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      track.pixel[k] += 18.0 * geometry::Pixel(k % 4 < 2 ? 1.0 : -1.0, k % 3 < 1 ? 1.0 : -1.0);
    }
  }
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.refinement, Refinement::distrusted);
  EXPECT_NEAR(estimate.point.range_m, 0.6, prior_m);
}

TEST(AllLooks, WithoutAnySigmaItStillAnswers) {
  Room room = exact_room();
  room.rig.uncertainty = {};
  for (const Estimate& estimate : {room.locate(), room.locate_without_features()}) {
    EXPECT_EQ(estimate.point.status, Status::located) << estimate.point.reason;
    EXPECT_NEAR(estimate.point.range_m, 0.6, 1e-7);
  }
}

TEST(AllLooks, ALookWithoutTheTargetStillTellsItsAngles) {
  Room room = exact_room();
  room.looks[3].pixel.x() = not_a_number;
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::located);
  EXPECT_EQ(estimate.looks[3].status, Status::invalid_input);
  EXPECT_FALSE(estimate.looks[3].used);
  EXPECT_EQ(estimate.looks_used, 7U);
  EXPECT_THAT(estimate.point.reason, HasSubstr("look 4 left out: pixel 2"));
}

TEST(AllLooks, LooksFromOnePlaceAreDegenerate) {
  Room room = exact_room(0);
  room.looks.resize(3);
  room.looks[1] = room.looks[2] = room.looks[0];
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::degenerate);
  expect_filled(estimate.point, Filled::nothing);
}

/// The encoders alone cannot tell a move of 0.1 rad from none, with features they can.
TEST(AllLooks, WhatIsDegenerateIsJudgedByTheRefinedAngles) {
  Random random(36);
  const Room room = random_room(
      {.moves = Moves::pair, .range_m = 0.3, .encoder_sigma_rad = 30e-3, .centred = true}, random);
  EXPECT_EQ(room.locate_without_features().point.status, Status::degenerate);
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::located) << estimate.point.reason;
}

TEST(AllLooks, APointBehindTheCameraIsCalledSo) {
  Room room = exact_room();
  // Pixels as of a point on the same ray at an inverse range of -1/m: the ray's far end, and
  // beyond.
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(room.true_head, room.true_readings[0]).inverse();
  const Eigen::Vector3d away = room.torso_point_m - torso_from_cam1.translation;
  const Eigen::Vector3d behind = torso_from_cam1.translation - away / away.norm();
  for (std::size_t k = 1; k < room.looks.size(); ++k) {
    const Eigen::Vector3d there =
        -(geometry::cam_from_torso(room.true_head, room.true_readings[k]) * behind);
    room.looks[k].pixel = geometry::project(room.true_camera, there).value();
  }
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.point.status, Status::behind_camera);
  EXPECT_NEAR(estimate.point.inverse_range_per_m, -1.0, 1e-4);
  expect_filled(estimate.point, Filled::inverse_range);
}

TEST(AllLooks, SixteenLooksFitAndMoreOrFewerThanTwoAreRefused) {
  Random random(37);
  Room room = random_room({.looks = looks_max}, random);
  EXPECT_EQ(room.locate().refinement, Refinement::used);
  room.looks.push_back(room.looks.back());
  EXPECT_THROW(static_cast<void>(room.locate()), std::invalid_argument);
  room.looks.resize(1);
  EXPECT_THROW(static_cast<void>(room.locate()), std::invalid_argument);
  room.looks.resize(2, room.looks[0]);
  room.features.resize(features_max + 1);
  EXPECT_THROW(static_cast<void>(room.locate()), std::invalid_argument);
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::locate_test
