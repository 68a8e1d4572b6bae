#include "agent/tracking/highlight.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace gazed::tracking::highlight_test {
namespace {

using Eigen::Vector3f;

const Vector3f red(190.0F, 30.0F, 30.0F), white(1.0F, 1.0F, 1.0F);

/// A slope from red to so much light more, of which that share is at the outline.
HighlightJudge::Across slope(const Vector3f& light, float share_at_outline) {
  const float near = 0.5F * share_at_outline;
  const auto at = [&](float share) { return Vector3f((red + share * light).cwiseMin(255.0F)); };
  return {at(1.0F), at(0.5F + near), at(0.5F - near), at(0.0F)};
}

bool is_highlight(const HighlightJudge::Across& across) {
  HighlightJudge dut;
  for (int i = 0; i < 20; ++i) dut.add(across);
  return dut.is_highlight();
}

TEST(Highlight, IsWhiteLightWithoutAnEdge) {
  EXPECT_TRUE(is_highlight(slope(100.0F * white, 0.15F)));
  EXPECT_FALSE(is_highlight(slope(100.0F * white, 0.4F)));
}

TEST(Highlight, OfALampIsNearlyWhite) {
  EXPECT_TRUE(is_highlight(slope({120.0F, 110.0F, 80.0F}, 0.15F)));
  EXPECT_FALSE(is_highlight(slope({30.0F, 120.0F, 30.0F}, 0.15F)));
}

// Red is at its end after 65 levels and says no more.
TEST(Highlight, MayOverflowAChannel) {
  EXPECT_TRUE(is_highlight(slope(180.0F * white, 0.15F)));
}

TEST(Highlight, IsBrighterNotDarker) {
  EXPECT_FALSE(is_highlight(slope(-25.0F * white, 0.15F)));
}

TEST(Highlight, FaintLightIsNone) {
  EXPECT_FALSE(is_highlight(slope(8.0F * white, 0.15F)));
}

TEST(Highlight, OfNothingIsNone) {
  EXPECT_FALSE(HighlightJudge().is_highlight());
}

}  // namespace
}  // namespace gazed::tracking::highlight_test
