#include "agent/daemon/publisher.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/agent/daemon/example_fixation.hpp"

namespace gazed::daemon::publisher_test {
namespace {

using ::testing::ElementsAre;

TEST(LocatedPointMessage, CarriesTheFixation) {
  const located_point_t message = to_message(example_fixation());
  EXPECT_EQ(message.utime, 1'700'000'000'000'000);
  EXPECT_EQ(message.fixation, 3);
  EXPECT_EQ(message.status, 0);
  EXPECT_EQ(message.views, 2);
  EXPECT_THAT(message.position_m, ElementsAre(0.35, 0.04, 0.19));
  EXPECT_THAT(message.camera_position_m, ElementsAre(0.01, 0.02, 0.30));
  EXPECT_EQ(message.covariance_m2[0][1], 1e-5);
  EXPECT_EQ(message.covariance_m2[2][0], 2e-5);
  EXPECT_THAT(message.pixel_1, ElementsAre(319.5, 240.25));
  EXPECT_THAT(message.head_2_rad, ElementsAre(0.108, 0.109));
}

TEST(LocatedPointMessage, HasNaNNeverZeroForWhatHasNoMeaning) {
  const located_point_t message = to_message(cycle::Fixation{});
  for (const double value : message.position_m) EXPECT_TRUE(std::isnan(value));
  for (const double value : message.head_1_rad) EXPECT_TRUE(std::isnan(value));
  for (const double value : message.pixel_2) EXPECT_TRUE(std::isnan(value));
  EXPECT_TRUE(std::isnan(message.range_m));
  EXPECT_TRUE(std::isnan(message.residual_px));
}

TEST(SaliencyMessage, HasItsMaximumAt255) {
  const std::array<std::uint16_t, 6> samples{0, 100, 200, 300, 400, 1000};
  cycle::UsedSaliency used;
  used.result.map = {samples, 3, 2};
  used.result.saliency = 0.5F;
  saliency_map_t message{};
  to_message(used, message);
  EXPECT_EQ(message.width, 3);
  EXPECT_EQ(message.height, 2);
  EXPECT_EQ(message.size, 6);
  // 255 sample / 1000, rounded.
  EXPECT_THAT(message.map, ElementsAre(0, 26, 51, 77, 102, 255));
  EXPECT_EQ(message.saliency, 0.5F);
}

TEST(SaliencyMessage, OfAnEmptySceneIsBlack) {
  const std::array<std::uint16_t, 4> samples{};
  cycle::UsedSaliency used;
  used.result.map = {samples, 2, 2};
  saliency_map_t message{};
  to_message(used, message);
  EXPECT_THAT(message.map, ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace gazed::daemon::publisher_test
