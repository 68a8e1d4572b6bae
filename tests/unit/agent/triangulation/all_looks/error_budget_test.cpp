#include "agent/triangulation/all_looks/error_budget.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>

#include "agent/triangulation/all_looks/locate.hpp"

#include "tests/unit/agent/triangulation/rooms.hpp"

namespace gazed::triangulation::all_looks::error_budget_test {
namespace {

/// A room in which everything is as believed, though nobody is sure of it.
Room exact_room(std::size_t features = 100) {
  Random random(31);
  RoomModel model{.range_m = 0.6, .features = features};
  model.exact = true;
  return random_room(model, random);
}

double sum(const ErrorBudget& budget) {
  return std::accumulate(budget.variance_per_m2.begin(), budget.variance_per_m2.end(), 0.0);
}

double variance_of(const Estimate& estimate) {
  return std::pow(estimate.point.inverse_range_sigma_per_m, 2);
}

// Of sums of a hundred numbers.
constexpr double rounding = 1e-9;

TEST(ErrorBudget, TheCausesAddUpToThePublishedVariance) {
  const Room room = exact_room();
  for (const Estimate& estimate : {room.locate(), room.locate_without_features()}) {
    ASSERT_EQ(estimate.point.status, Status::located);
    EXPECT_NEAR(sum(estimate.budget) / variance_of(estimate), 1.0, rounding);
  }
}

TEST(ErrorBudget, WhatIsKnownExactlyCostsNothing) {
  Room room = exact_room();
  room.rig.uncertainty.focal_sigma_px = 0.0;
  room.rig.uncertainty.mount_offset_sigma_m = 0.0;
  const ErrorBudget budget = room.locate().budget;
  EXPECT_EQ(budget.of(Cause::focal_length), 0.0);
  EXPECT_EQ(budget.of(Cause::mount_offset), 0.0);
  EXPECT_GT(budget.of(Cause::encoders), 0.0);
}

TEST(ErrorBudget, WithoutABackgroundItsPixelsCostNothing) {
  const Estimate estimate = exact_room().locate_without_features();
  // The weak prior of the target's inverse depth, 1000 per metre, is counted there too.
  constexpr double of_the_weak_prior = 1e-8;
  EXPECT_LT(estimate.budget.of(Cause::background_pixels),
            of_the_weak_prior * variance_of(estimate));
  EXPECT_GT(exact_room().locate().budget.of(Cause::background_pixels), 0.0);
}

/// How the answer changes when something is believed otherwise by a tenth of its sigma, in inverse
/// range for all of its sigma.
double effect_of(const Room& room, const std::function<void(Room&, double share)>& believe) {
  constexpr double share = 0.1;
  Room more = room, less = room;
  believe(more, share);
  believe(less, -share);
  return (more.locate().point.inverse_range_per_m - less.locate().point.inverse_range_per_m) /
         (2.0 * share);
}

// The answer bends a little between two tenths of a sigma, and the solver ends 1e-4 sigma from it.
constexpr double of_bending = 0.02;

TEST(ErrorBudget, IsWhatAWrongBeliefDoesToTheAnswer) {
  const Room room = exact_room();
  const geometry::Uncertainty& sigmas = room.rig.uncertainty;
  const ErrorBudget budget = room.locate().budget;
  const auto expect = [&](Cause cause, double variance) {
    EXPECT_NEAR(std::sqrt(variance), std::sqrt(budget.of(cause)),
                of_bending * std::sqrt(budget.of(cause)))
        << name(cause);
  };
  expect(Cause::focal_length, std::pow(effect_of(room,
                                                 [&](Room& out, double share) {
                                                   out.rig.camera.focal_px.array() +=
                                                       share * sigmas.focal_sigma_px;
                                                 }),
                                       2));
  double offset = 0.0, encoders = 0.0;
  for (int i = 0; i < 3; ++i) {
    offset += std::pow(effect_of(room,
                                 [&](Room& out, double share) {
                                   out.rig.head.mount_offset_m(i) +=
                                       share * sigmas.mount_offset_sigma_m;
                                 }),
                       2);
  }
  expect(Cause::mount_offset, offset);
  for (std::size_t k = 0; k < room.looks.size(); ++k) {
    for (double geometry::HeadAngles::*joint :
         {&geometry::HeadAngles::yaw_rad, &geometry::HeadAngles::pitch_rad}) {
      encoders += std::pow(effect_of(room,
                                     [&](Room& out, double share) {
                                       out.looks[k].head.*joint += share * sigmas.encoder_sigma_rad;
                                     }),
                           2);
    }
  }
  expect(Cause::encoders, encoders);
}

TEST(ErrorBudget, NoAnswerHasNone) {
  Room room = exact_room();
  for (Look& look : room.looks) look.pixel.setConstant(not_a_number);
  EXPECT_TRUE(std::isnan(room.locate().budget.of(Cause::encoders)));
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::error_budget_test
