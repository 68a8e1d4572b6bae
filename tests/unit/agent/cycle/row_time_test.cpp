// A rolling shutter: the head's angles are those of the time when the target's row was exposed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::row_time_test {
namespace {

constexpr double readout_s = 0.037;   // the V6's top camera (agent/geometry/README.md)
constexpr double last_row = 479.0;    // of nao-v6
constexpr double drift_rad_s = 0.02;  // well under the limit of still
constexpr std::int64_t start_us = 1'000'000;
constexpr double tolerance_us = 1.0;  // the history's times are whole microseconds

/// The time by a head that stands still and seems to drift.
double time_us(geometry::HeadAngles seems, std::optional<geometry::HeadAngles> stands) {
  return start_us + 1e6 * (seems.yaw_rad - stands.value().yaw_rad) / drift_rad_s;
}

struct Look {
  double row_us;    // by the head's angles
  double frame_us;  // of the frame nearest before
  double row;
};

/// The first two looks of a fixation. The joints stop dead.
std::array<Look, 2> two_looks(double modelled_readout_s, std::string_view scene) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.camera.readout_s = modelled_readout_s;
  SimulatedHead dut(std::string(scene) + "[joints]\nsettle_time_constant_s = 0\n", setup);
  dut.measured = [](geometry::HeadState state) {
    state.measured.yaw_rad += 1e-6 * drift_rad_s * static_cast<double>(state.utime_us - start_us);
    state.velocity_rad_s = {drift_rad_s, 0.0};
    return state;
  };
  std::vector<double> frames_us;
  dut.seen = [&](const geometry::Frame& frame) {
    frames_us.push_back(static_cast<double>(frame.utime_us));
    return frame;
  };
  const auto fixation = dut.run();
  std::array<Look, 2> out;
  out.fill({NAN, NAN, NAN});  // and no comparison holds
  if (!fixation || fixation->look_count < out.size()) return out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const FixationLook& look = fixation->looks[k];
    const double row_us = time_us(look.measured, dut.robot->true_angles(look.utime_us));
    const double row = look.pixel.y();
    const double first_row_us = row_us - 1e6 * modelled_readout_s * row / last_row;
    const auto nearest = std::ranges::min_element(
        frames_us, {}, [&](double frame_us) { return std::abs(frame_us - first_row_us); });
    out[k] = {row_us, *nearest, row};
  }
  return out;
}

// The report's object in the corner, test 2: far from the middle row.
constexpr std::string_view report_test_2 =
    "[camera]\npixel_noise = 2.0\n[[report_test]]\nnumber = 2\n";

TEST(RowTime, AnglesAreThoseOfTheTargetsRow) {
  for (const std::string_view scene : {report_test_1, report_test_2}) {
    for (const Look& look : two_looks(readout_s, scene))
      EXPECT_NEAR(look.row_us - look.frame_us, 1e6 * readout_s * look.row / last_row, tolerance_us);
  }
}

TEST(RowTime, WithoutARollingShutterTheyAreThoseOfTheFrame) {
  for (const std::string_view scene : {report_test_1, report_test_2}) {
    for (const Look& look : two_looks(0.0, scene))
      EXPECT_NEAR(look.row_us, look.frame_us, tolerance_us);
  }
}

}  // namespace
}  // namespace gazed::cycle::row_time_test
