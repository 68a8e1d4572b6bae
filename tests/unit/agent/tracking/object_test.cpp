#include "agent/tracking/object.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <gmock/gmock.h>
#include <string>

#include "drawing.hpp"
#include "scene.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::tracking::object_test {
namespace {

// The saliency winner is good to a map cell of 16 px.
const geometry::Pixel winner_error(11.0, -10.0);

base::Image paint(const std::function<Colour(int x, int y)>& colour, double noise_levels = 0.0) {
  base::Image image(640, 480, base::PixelFormat::rgb24);
  base::Random random(5);
  for (int y = 0; y < 480; ++y) {
    NormalRow normals(random);
    for (int x = 0; x < 640; ++x) {
      const Colour value = colour(x, y);
      for (int c = 0; c < 3; ++c) {
        const double noisy = value[c] + noise_levels / NormalRow::one * normals.next();
        image.row(y)[3 * x + c] = static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 255.0));
      }
    }
  }
  return image;
}

const Colour wall(190, 190, 190), red(190, 30, 30);

/// Part of an image, as a smaller camera would see it.
base::ImageView corner_of(const base::Image& image, int width_px, int height_px) {
  base::ImageView view = image.view();
  view.width_px = width_px;
  view.height_px = height_px;
  return view;
}

auto disc(geometry::Pixel centre, double radius_px, const Colour& inside = red,
          const Colour& outside = wall) {
  return [=](int x, int y) {
    return (geometry::Pixel(x, y) - centre).norm() <= radius_px ? inside : outside;
  };
}

TEST(ObjectMask, FindsDiscsOfAllSizesWithTheirCentre) {
  for (const double radius_px : {4.0, 6.0, 15.0, 40.0, 75.0, 120.0}) {
    if (test::few_trials && radius_px != 6.0 && radius_px != 75.0) continue;
    const geometry::Pixel centre(300.3, 250.8);
    const base::Image image = paint(disc(centre, radius_px), 3.0);
    ObjectMask object;
    ASSERT_TRUE(object.segment(image.view(), centre + winner_error)) << radius_px;
    // The centroid of an outline that is known to a cell.
    EXPECT_LT((object.interior_point() - centre).norm(), 1.0 * object.cell_px()) << radius_px;
    EXPECT_NEAR(object.half_size_px(centre), radius_px, 1.5 * object.cell_px()) << radius_px;
    EXPECT_EQ(object.distance_px(300, 250), 0.0F);
  }
}

TEST(ObjectMask, TheBallOnTheTableIsTheBall) {
  const base::Image image = paint([](int x, int y) -> Colour {
    if ((geometry::Pixel(x, y) - geometry::Pixel(320, 240)).norm() <= 20.0) return red;
    if (x > 200 && x < 440 && y > 150 && y < 330) return {120, 90, 60};
    return wall;
  });
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), geometry::Pixel(320, 240) + winner_error));
  EXPECT_LT((object.interior_point() - geometry::Pixel(320, 240)).norm(), 2.0);
  EXPECT_LT(object.half_size_px({320, 240}), 25.0);
}

// The most salient place of a patterned ball is on a blotch, which has an outline of its own.
TEST(ObjectMask, ABlotchOfAPatternIsNotTheObject) {
  const geometry::Pixel centre(320.0, 240.0);
  const double radius_px = 62.0;
  for (const geometry::Pixel& blotch : {geometry::Pixel(2.0, -40.0), geometry::Pixel(30.0, 18.0)}) {
    const base::Image image = paint(
        [&](int x, int y) -> Colour {
          const geometry::Pixel off = geometry::Pixel(x, y) - centre;
          if (off.norm() > radius_px) return wall;
          if ((off - blotch).norm() < 17.0) return {205, 50, 48};
          return (off + blotch).norm() < 14.0 ? Colour(150, 20, 20) : Colour(178, 35, 30);
        },
        2.0);
    ObjectMask object;
    ASSERT_TRUE(object.segment(image.view(), centre + blotch));
    EXPECT_LT((object.interior_point() - centre).norm(), 5.0);
    EXPECT_GT(object.half_size_px(centre), 58.0);
  }
}

// Blinn's highlight on a ball of 46 px, which the winner is in the middle of.
TEST(ObjectMask, AMirroredLampIsNotTheObject) {
  const geometry::Pixel centre(320.0, 240.0), lamp(12.0, -9.0);
  constexpr double radius_px = 46.0;
  for (const double light : {60.0, 120.0, 200.0}) {
    for (const double width_px : {7.0, 10.0}) {
      const base::Image image = paint(
          [&](int x, int y) -> Colour {
            const geometry::Pixel off = geometry::Pixel(x, y) - centre;
            if (off.norm() > radius_px) return wall;
            const double mirrored =
                light * std::exp(-0.5 * (off - lamp).squaredNorm() / (width_px * width_px));
            return (red + Colour::Constant(mirrored)).cwiseMin(255.0);
          },
          2.0);
      ObjectMask object;
      ASSERT_TRUE(object.segment(image.view(), centre + lamp));
      EXPECT_LT((object.interior_point() - centre).norm(), 4.0) << light << " " << width_px;
      EXPECT_GT(object.half_size_px(centre), 42.0) << light << " " << width_px;
    }
  }
}

// As white and as bright, but with an edge.
TEST(ObjectMask, TheWhiteBallOnARedTableIsTheBall) {
  const geometry::Pixel centre(320.0, 240.0);
  const base::Image image = paint(
      [&](int x, int y) -> Colour {
        if ((geometry::Pixel(x, y) - centre).norm() <= 12.0) return {250, 250, 250};
        return x > 250 && x < 390 && y > 170 && y < 310 ? red : wall;
      },
      2.0);
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), centre));
  EXPECT_LT(object.half_size_px(centre), 16.0);
}

