// What the robot sees of itself is no object.
#include "agent/saliency/own_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "agent/geometry/head.hpp"
#include "agent/geometry/limits.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/saliency/inhibition.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"

namespace gazed::saliency::own_parts_test {
namespace {

using frames::Canvas;
using geometry::CameraPosition;
using geometry::HeadAngles;

constexpr int map_width = 40, map_height = 30;

geometry::Rig rig_of(CameraPosition position, std::string_view robot = "nao-v6") {
  return geometry::robot_profile(robot, position)->rig;
}

/// Whether a sample is left out; none is when nothing is in view.
class Mask {
 public:
  explicit Mask(std::span<const std::uint16_t> kept) : kept_(kept.begin(), kept.end()) {}

  [[nodiscard]] bool at(int x, int y) const {
    return !kept_.empty() && kept_[static_cast<std::size_t>(y * map_width + x)] == 0;
  }
  [[nodiscard]] bool at(const geometry::Pixel& pixel) const {
    return at(
        std::clamp(static_cast<int>(std::lround(pixel.x() / saliency_cell_px)), 0, map_width - 1),
        std::clamp(static_cast<int>(std::lround(pixel.y() / saliency_cell_px)), 0, map_height - 1));
  }
  [[nodiscard]] int count() const {
    return static_cast<int>(std::ranges::count(kept_, std::uint16_t{0}));
  }
  [[nodiscard]] const std::vector<std::uint16_t>& factors() const { return kept_; }

 private:
  std::vector<std::uint16_t> kept_;
};

Mask mask_of(const geometry::Rig& rig, HeadAngles head, bool body, bool feet) {
  OwnParts parts(rig.camera, body, feet);
  return Mask(parts.kept(geometry::cam_from_torso(rig.head, head)));
}

double distance_m(const Eigen::Vector3d& point, const Capsule& capsule) {
  const Eigen::Vector3d along = capsule.to_m - capsule.from_m;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((point - capsule.from_m).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - capsule.from_m - share * along).norm();
}

TEST(OwnParts, OfATopCameraThatLooksAheadNothingIsInView) {
  for (const std::string_view robot : geometry::robot_names) {
    const geometry::Rig rig = rig_of(CameraPosition::top, robot);
    EXPECT_EQ(mask_of(rig, {}, true, true).count(), 0) << robot;
    EXPECT_EQ(mask_of(rig, {0.5, -0.3}, true, true).count(), 0) << robot;
  }
}

TEST(OwnParts, WhatIsNotToBeLeftOutIsNot) {
  const geometry::Rig rig = rig_of(CameraPosition::bottom);
  EXPECT_EQ(mask_of(rig, {1.5, 0.2}, false, false).count(), 0);
  EXPECT_GT(mask_of(rig, {1.5, 0.2}, true, false).count(), 0);
  EXPECT_EQ(mask_of(rig, {0.0, 0.2}, true, false).count(), 0);
  EXPECT_GT(mask_of(rig, {0.0, 0.2}, false, true).count(), 0);
}

// Else all of a frame would be left out.
TEST(OwnParts, NoCameraIsInsideOfAPart) {
  const geometry::HeadLimits limits;
  for (const std::string_view robot : geometry::robot_names) {
    for (const CameraPosition position : {CameraPosition::top, CameraPosition::bottom}) {
      const geometry::HeadGeometry head = rig_of(position, robot).head;
      for (double yaw_rad = -2.0; yaw_rad <= 2.0; yaw_rad += 0.1) {
        for (double pitch_rad = -0.6; pitch_rad <= 0.5; pitch_rad += 0.1) {
          const HeadAngles angles = limits.clamp({yaw_rad, pitch_rad});
          const Eigen::Vector3d camera = origin(geometry::cam_from_torso(head, angles));
          for (const Capsule& part : body_parts())
            EXPECT_GT(distance_m(camera, part), part.radius_m)
                << robot << " " << yaw_rad << " " << pitch_rad;
        }
      }
    }
  }
}

/// Points of the surface; a shoulder at 0.06 m has one for every 13 pixels, feet for every 20.
std::vector<Eigen::Vector3d> surface(const Capsule& part) {
  constexpr int turns = 4000, steps = 20;
  std::vector<Eigen::Vector3d> points;
  for (int s = 0; s <= (part.from_m == part.to_m ? 0 : steps); ++s) {
    const Eigen::Vector3d middle =
        part.from_m + (part.to_m - part.from_m) * static_cast<double>(s) / steps;
    for (int i = 0; i < turns; ++i) {
      // A spiral from pole to pole, by the golden angle.
      const double z = -1.0 + 2.0 * (i + 0.5) / turns, r = std::sqrt(1.0 - z * z);
      const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      points.emplace_back(middle + part.radius_m *
                                       Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z));
    }
  }
  return points;
}

/// The samples of a map, and of three more around it, where something is drawn.
class Drawing {
 public:
  void add(const geometry::Pixel& pixel) {
    const auto x = std::lround(pixel.x() / saliency_cell_px) + margin;
    const auto y = std::lround(pixel.y() / saliency_cell_px) + margin;
    if (x >= 0 && x < width && y >= 0 && y < height)
      drawn_.at(static_cast<std::size_t>(y * width + x)) = true;
  }
  [[nodiscard]] bool near(int x, int y, int reach) const {
    for (int v = y - reach; v <= y + reach; ++v)
      for (int u = x - reach; u <= x + reach; ++u)
        if (drawn_.at(static_cast<std::size_t>((v + margin) * width + u + margin))) return true;
    return false;
  }

