// fixation_t, field by field.
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "agent/daemon/publisher.hpp"
#include "agent/geometry/chain.hpp"
#include "agent/geometry/pose.hpp"

#include "tests/unit/agent/daemon/example_fixation.hpp"

namespace gazed::daemon::fixation_message_test {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsNan;

/// Two looks, of which the second missed; a number of its own in every field.
cycle::Fixation two_looks() {
  cycle::Fixation fixation = example_fixation();
  fixation.look_count = 2;
  cycle::FixationLook& first = fixation.looks[0];
  first.utime_us = 11;
  first.measured = {0.1, 0.2};
  first.refined = {0.3, 0.4};
  first.torso_1_from_torso = {geometry::about_z(0.01), {0.001, 0.002, 0.003}};
  first.pixel = {320.0, 240.0};
  first.covariance_px2 << 1.0, 2.0, 2.0, 4.0;
  first.epipole = {5.0, 6.0};
  first.chi2 = 1.25;
  first.used = true;
  first.corners[0] = {{7.0F, 8.0F}, true};
  first.corners[1] = {{9.0F, 10.0F}, false};
  first.corner_count = 2;
  fixation.looks[1].utime_us = 12;
  fixation.looks[1].reason = "correlation 0.31";
  fixation.outline.points_px[0] = {11.0F, 12.0F};
  fixation.outline.count = 1;
  fixation.report_position_m = {0.5, 0.25, 0.125};
  fixation.features_used = 3;
  fixation.features_rejected = 4;
  triangulation::all_looks::BelievedRobot& robot = fixation.robot;
  robot.camera.focal_px = {600.0, 602.0};
  robot.camera.centre_px = {319.0, 239.0};
  robot.camera.distortion = {-0.1, 0.2, 0.3, 0.4, 0.5};
  robot.head.mount_rotation_rad = {0.01, 0.02, 0.03};
  robot.head.mount_offset_m = {0.04, 0.05, 0.06};
  robot.head.zero = {0.07, 0.08};
  robot.focal_sigma_px = 1.0;
  robot.centre_sigma_px = {2.0, 3.0};
  robot.distortion_sigma = {0.5, 0.25};
  robot.mount_rotation_sigma_rad = {4.0, 5.0, 6.0};
  robot.mount_offset_sigma_m = {7.0, 8.0, 9.0};
  robot.zero_sigma_rad = {10.0, 11.0};
  return fixation;
}

TEST(FixationMessage, CarriesEveryField) {
  const fixation_t message = to_fixation_message(two_looks(), "nao-v5");
  EXPECT_EQ(message.utime, 1'700'000'000'000'000);
  EXPECT_EQ(message.fixation, 3);
  EXPECT_EQ(message.status, located_point_t::LOCATED);
  EXPECT_EQ(message.status_name, "LOCATED");
  EXPECT_EQ(message.method, "all_looks");
  EXPECT_EQ(message.nlooks, 2);
  EXPECT_EQ(message.looks.size(), 2U);
  EXPECT_THAT(message.report_position_m, ElementsAre(0.5, 0.25, 0.125));
  EXPECT_EQ(message.robot_name, "nao-v5");
  EXPECT_THAT(message.robot, ElementsAre(601.0, 319.0, 239.0, -0.1, 0.2, 0.01, 0.02, 0.03, 0.04,
                                         0.05, 0.06, 0.07, 0.08));
  EXPECT_THAT(message.robot_sigma,
              ElementsAre(1.0, 2.0, 3.0, 0.5, 0.25, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0));
  EXPECT_EQ(message.features_used, 3);
  EXPECT_EQ(message.features_rejected, 4);
}

constexpr double rounding = 1e-12;

TEST(FixationMessage, CarriesEveryFieldOfALook) {
  const fixation_t message = to_fixation_message(two_looks(), "nao-v5");
  const look_t& look = message.looks.at(0);
  EXPECT_EQ(look.utime, 11);
  EXPECT_THAT(look.measured_rad, ElementsAre(0.1, 0.2));
  EXPECT_THAT(look.refined_rad, ElementsAre(0.3, 0.4));
  EXPECT_THAT(look.torso_rad, ElementsAre(0.0, 0.0, DoubleNear(0.01, rounding)));
  EXPECT_THAT(look.torso_m, ElementsAre(0.001, 0.002, 0.003));
  EXPECT_THAT(look.pixel, ElementsAre(320.0, 240.0));
  EXPECT_THAT(look.pixel_covariance_px2[0], ElementsAre(1.0, 2.0));
  EXPECT_THAT(look.pixel_covariance_px2[1], ElementsAre(2.0, 4.0));
  EXPECT_THAT(look.epipole, ElementsAre(5.0, 6.0));
  EXPECT_EQ(look.chi2, 1.25F);
  EXPECT_EQ(look.used, 1);
  EXPECT_EQ(look.reason, "");
  EXPECT_EQ(look.noutline, 1);
  EXPECT_THAT(look.outline_px, ElementsAre(ElementsAre(11.0F, 12.0F)));
  EXPECT_EQ(look.ncorners, 2);
  EXPECT_THAT(look.corner_px, ElementsAre(ElementsAre(7.0F, 8.0F), ElementsAre(9.0F, 10.0F)));
  EXPECT_THAT(look.corner_used, ElementsAre(1, 0));
}

TEST(FixationMessage, OfALookThatMissedHasNaNAndEmptyLists) {
  const fixation_t message = to_fixation_message(two_looks(), "nao-v5");
  const look_t& look = message.looks.at(1);
  EXPECT_EQ(look.utime, 12);
  EXPECT_THAT(look.refined_rad, Each(IsNan()));
  EXPECT_THAT(look.pixel, Each(IsNan()));
  EXPECT_THAT(look.pixel_covariance_px2[1], Each(IsNan()));
  EXPECT_THAT(look.epipole, Each(IsNan()));
  EXPECT_TRUE(std::isnan(look.chi2));
  EXPECT_EQ(look.used, 0);
  EXPECT_EQ(look.reason, "correlation 0.31");
  EXPECT_THAT(look.outline_px, IsEmpty());
  EXPECT_THAT(look.corner_px, IsEmpty());
}

TEST(FixationMessage, OfNoLooksHasEmptyListsAndNaN) {
  const fixation_t message = to_fixation_message(cycle::Fixation{}, "nao-v6");
  EXPECT_EQ(message.nlooks, 0);
  EXPECT_THAT(message.looks, IsEmpty());
  EXPECT_THAT(message.report_position_m, Each(IsNan()));
}

}  // namespace
}  // namespace gazed::daemon::fixation_message_test