TEST(ObjectMask, TheRingPrintedOnADiscIsTheDisc) {
  const base::Image image = paint([](int x, int y) -> Colour {
    const double radius = (geometry::Pixel(x, y) - geometry::Pixel(320, 240)).norm();
    if (radius > 32.0) return wall;
    return radius > 16.0 && radius < 21.0 ? Colour(125, 12, 16) : red;
  });
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), geometry::Pixel(320, 240) + winner_error));
  EXPECT_LT((object.interior_point() - geometry::Pixel(320, 240)).norm(), 2.0);
  EXPECT_GT(object.half_size_px({320, 240}), 30.0);
}

TEST(ObjectMask, APointOfARingIsOnTheRing) {
  const base::Image image = paint([](int x, int y) {
    const double radius = (geometry::Pixel(x, y) - geometry::Pixel(320, 240)).norm();
    return radius > 12.0 && radius < 20.0 ? red : wall;
  });
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), {320, 240}));
  const double radius = (object.interior_point() - geometry::Pixel(320, 240)).norm();
  EXPECT_GT(radius, 13.0);
  EXPECT_LT(radius, 19.0);
}

TEST(ObjectMask, AnObjectMayBeCutByTheFrame) {
  const base::Image image = paint(disc({6.0, 470.0}, 30.0));
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), {14, 460}));
  const geometry::Pixel inside = object.interior_point();
  EXPECT_LT((inside - geometry::Pixel(6.0, 470.0)).norm(), 26.0);
  EXPECT_GT(inside.x(), 5.0);
  EXPECT_LT(inside.y(), 474.0);
}

TEST(ObjectMask, EqualLumaIsStillAnObject) {
  // Both have BT.601 luma 100.
  const base::Image image = paint(disc({320, 240}, 25.0, {200, 60, 44}, {52, 134, 52}), 2.0);
  ObjectMask object;
  ASSERT_TRUE(object.segment(image.view(), geometry::Pixel(320, 240) + winner_error));
  EXPECT_LT((object.interior_point() - geometry::Pixel(320, 240)).norm(), 2.0);
}

TEST(ObjectMask, NothingOnABlankWall) {
  for (const double noise : {0.0, 2.0, 5.0}) {
    const base::Image image = paint([](int, int) { return wall; }, noise);
    ObjectMask object;
    EXPECT_FALSE(object.segment(image.view(), {320, 240})) << noise;
  }
}

TEST(ObjectMask, NothingWhereTheObjectLeavesEveryWindow) {
  const base::Image image = paint([](int, int y) { return y < 240 ? red : wall; });
  ObjectMask object;
  EXPECT_FALSE(object.segment(image.view(), {320, 235}));
}

TEST(ObjectMask, ASquareIsTakenAsFarAsTheFrameGoes) {
  const base::Image image = paint([](int, int) { return wall; });
  ObjectMask object;
  object.take_square(image.view(), {10, 240}, 24);
  EXPECT_EQ(object.distance_px(10, 240), 0.0F);
  EXPECT_EQ(object.distance_px(30, 220), 0.0F);
  EXPECT_GT(object.distance_px(44, 240), 2.0F);
  EXPECT_GT(object.distance_px(-6, 240), 2.0F);
}

// Shares of drawings whose mask overlaps the truth by 0.8, intersection over union. With nothing
// but the contrast to the window's rim they were 0.92 before plain walls, 0.14 before furniture,
// 0.02 before books and 0.49 before a photograph.
TEST(ObjectMask, ObjectsOfOneColourBeforeColourfulRooms) {
  constexpr double overlap_min = 0.8;
  const auto share_min = [](Backdrop backdrop) {
    switch (backdrop) {
      case Backdrop::plain:
        return 0.9;
      case Backdrop::furniture:
        return 0.8;
      case Backdrop::books:
        return 0.7;
      case Backdrop::photo:
        break;
    }
    return 0.9;
  };
  ObjectMask object;
  for (const Backdrop backdrop : all_backdrops) {
    const int drawings = test::trials(12, 2);
    int good = 0, drawn = 0;
    std::string missed;
    for (const Shape shape : all_shapes) {
      base::Random random(41 + static_cast<std::uint64_t>(shape));
      for (int i = 0; i < drawings; ++i) {
        const Drawing drawing = draw(shape, backdrop, i % 6, random);
        const bool found = object.segment(drawing.image.view(), drawing.winner) &&
                           overlap(drawing, object) > overlap_min;
        good += found;
        ++drawn;
        if (!found) missed += name(shape) + " " + std::to_string(i) + "; ";
      }
    }
    const double slack = test::few_trials ? 0.15 : 0.0;
    EXPECT_GE(static_cast<double>(good) / drawn, share_min(backdrop) - slack)
        << name(backdrop) << ", missed: " << missed;
  }
}

// Nothing reaches the rim of a window that is larger than the frame. One point in twenty was that
// of a wall, at 320x240.
TEST(ObjectMask, AWallIsNoObjectInASmallFrameEither) {
  const base::Image two_walls = paint([](int x, int) { return x < 170 ? red : wall; }, 3.0);
  for (const int width_px : {320, 160}) {
    const int height_px = width_px * 3 / 4;
    ObjectMask object;
    EXPECT_FALSE(object.segment(corner_of(two_walls, width_px, height_px),
                                geometry::Pixel(100.0, 0.5 * height_px)))
        << width_px;
  }
}

}  // namespace
}  // namespace gazed::tracking::object_test
