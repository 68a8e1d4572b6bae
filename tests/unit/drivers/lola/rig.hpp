// A LolaHead and the robot behind its socket, in step: no time passes but by these calls.
#pragma once

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>
#include <vector>

#include "drivers/lola/lola_head.hpp"

#include "tests/lola_robot/robot.hpp"

namespace gazed::lola {

class LolaRig : public testing::Test {
 protected:
  explicit LolaRig(bool shuffled = false, OtherJoints other_joints = OtherJoints::hold)
      : robot_(path_, shuffled), head_({path_, other_joints}, clocks()) {
    robot_.on_order = [this](const lola_robot::Order& order, const lola_robot::Sensors&) {
      orders_.push_back(order);
    };
  }

  /// The head shall not wait for a robot that stands still to let it go.
  void TearDown() override { robot_.suffer(lola_robot::Fault::eof); }

  void run_cycles(int cycles, bool serve = true) {
    for (int i = 0; i < cycles; ++i) {
      robot_.cycle();
      now_us_ += 12'000;
      if (!serve) continue;
      head_.serve();
      while (const auto state = head_.next_state()) {
        states_.push_back(*state);
        last_state_us_ = now_us_;
      }
    }
  }
  static int cycles(double seconds) { return static_cast<int>(std::lround(seconds / 0.012)); }
  void run(double seconds) { run_cycles(cycles(seconds)); }
  /// Connects, and waits until the head is stiff.
  void start() {
    run(1.0);
    ASSERT_EQ(head_.health().words, "");
    ASSERT_FALSE(states_.empty());
  }
  void command(double yaw_rad, double pitch_rad, double speed_fraction = 0.3) {
    head_.command({0, {yaw_rad, pitch_rad}, speed_fraction});
  }
  [[nodiscard]] double yaw() const { return static_cast<double>(robot_.sensors().position[0]); }
  [[nodiscard]] double ordered_yaw() const {
    return static_cast<double>(orders_.back().position[0]);
  }
  /// How long the agent has heard nothing.
  [[nodiscard]] double silent_s() const {
    return 1e-6 * static_cast<double>(now_us_ - last_state_us_);
  }

  drivers::Clocks clocks() {
    return {[this] { return now_us_; }, [this] { return 1'700'000'000'000'000 + now_us_; }};
  }

  std::string path_ = testing::TempDir() + "/lola_test." + std::to_string(getpid());
  std::int64_t now_us_ = 1'000'000'000, last_state_us_ = 0;
  lola_robot::Robot robot_;
  LolaHead head_;
  std::vector<geometry::HeadState> states_;
  std::vector<lola_robot::Order> orders_;
};

/// An encoder's step and a little: where the robot says that it is.
inline constexpr double there_rad = 0.003;

}  // namespace gazed::lola
