// What was looked at is less salient for a while, where it is and not where it was seen.
#include "agent/saliency/inhibition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::inhibition_test {
namespace {

constexpr double radius_rad = 0.1;
constexpr double decay_s = 10.0;
constexpr std::int64_t second_us = 1'000'000;
constexpr std::int64_t start_us = 100 * second_us;

// Q15, rounded once a place.
constexpr double factor_tolerance = 1e-4;
// The chord for the angle: 1/24 angle^2 of it, at 0.1 rad; and float rays.
constexpr double angle_tolerance = 1e-3;

class InhibitionOf : public testing::Test {
 protected:
  static constexpr int map_width = 40;

  [[nodiscard]] geometry::Pose pose(geometry::HeadAngles angles = {}) const {
    return geometry::cam_from_torso(head, angles);
  }
  [[nodiscard]] Eigen::Vector3d direction_of(const geometry::Pixel& pixel,
                                             geometry::HeadAngles angles = {}) const {
    return pose(angles).rotation.transpose() * geometry::normalise(camera, pixel)->homogeneous();
  }
  /// The share of S that is left at a sample.
  double kept(int x, int y, std::int64_t utime_us = start_us, geometry::HeadAngles angles = {}) {
    const auto factors = inhibition.kept(pose(angles), utime_us);
    if (factors.empty()) return 1.0;
    EXPECT_EQ(factors.size(), 1200U);
    return static_cast<double>(factors[static_cast<std::size_t>(y * map_width + x)]) / all_kept;
  }

  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  geometry::CameraModel camera = rig.camera;
  geometry::HeadGeometry head = rig.head;
  Inhibition inhibition{camera, radius_rad, decay_s};
};

TEST_F(InhibitionOf, NothingAttendedLeavesAll) {
  EXPECT_TRUE(inhibition.kept(pose(), start_us).empty());
}

TEST_F(InhibitionOf, ThePlaceIsAGaussian) {
  inhibition.add(direction_of({160, 240}), start_us);
  EXPECT_NEAR(kept(10, 15), 0.0, factor_tolerance);
  const Eigen::Vector3d centre =
      geometry::normalise(camera, {160, 240})->homogeneous().normalized();
  for (int x = 4; x < 24; ++x) {
    const Eigen::Vector3d ray =
        geometry::normalise(camera, geometry::Pixel(16 * x, 240))->homogeneous().normalized();
    const double angle_rad = std::acos(std::min(1.0, ray.dot(centre)));
    const double gaussian = std::exp(-0.5 * std::pow(angle_rad / radius_rad, 2));
    EXPECT_NEAR(kept(x, 15), 1.0 - gaussian, angle_tolerance) << "at column " << x;
  }
  EXPECT_EQ(kept(39, 0), 1.0);
}

TEST_F(InhibitionOf, ItDecaysExponentially) {
  inhibition.add(direction_of({160, 240}), start_us);
  for (const int s : {0, 1, 5, 10, 30})
    EXPECT_NEAR(kept(10, 15, start_us + s * second_us), 1.0 - std::exp(-s / decay_s),
                factor_tolerance)
        << "after " << s << " s";
  EXPECT_TRUE(inhibition.kept(pose(), start_us + 60 * second_us).empty());
}

TEST_F(InhibitionOf, ThePlaceStaysWhenTheHeadTurns) {
  const Eigen::Vector3d direction = direction_of({160, 240});
  inhibition.add(direction, start_us);
  for (const geometry::HeadAngles angles :
       {geometry::HeadAngles{0.1, -0.1}, {0.3, 0.2}, {-0.1, 0.25}}) {
    const auto pixel = geometry::project(camera, pose(angles).rotation * direction);
    ASSERT_TRUE(pixel);
    const Eigen::Vector2i sample = (*pixel / saliency_cell_px).array().round().cast<int>();
    // Half a cell is 0.014 rad, a seventh of the radius: 1 - exp(-1/98), on two axes.
    constexpr double half_a_cell = 0.03;
    EXPECT_LE(kept(sample.x(), sample.y(), start_us, angles), half_a_cell);
  }
}

TEST_F(InhibitionOf, APlaceOutOfSightCostsNothing) {
  inhibition.add(direction_of({160, 240}), start_us);
  EXPECT_TRUE(inhibition.kept(pose({-1.5, 0.0}), start_us).empty());
  EXPECT_NEAR(kept(10, 15), 0.0, factor_tolerance);  // and is still known
}

TEST_F(InhibitionOf, BehindTheCameraNothingIsMirrored) {
  inhibition.add(-direction_of({160, 240}), start_us);
  EXPECT_TRUE(inhibition.kept(pose(), start_us).empty());
}

TEST_F(InhibitionOf, PlacesMultiply) {
  inhibition.add(direction_of({160, 240}), start_us);
  const double one = kept(15, 15);
  Inhibition second(camera, radius_rad, decay_s);
  std::swap(inhibition, second);
  inhibition.add(direction_of({320, 240}), start_us);
  const double other = kept(15, 15);
  inhibition.add(direction_of({160, 240}), start_us);
  EXPECT_NEAR(kept(15, 15), one * other, factor_tolerance);
}

TEST_F(InhibitionOf, LookedAtAgainItIsAsNew) {
  inhibition.add(direction_of({160, 240}), start_us);
  inhibition.add(direction_of({170, 245}), start_us + 10 * second_us);
  inhibition.add(direction_of({160, 240}), start_us + 20 * second_us);
  // A second place would leave a trace of itself 0.1 rad away.
  Inhibition once(camera, radius_rad, decay_s);
  once.add(direction_of({160, 240}), start_us + 20 * second_us);
  const auto a = inhibition.kept(pose(), start_us + 25 * second_us);
  const auto b = once.kept(pose(), start_us + 25 * second_us);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST_F(InhibitionOf, TheOldestOfTooManyPlacesIsForgotten) {
  const auto place = [](std::size_t i) {
    const double yaw_rad = -1.5 + 0.18 * static_cast<double>(i);
    return Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  };
  for (std::size_t i = 0; i <= Inhibition::most_places; ++i)
    inhibition.add(place(i), start_us + static_cast<std::int64_t>(i));
  for (std::size_t i = 0; i <= Inhibition::most_places; ++i) {
    const geometry::HeadAngles angles{-1.5 + 0.18 * static_cast<double>(i), 0.0};
    const auto pixel = geometry::project(camera, pose(angles).rotation * place(i));
    const Eigen::Vector2i sample = (*pixel / saliency_cell_px).array().round().cast<int>();
    const double left = kept(sample.x(), sample.y(), start_us + second_us, angles);
    if (i == 0) {
      EXPECT_GT(left, 0.5);  // its neighbour's flank, 1.8 radii away
    } else {
      EXPECT_LT(left, 0.2) << "place " << i;
    }
  }
}

TEST_F(InhibitionOf, AClockThatIsSetBackForgets) {
  inhibition.add(direction_of({160, 240}), start_us);
  EXPECT_TRUE(inhibition.kept(pose(), start_us - second_us).empty());
  EXPECT_TRUE(inhibition.kept(pose(), start_us).empty());
}

TEST(Inhibit, ASampleWithoutARayIsLeftAlone) {
  geometry::CameraModel camera = geometry::robot_profile("nao-v6")->rig.camera;
  camera.distortion = {-0.9, 0.0, 0.0, 0.0, 0.0};  // folds back inside the image
  ASSERT_FALSE(geometry::normalise(camera, {0, 0}));
  Inhibition inhibition(camera, 1.0, decay_s);
  inhibition.add(Eigen::Vector3d::UnitX(), start_us);
  const auto kept = inhibition.kept(geometry::cam_from_torso({}, {}), start_us);
  ASSERT_FALSE(kept.empty());
  EXPECT_EQ(kept.front(), all_kept);
}

TEST(Inhibit, MultipliesExactly) {
  Grid<std::int32_t> map(2, 2, 255 << 16);
  map.at(0, 1) = 1001;
  const std::array<std::uint16_t, 4> kept{all_kept, all_kept / 2, all_kept / 2, 0};
  inhibit(map.plane(), kept);
  EXPECT_EQ(map.at(0, 0), 255 << 16);
  EXPECT_EQ(map.at(1, 0), 255 << 15);
  EXPECT_EQ(map.at(0, 1), 500);
  EXPECT_EQ(map.at(1, 1), 0);
  inhibit(map.plane(), {});
  EXPECT_EQ(map.at(0, 0), 255 << 16);
}

TEST_F(InhibitionOf, TheSecondObjectWinsThenTheThird) {
  const std::array<geometry::Pixel, 3> objects{geometry::Pixel(144, 128), geometry::Pixel(480, 160),
                                               geometry::Pixel(320, 368)};
  frames::Canvas canvas(640, 480, {205, 205, 195});
  canvas.disc(144, 128, 24, {190, 30, 30}).disc(480, 160, 24, {180, 60, 50});
  canvas.disc(320, 368, 24, {170, 80, 70});
  Saliency saliency({}, 640, 480);
  constexpr double same_place_px = 24.0;  // an object's radius
  for (const geometry::Pixel& object : objects) {
    const SaliencyResult seen =
        saliency.examine(canvas.view(), {.kept = inhibition.kept(pose(), start_us)});
    EXPECT_LE((seen.peak_px - object).norm(), same_place_px) << seen.peak_px.transpose();
    inhibition.add(direction_of(seen.peak_px), start_us);
  }
}

}  // namespace
}  // namespace gazed::saliency::inhibition_test
