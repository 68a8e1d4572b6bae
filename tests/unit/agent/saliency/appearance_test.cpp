// An object is known again by its colour, contrast and size; another, or none, is not taken for it.
#include "agent/saliency/appearance.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"

namespace gazed::saliency::appearance_test {
namespace {

using frames::Canvas;
using frames::Colour;

constexpr Colour wall{200, 200, 195}, red{200, 40, 40};

class AppearanceOf : public testing::Test {
 protected:
  Appearance at(const Canvas& canvas, double x, double y) {
    seen = saliency.examine(canvas.view());
    return appearance_at(seen.planes, {x, y});
  }

  Saliency saliency{SaliencySettings{}, 640, 480};
  SaliencyResult seen;
  const Canvas first = Canvas(640, 480, wall).disc(300, 200, 24, red).noise(2, 1);
};

TEST_F(AppearanceOf, AnObjectThatMovedIsTheSame) {
  const Appearance before = at(first, 300, 200);
  const Canvas later = Canvas(640, 480, wall).disc(241, 259, 24, red).noise(2, 2);
  EXPECT_GE(likeness(before, at(later, 241, 259)), 0.95);  // samples fall elsewhere on it
}

TEST_F(AppearanceOf, OtherLightIsAllowedFor) {
  const Appearance before = at(first, 300, 200);
  const Canvas darker =
      Canvas(640, 480, {140, 140, 137}).disc(300, 200, 24, {140, 28, 28}).noise(2, 2);
  EXPECT_GE(likeness(before, at(darker, 300, 200)), Confirmation::least_likeness);
}

TEST_F(AppearanceOf, AnotherColourIsAnotherObject) {
  const Appearance before = at(first, 300, 200);
  const Canvas blue = Canvas(640, 480, wall).disc(300, 200, 24, {40, 40, 200}).noise(2, 2);
  EXPECT_LT(likeness(before, at(blue, 300, 200)), Confirmation::least_likeness);
}

TEST_F(AppearanceOf, LessContrastIsAnotherObject) {
  const Appearance before = at(first, 300, 200);
  const Canvas pale = Canvas(640, 480, wall).disc(300, 200, 24, {200, 150, 147}).noise(2, 2);
  EXPECT_LT(likeness(before, at(pale, 300, 200)), Confirmation::least_likeness);
}

TEST_F(AppearanceOf, AnotherSizeIsAnotherObject) {
  const Appearance before = at(first, 300, 200);
  const Canvas large = Canvas(640, 480, wall).disc(300, 200, 90, red).noise(2, 2);
  EXPECT_LT(likeness(before, at(large, 300, 200)), Confirmation::least_likeness);
}

TEST_F(AppearanceOf, AWallIsNoObject) {
  const Appearance before = at(first, 300, 200);
  EXPECT_LT(likeness(before, at(first, 500, 400)), 0.1);
}

TEST_F(AppearanceOf, BeyondTheFrameItsBorderCounts) {
  const Appearance beyond = at(first, -1e6, 1e6);
  for (const float sample : beyond.pattern) EXPECT_TRUE(std::isfinite(sample));
}

TEST(Appearance, WithoutPlanesThereIsNone) {
  EXPECT_EQ(likeness(appearance_at({}, {0, 0}), appearance_at({}, {0, 0})), 0.0);
}

// Two equal peaks: salient both, and only one is the object.
TEST_F(AppearanceOf, OfTwoSalientPlacesTheObjectIsConfirmed) {
  const Appearance before = at(first, 300, 200);
  const Canvas two =
      Canvas(640, 480, wall).disc(241, 259, 24, red).disc(450, 150, 24, {30, 60, 190}).noise(2, 3);
  const SaliencyResult later = saliency.examine(two.view());
  const Confirmation object = confirm(later, {241, 259}, before);
  EXPECT_TRUE(object.salient() && object.alike()) << object.share << ' ' << object.likeness;
  const Confirmation other = confirm(later, {450, 150}, before);
  EXPECT_TRUE(other.salient()) << other.share;
  EXPECT_FALSE(other.alike()) << other.likeness;
  EXPECT_FALSE(confirm(later, {100, 400}, before).salient());
}

TEST(Confirmation, AMapOfNothingConfirmsNothing) {
  const std::vector<std::uint16_t> none(1200);
  SaliencyResult seen;
  seen.map = {none, 40, 30};
  EXPECT_FALSE(confirm(seen, {100, 100}, {}).salient());
}

}  // namespace
}  // namespace gazed::saliency::appearance_test
