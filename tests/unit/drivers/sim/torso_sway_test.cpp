#include "drivers/sim/torso_sway.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "robots.hpp"

namespace gazed::sim::torso_sway_test {
namespace {

using namespace robots;

TEST(TorsoSway, VariesAsMuchAsOneSineOfItsAmplitude) {
  const TorsoSway sway({.translation_m = 0.002, .rotation_rad = 0.005, .frequency_hz = 0.3}, 1);
  Eigen::Vector3d squares_m2 = Eigen::Vector3d::Zero(), squares_rad2 = Eigen::Vector3d::Zero();
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    const geometry::Pose pose = sway.room_from_torso(0.1 * i);
    const Eigen::AngleAxisd turn(pose.rotation);
    squares_m2 += pose.translation.cwiseAbs2();
    squares_rad2 += (turn.angle() * turn.axis()).cwiseAbs2();
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(squares_m2[axis] / count), 0.002 / std::sqrt(2.0), 2e-5);
    EXPECT_NEAR(std::sqrt(squares_rad2[axis] / count), 0.005 / std::sqrt(2.0), 5e-5);
  }
}

TEST(TorsoSway, IsSmoothAndEachSeedsOwn) {
  const Sway behaviour{.translation_m = 0.002, .rotation_rad = 0.005, .frequency_hz = 0.3};
  const TorsoSway sway(behaviour, 1), again(behaviour, 1), other(behaviour, 2);
  // Each of three sines at up to 1.41 times the frequency, together 1.73 amplitudes.
  const double fastest_m_s = 2.0 * 3.1416 * 1.41 * 0.3 * std::sqrt(3.0) * 0.002 * std::sqrt(3.0);
  for (double time_s = 0.0; time_s < 20.0; time_s += 0.01) {
    const Eigen::Vector3d now = sway.room_from_torso(time_s).translation;
    EXPECT_LE((sway.room_from_torso(time_s + 0.01).translation - now).norm(), 0.01 * fastest_m_s);
    EXPECT_EQ(now, again.room_from_torso(time_s).translation);
  }
  EXPECT_NE(sway.room_from_torso(1.0).translation, other.room_from_torso(1.0).translation);
}

/// Where red is, in channel 0's excess over channel 1.
geometry::Pixel red_centre(const base::ImageView& image) {
  double weight = 0.0;
  geometry::Pixel sum = geometry::Pixel::Zero();
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const double red = image.row(y)[3 * x] - image.row(y)[3 * x + 1];
      if (red < 20.0) continue;
      weight += red;
      sum += red * geometry::Pixel(x, y);
    }
  return sum / weight;
}

TEST(TorsoSway, TheSwayingRobotSeesItsTargetWhereTheTruthHasIt) {
  const std::string scene = small +
                            "readout_s = 0.037\n"
                            "[sway]\ntranslation_m = 0.01\nrotation_rad = 0.03\nfrequency_hz = 1\n"
                            "[object]\nsize_m = [0.03, 0.03]\n" +
                            one_test;
  const auto robot = robot_in(scene);
  geometry::Pixel least = geometry::Pixel::Constant(1e9), most = -least;
  for (int i = 0; i < 30; ++i) {
    const geometry::Frame frame = *robot->next_frame();
    const geometry::Pixel seen = red_centre(frame.image);
    const SimTruth truth = robot->truth();  // at the end of the readout
    const geometry::Pose pose = geometry::cam_from_torso(truth.head, truth.angles);
    const geometry::Pixel expected =
        *geometry::project(truth.camera, pose * *truth.target_in_torso);
    // Half a readout: 0.6 amplitudes of 0.03 rad x 152 px at 2 pi Hz.
    EXPECT_LT((seen - expected).norm(), 2.0);
    const Hit hit = *robot->true_hit_in_frame(frame.utime_us, seen);
    EXPECT_TRUE(hit.target);
    const double edge_px = 0.5 * 0.03 / 0.3 * truth.camera.focal_px.x();
    EXPECT_FALSE(
        robot->true_hit_in_frame(frame.utime_us, seen + geometry::Pixel(edge_px + 1.0, 0.0))
            ->target);
    least = least.cwiseMin(seen);
    most = most.cwiseMax(seen);
  }
  EXPECT_GT((most - least).minCoeff(), 3.0);
}

TEST(TorsoSway, OneRowOfASwayingPictureIsSeenFromWhereTheTorsoThenIs) {
  // Two robots, the second with a shutter that takes no time: the first row is the same, others are
  // not.
  const std::string sway = "[sway]\ntranslation_m = 0.02\nrotation_rad = 0.05\nfrequency_hz = 5\n";
  const std::string object =
      "[object]\nsize_m = [0.3, 0.3]\n"
      "texture = { pattern = \"checker\", cell_m = 0.03 }\n";
  const auto rolling = robot_in(small + "readout_s = 0.037\n" + sway + object + one_test);
  const auto global = robot_in(small + sway + object + one_test);
  const std::vector<std::uint8_t> a = bytes(*rolling->next_frame()),
                                  b = bytes(*global->next_frame());
  const std::size_t row = 3U * 160U;
  EXPECT_TRUE(std::equal(a.begin(), a.begin() + row, b.begin()));
  EXPECT_FALSE(std::equal(a.end() - row, a.end(), b.end() - row));
}

}  // namespace
}  // namespace gazed::sim::torso_sway_test