 private:
  static constexpr int margin = 3;
  static constexpr int width = map_width + 2 * margin, height = map_height + 2 * margin;
  std::array<bool, std::size_t{width} * height> drawn_{};
};

// What is drawn of the parts is left out, and nothing two samples beside it. The last samples stand
// for what is up to half a sample beyond them.
TEST(OwnParts, AreLeftOutWhereTheyAreProjected) {
  const geometry::Pixel last(saliency_cell_px * (map_width - 0.5),
                             saliency_cell_px * (map_height - 0.5));
  const geometry::Rig rig = rig_of(CameraPosition::bottom);
  for (const HeadAngles angles :
       {HeadAngles{1.2, 0.1}, {-1.5, 0.2}, {0.0, 0.5}, {-0.4, 0.3}, {2.0, 0.0}}) {
    const geometry::Pose pose = geometry::cam_from_torso(rig.head, angles);
    const Mask mask = mask_of(rig, angles, true, true);
    Drawing drawing;
    int not_left_out = 0;
    for (const std::span<const Capsule> parts : {body_parts(), standing_feet()}) {
      for (const Capsule& part : parts) {
        for (const Eigen::Vector3d& point : surface(part)) {
          const auto pixel = geometry::project(rig.camera, pose * point);
          if (!pixel) continue;
          drawing.add(*pixel);
          const bool seen = rig.camera.contains(*pixel) && (*pixel - last).maxCoeff() <= 0.0;
          not_left_out += seen && !mask.at(*pixel);
        }
      }
    }
    EXPECT_EQ(not_left_out, 0) << angles.yaw_rad << " " << angles.pitch_rad;
    EXPECT_GT(mask.count(), 0) << angles.yaw_rad << " " << angles.pitch_rad;
    for (int y = 0; y < map_height; ++y)
      for (int x = 0; x < map_width; ++x)
        EXPECT_TRUE(!mask.at(x, y) || drawing.near(x, y, 2))
            << x << " " << y << " at " << angles.yaw_rad << " " << angles.pitch_rad;
  }
}

// bodyContour.cfg of B-Human 2009, which has its origin 85 mm lower: the torso's outline as its
// bottom camera saw it.
TEST(OwnParts, TheChestIsWhereOthersCutItOut) {
  constexpr double between_hips_m = 0.085;
  const geometry::Rig rig = rig_of(CameraPosition::bottom);
  const HeadAngles down{0.0, 0.51};
  const Mask mask = mask_of(rig, down, true, false);
  int in_view = 0;
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.060, 0.017, 0.160),
                                       {0.060, -0.017, 0.160},
                                       {0.053, 0.045, 0.160},
                                       {0.053, -0.045, 0.160}}) {
    const auto pixel =
        geometry::project(rig.camera, geometry::cam_from_torso(rig.head, down) *
                                          (point - Eigen::Vector3d(0.0, 0.0, between_hips_m)));
    if (!pixel || !rig.camera.contains(*pixel)) continue;
    ++in_view;
    EXPECT_TRUE(mask.at(*pixel)) << point.transpose();
  }
  EXPECT_GT(in_view, 0);
}

TEST(OwnParts, ALensThatCannotBeUndoneLeavesItsSamples) {
  geometry::Rig rig = rig_of(CameraPosition::bottom);
  rig.camera.distortion = {-0.9, 0.0, 0.0, 0.0, 0.0};  // folds back inside the image
  const Mask mask = mask_of(rig, {1.5, 0.2}, true, false);
  EXPECT_GT(mask.count(), 0);
  EXPECT_FALSE(mask.at(0, 0));
}

/// Turf as the bottom camera of a robot that stands sees it, and its white toes.
class OnTurf : public testing::Test {
 protected:
  void SetUp() override {
    canvas = Canvas(640, 480, {60, 120, 50});
    for (int i = 0; i < 900; ++i)
      canvas.rectangle(i * 7919 % 640, i * 104'729 % 480, 3, 9,
                       i % 2 == 0 ? frames::Colour{75, 140, 60} : frames::Colour{48, 100, 42});
    for (const int x : {190, 450})
      canvas.disc(x, 440, 34, {225, 225, 228}).rectangle(x - 34, 440, 68, 40, {225, 225, 228});
  }
  [[nodiscard]] SaliencyResult look(bool feet) {
    const Mask mask = mask_of(rig_of(CameraPosition::bottom), {0.0, 0.15}, true, feet);
    return stage.examine(Canvas(canvas).noise(2, 1).view(), {.without_own_parts = mask.factors()});
  }

  Canvas canvas{640, 480, frames::grey};
  Saliency stage{SaliencySettings{}, 640, 480};
};

TEST_F(OnTurf, TheToesAreNoObject) {
  EXPECT_GT(look(false).peak_px.y(), 380.0);
  EXPECT_LT(look(true).peak_px.y(), 380.0);
}

TEST_F(OnTurf, ABallIsFoundBesideThem) {
  canvas.disc(330, 170, 18, {200, 110, 40});
  const geometry::Pixel winner = look(true).peak_px;
  EXPECT_LE((winner - geometry::Pixel(330, 170)).norm(), 18.0) << winner.transpose();
}

TEST_F(OnTurf, AllLeftOutIsNoObject) {
  const std::vector<std::uint16_t> nothing(std::size_t{map_width} * map_height);
  const SaliencyResult seen = stage.examine(canvas.view(), {.without_own_parts = nothing});
  EXPECT_EQ(seen.distinctness, 0.0F);
  EXPECT_EQ(seen.saliency, 0.0F);
}

}  // namespace
}  // namespace gazed::saliency::own_parts_test
