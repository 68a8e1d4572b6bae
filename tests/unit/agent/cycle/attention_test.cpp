// What a look is told of the looks before it.
#include "agent/cycle/attention.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"

namespace gazed::cycle::attention_test {
namespace {

constexpr double round_trip_tolerance_px = 1e-6;  // the distortion is undone by iteration
constexpr std::int64_t second_us = 1'000'000;

class AttentionOf : public testing::Test {
 protected:
  [[nodiscard]] Attention attention() const { return {rig, settings}; }
  static geometry::View view(geometry::HeadAngles head = {}, std::int64_t utime_us = second_us) {
    return {{}, head, utime_us};
  }

  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  saliency::SaliencySettings settings;
};

TEST_F(AttentionOf, KnowsNothingAtFirst) {
  Attention dut = attention();
  const saliency::FrameContext context = dut.context_for(view());
  EXPECT_FALSE(context.head_is_still);
  EXPECT_FALSE(context.previous_winner_px);
  EXPECT_TRUE(context.kept.empty());
  EXPECT_FALSE(dut.flicker_needs_another_frame());
}

TEST_F(AttentionOf, TheLastWinnerTurnsWithTheHead) {
  Attention dut = attention();
  dut.won(view(), {400, 200});
  EXPECT_LE((*dut.context_for(view()).previous_winner_px - geometry::Pixel(400, 200)).norm(),
            round_trip_tolerance_px);
  // The head turns to the right by the pixel's own yaw: then it is in the middle column.
  const geometry::HeadAngles turned{std::atan((319.5 - 400) / 608), 0.0};
  EXPECT_NEAR(dut.context_for(view(turned)).previous_winner_px->x(), 319.5, 1.0);
  EXPECT_FALSE(dut.context_for(view({2.0, 0.0})).previous_winner_px);  // behind the camera
}

TEST_F(AttentionOf, APixelWithoutARayIsForgotten) {
  rig.camera.distortion = {-0.9, 0.0, 0.0, 0.0, 0.0};  // folds back inside the image
  Attention dut = attention();
  dut.won(view(), {400, 200});
  dut.won(view(), {0, 0});
  EXPECT_FALSE(dut.context_for(view()).previous_winner_px);
}

TEST_F(AttentionOf, TheRobotsOwnPartsAreLeftOutWhereTheyAreInView) {
  rig = geometry::robot_profile("nao-v6", geometry::CameraPosition::bottom)->rig;
  const geometry::HeadAngles to_the_side{1.5, 0.2}, down{0.0, 0.2};
  Attention body = attention();
  EXPECT_TRUE(body.context_for(view()).without_own_parts.empty());
  EXPECT_EQ(body.context_for(view(to_the_side)).without_own_parts.size(), 1200U);
  EXPECT_TRUE(body.context_for(view(down)).without_own_parts.empty());
  settings.exclude_feet = true;
  Attention standing = attention();
  EXPECT_EQ(standing.context_for(view(down)).without_own_parts.size(), 1200U);
}

TEST_F(AttentionOf, OwnPartsMayBeObjectsAndAreInTheReportsProfile) {
  rig = geometry::robot_profile("nao-v6", geometry::CameraPosition::bottom)->rig;
  const geometry::View to_the_side = view({1.5, 0.2});
  settings.exclude_body = false;
  Attention none = attention();
  EXPECT_TRUE(none.context_for(to_the_side).without_own_parts.empty());
  settings.exclude_body = true;
  settings.profile = saliency::SaliencyProfile::report;
  Attention reports = attention();
  EXPECT_TRUE(reports.context_for(to_the_side).without_own_parts.empty());
}

TEST_F(AttentionOf, FlickerNeedsTwoFramesOfOneRest) {
  settings.flicker_weight = 1.0;
  Attention dut = attention();
  EXPECT_FALSE(dut.context_for(view()).head_is_still);
  EXPECT_TRUE(dut.flicker_needs_another_frame());
  EXPECT_TRUE(dut.context_for(view()).head_is_still);
  EXPECT_FALSE(dut.flicker_needs_another_frame());
  dut.head_moved();
  EXPECT_FALSE(dut.context_for(view()).head_is_still);
  EXPECT_TRUE(dut.flicker_needs_another_frame());
  (void)dut.context_for(view());
  dut.fixation_ended(second_us);
  EXPECT_FALSE(dut.context_for(view()).head_is_still);
}

TEST_F(AttentionOf, OnlyAScanInhibitsAndForgetsTheWinner) {
  for (const bool scan : {false, true}) {
    settings.scan = scan;
    Attention dut = attention();
    dut.won(view(), {400, 200});
    EXPECT_TRUE(dut.context_for(view()).kept.empty());  // both views of a fixation choose alike
    dut.fixation_ended(second_us);
    const saliency::FrameContext context = dut.context_for(view());
    EXPECT_EQ(context.kept.empty(), !scan);
    EXPECT_EQ(context.previous_winner_px.has_value(), !scan);
  }
}

TEST_F(AttentionOf, AFixationWithoutAWinnerInhibitsNothing) {
  settings.scan = true;
  Attention dut = attention();
  dut.fixation_ended(second_us);
  EXPECT_TRUE(dut.context_for(view()).kept.empty());
}

}  // namespace
}  // namespace gazed::cycle::attention_test
