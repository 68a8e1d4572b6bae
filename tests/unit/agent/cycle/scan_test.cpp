// A simulated wall with four things on it: without scan the gaze stays with one, with it it goes
// round; and a light that blinks is looked at when flicker has a weight.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::scan_test {
namespace {

/// Where they are in four_things.toml, torso frame.
const std::array<Eigen::Vector3d, 4> things{
    {{0.69, 0.14, 0.27}, {0.69, -0.14, 0.27}, {0.69, 0.14, 0.07}, {0.69, -0.14, 0.07}}};

std::string wall_with_things() {
  std::ifstream file(GAZED_TEST_DATA "/scenes/four_things.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The thing that a fixation located; things.size() when none is within 0.1 m.
std::size_t thing_at(const Fixation& fixation) {
  const auto near = std::find_if(things.begin(), things.end(), [&](const Eigen::Vector3d& thing) {
    return (fixation.estimate.torso_point_m - thing).norm() < 0.1;
  });
  return static_cast<std::size_t>(near - things.begin());
}

std::vector<std::size_t> visited(SimulatedHead& dut, int fixations) {
  std::vector<std::size_t> things_seen;
  for (int i = 0; i < fixations; ++i) {
    const auto fixation = dut.run();
    if (!fixation) break;
    things_seen.push_back(thing_at(*fixation));
    dut.robot->next_test();  // the head goes back to (0, 0)
  }
  return things_seen;
}

TEST(Scan, WithoutItTheGazeStaysWithOneThing) {
  SimulatedHead dut(wall_with_things(), calibrated_nao_v6());
  const auto seen = visited(dut, 2);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), 1U);
  EXPECT_LT(seen.front(), things.size());
}

TEST(Scan, AllThingsAreVisitedAndThenAgain) {
  Parts parts = calibrated_nao_v6();
  parts.cycle.saliency.scan = true;
  SimulatedHead dut(wall_with_things(), parts);
  const auto seen = visited(dut, 6);
  ASSERT_EQ(seen.size(), 6U);
  EXPECT_EQ(std::set(seen.begin(), seen.begin() + 4), (std::set<std::size_t>{0, 1, 2, 3}));
  // Then the more salient ones come round sooner, but none at once.
  EXPECT_EQ(std::count(seen.begin(), seen.end(), things.size()), 0);
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(Scan, WithAShortMemoryTheMostSalientThingComesBackSoon) {
  Parts parts = calibrated_nao_v6();
  parts.cycle.saliency.scan = true;
  parts.cycle.saliency.inhibition_decay_s = 0.2;
  SimulatedHead dut(wall_with_things(), parts);
  const auto seen = visited(dut, 1);
  ASSERT_FALSE(dut.run(0.0));
  // Four decays later 2 % are left.
  const std::int64_t later_us = dut.robot->now_us() + 800'000;
  while (dut.robot->now_us() < later_us) (void)dut.robot->next_frame();
  EXPECT_EQ(visited(dut, 1), seen);
}

// What nobody would call an object is not inhibited when it becomes one.
TEST(Scan, APlaceThatDidNotStandOutIsNotInhibited) {
  Parts parts = calibrated_nao_v6();
  const std::vector<std::size_t> first = [&] {
    SimulatedHead dut(wall_with_things(), parts);
    return visited(dut, 1);
  }();
  parts.cycle.saliency.scan = true;
  SimulatedHead dut(wall_with_things(), parts);
  base::Image faint(640, 480, base::PixelFormat::rgb24);
  bool dim = true;
  dut.seen = [&](const geometry::Frame& frame) {
    faint.assign(frame.image);
    // The wall and its things, all but grey.
    for (std::uint8_t& byte : faint.pixels())
      if (dim) byte = static_cast<std::uint8_t>(128 + (byte - 128) / 32);
    return geometry::Frame{faint.view(), frame.utime_us};
  };
  const auto nothing = dut.run();
  ASSERT_TRUE(nothing);
  ASSERT_EQ(nothing->status, Status::no_salient_object) << nothing->reason;
  dim = false;
  EXPECT_EQ(visited(dut, 1), first);
}

// Where the head stays after a fixation, the places stay where they are too.
TEST(Scan, TheHeadNeedNotGoBack) {
  Parts parts = calibrated_nao_v6();
  parts.cycle.saliency.scan = true;
  SimulatedHead dut(wall_with_things(), parts);
  std::set<std::size_t> seen;
  for (int i = 0; i < 4; ++i) {
    const auto fixation = dut.run();
    ASSERT_TRUE(fixation);
    seen.insert(thing_at(*fixation));
  }
  EXPECT_EQ(seen, (std::set<std::size_t>{0, 1, 2, 3}));
}

TEST(Scan, AThingThatBlinksIsLookedAtWhenFlickerHasAWeight) {
  for (const double weight : {0.0, 4.0}) {
    Parts parts = calibrated_nao_v6();
    parts.cycle.saliency.flicker_weight = weight;
    SimulatedHead dut(wall_with_things(), parts);
    base::Image blinking(640, 480, base::PixelFormat::rgb24);
    bool on = false;
    dut.seen = [&](const geometry::Frame& frame) {
      blinking.assign(frame.image);
      on = !on;
      // On the fourth thing, at (454, 355) px with the head at (0, 0).
      for (int y = 335; on && dut.commands == 0 && y < 375; ++y)
        for (int x = 434; x < 474; ++x)
          for (int k = 0; k < 3; ++k) {
            std::uint8_t& byte = blinking.row(y)[3 * x + k];
            byte = static_cast<std::uint8_t>(std::min(255, byte + 40));
          }
      return geometry::Frame{blinking.view(), frame.utime_us};
    };
    const auto fixation = dut.run();
    ASSERT_TRUE(fixation);
    const bool looked_at = (fixation->pixel_1 - geometry::Pixel(454, 355)).norm() < 40.0;
    EXPECT_EQ(looked_at, weight > 0.0) << fixation->pixel_1.transpose();
  }
}

}  // namespace
}  // namespace gazed::cycle::scan_test
