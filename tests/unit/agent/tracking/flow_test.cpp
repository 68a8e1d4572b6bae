#include "agent/tracking/flow.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>

#include "scene.hpp"

namespace gazed::tracking::flow_test {
namespace {

constexpr int width = 96, height = 80;
constexpr float reach = 3.0F;
// Samples are rounded to a sixteenth of a grey level and fractions to 1/256.
constexpr float error_max = 0.01F;

template <typename Grey>
LumaLevel painted(Grey grey) {
  LumaLevel level;
  level.resize(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      level.row(y)[x] = static_cast<std::uint16_t>(
          std::lround(luma_one * static_cast<float>(grey(Eigen::Vector2d(x, y)))));
    }
  }
  return level;
}

// Smooth and without repetition.
double texture(const Eigen::Vector2d& at) {
  const double u = at.x(), v = at.y();
  return 120 + 40 * std::sin(0.31 * u + 0.2 * v) + 30 * std::cos(0.11 * u - 0.37 * v) +
         15 * std::sin(0.05 * u * v / 20);
}

const Eigen::Vector2f centre(45, 38);

TEST(Flow, FindsAShift) {
  const LumaLevel view_1 = painted(texture);
  FlowTemplate<12> patch;
  ASSERT_TRUE(make_template(view_1, centre, Eigen::Matrix2f::Identity(), patch));
  for (int step = 0; step < 16; ++step) {
    const Eigen::Vector2d shift(0.13 * step - 1.0, 0.9 - 0.11 * step);
    const LumaLevel view_2 =
        painted([&](const Eigen::Vector2d& at) { return texture(at - shift); });
    const auto flow = find_patch(patch, view_2, centre, reach);
    ASSERT_TRUE(flow);
    EXPECT_LT((flow->at - centre - shift.cast<float>()).norm(), error_max);
    EXPECT_GT(flow->correlation, 0.9999F);
  }
}

TEST(Flow, GainAndBiasMoveNothing) {
  const LumaLevel view_1 = painted(texture);
  const Eigen::Vector2d shift(0.4, -0.7);
  FlowTemplate<8> patch;
  ASSERT_TRUE(make_template(view_1, centre, Eigen::Matrix2f::Identity(), patch));
  for (const double gain : {0.6, 1.0, 1.2}) {
    const LumaLevel view_2 =
        painted([&](const Eigen::Vector2d& at) { return gain * texture(at - shift) + 8.0 / gain; });
    const auto flow = find_patch(patch, view_2, centre, reach);
    ASSERT_TRUE(flow);
    EXPECT_LT((flow->at - centre - shift.cast<float>()).norm(), error_max);
  }
}

// The patch as the other view's geometry shows it.
TEST(Flow, TurnedAndStretched) {
  const LumaLevel view_1 = painted(texture);
  Eigen::Matrix2d shape;  // d place 2 / d place 1
  shape << 1.3, -0.2, 0.15, 0.9;
  const Eigen::Matrix2d back = shape.inverse();
  const Eigen::Vector2d from = centre.cast<double>(), to(40.3, 41.6);
  const LumaLevel view_2 =
      painted([&](const Eigen::Vector2d& at) { return texture(from + back * (at - to)); });
  FlowTemplate<12> patch;
  ASSERT_TRUE(make_template(view_1, centre, back.cast<float>(), patch));
  const auto flow = find_patch(patch, view_2, Eigen::Vector2f(41.0F, 41.0F), reach);
  ASSERT_TRUE(flow);
  // The spline smooths along each view's own axes: another shape of the same patch.
  EXPECT_LT((flow->at - to.cast<float>()).norm(), 0.03F);
}

TEST(Flow, NothingToHoldOn) {
  FlowTemplate<12> patch;
  const Eigen::Matrix2f same = Eigen::Matrix2f::Identity();
  const auto blank = painted([](const Eigen::Vector2d&) { return 90.0; });
  const auto edge = painted([](const Eigen::Vector2d& at) { return at.x() < 45 ? 40.0 : 200.0; });
  EXPECT_FALSE(make_template(blank, centre, same, patch));
  EXPECT_FALSE(make_template(edge, centre, same, patch));
}

TEST(Flow, OverTheBorder) {
  const LumaLevel view = painted(texture);
  const Eigen::Matrix2f same = Eigen::Matrix2f::Identity();
  FlowTemplate<12> patch;
  for (const Eigen::Vector2f& at :
       {Eigen::Vector2f(5, 40), Eigen::Vector2f(40, 5), Eigen::Vector2f(90, 40),
        Eigen::Vector2f(40, 75), Eigen::Vector2f(-1e9F, 40), Eigen::Vector2f(1e9F, 1e9F),
        Eigen::Vector2f(NAN, 40)}) {
    EXPECT_FALSE(make_template(view, at, same, patch)) << at.transpose();
  }
  ASSERT_TRUE(make_template(view, centre, same, patch));
  for (const Eigen::Vector2f& at :
       {Eigen::Vector2f(2, 40), Eigen::Vector2f(40, 79), Eigen::Vector2f(1e9F, 40),
        Eigen::Vector2f(40, -1e9F), Eigen::Vector2f(NAN, NAN)}) {
    EXPECT_FALSE(find_patch(patch, view, at, reach)) << at.transpose();
  }
}

// The negative of a patch is no gain.
TEST(Flow, RefusesTheNegative) {
  const LumaLevel view_1 = painted(texture);
  const auto negative = painted([](const Eigen::Vector2d& at) { return 240.0 - texture(at); });
  FlowTemplate<12> patch;
  ASSERT_TRUE(make_template(view_1, centre, Eigen::Matrix2f::Identity(), patch));
  const auto flow = find_patch(patch, negative, centre, 0.5F);
  EXPECT_FALSE(flow);
}

}  // namespace
}  // namespace gazed::tracking::flow_test
