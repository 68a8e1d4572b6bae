// Whatever a head says of itself, it is never sent outside its limits.
#include "agent/geometry/limits.hpp"

#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "tests/unit/agent/cycle/simulated_head.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::cycle::limits_test {
namespace {

/// A head whose sensors are turned against its joints, by so much at rest and by a little more at
/// every look. It goes to where its sensors say what it was told.
struct Turned {
  Turned(const HeadSetup& setup, geometry::HeadAngles by, unsigned seed)
      : dut(report_test_1, setup), offset(by), random(seed) {
    dut.obeys = false;
    dut.measured = [this](geometry::HeadState state) {
      state.measured = state.measured + offset + error;
      return state;
    };
    dut.commanded = [this](const geometry::HeadCommand& command) {
      told.push_back(command);
      geometry::HeadCommand obeyed = command;
      obeyed.target = command.target - offset;
      dut.robot->command(obeyed);
      error = {error_rad(random), error_rad(random)};
    };
  }

  SimulatedHead dut;
  geometry::HeadAngles offset, error;
  std::vector<geometry::HeadCommand> told;
  std::mt19937 random;
  // More than the margin, less than what makes a head that has arrived look as if it had not.
  std::uniform_real_distribution<double> error_rad{-0.045, 0.045};
};

TEST(Limits, WhateverAHeadReportsNoCommandLeavesThem) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = 6;
  setup.cycle.locate.plan = gaze::Plan::parallax;
  setup.cycle.motion.margin_rad = 0.03;
  setup.rig.uncertainty.encoder_sigma_rad = 0.02;
  const geometry::HeadLimits limits, with_margin(setup.cycle.motion.margin_rad);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> yaw_rad(-2.2, 2.2), beyond_rad(-0.1, 0.095);
  std::size_t commands = 0, outside = 0;
  for (int i = 0; i < test::trials(12, 3); ++i) {
    // At the edge of the limits, on one side of it or the other.
    const double yaw = yaw_rad(random), by = beyond_rad(random);
    const geometry::AngleRange pitch = with_margin.pitch_range(yaw);
    const geometry::HeadAngles start{yaw, i % 2 == 0 ? pitch.min_rad - by : pitch.max_rad + by};
    if (!limits.contains(start)) ++outside;
    Turned turned(setup, start, 100U + static_cast<unsigned>(i));
    turned.dut.run(8.0);
    for (const geometry::HeadCommand& command : turned.told) {
      ASSERT_TRUE(with_margin.contains(command.target))
          << "from " << start.yaw_rad << ' ' << start.pitch_rad << " to " << command.target.yaw_rad
          << ' ' << command.target.pitch_rad;
    }
    commands += turned.told.size();
  }
  EXPECT_GT(outside, 0U);
  EXPECT_GT(commands, static_cast<std::size_t>(2 * test::trials(12, 3)));
}

}  // namespace
}  // namespace gazed::cycle::limits_test
