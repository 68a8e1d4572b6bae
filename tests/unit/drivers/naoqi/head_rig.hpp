// A head and the robot that it belongs to, in the test's own time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "drivers/naoqi/naoqi_head.hpp"

#include "tests/unit/allocations.hpp"
#include "tests/unit/drivers/naoqi/fake_motion.hpp"

namespace gazed::naoqi {

inline constexpr std::int64_t turn_us = 1'000;

// Time goes on by 1 ms a turn, of both clocks: the monotonic one is made to be late by 1 s, so that
// neither can stand for the other.
class NaoqiHeadRig : public testing::Test {
 protected:
  // A robot that is gone is not waited for.
  ~NaoqiHeadRig() override { robot_.close_all(); }

  NaoqiHead& dut() {
    if (!dut_) {
      dut_.emplace(NaoqiHeadSettings{.robot = {robot_.endpoint(), "", ""}},
                   drivers::Clocks{[this] { return monotonic_us(); }, [this] { return now_us_; }});
    }
    return *dut_;
  }

  void turn() {
    if (robot_.serve()) await_arrival(dut().descriptor());
    now_us_ += turn_us;
    const long before = test::allocations();
    while (const auto state = dut().next_state()) states_.push_back(*state);
    allocated_ += test::allocations() - before;
  }
  /// The driver ends, and the robot answers meanwhile.
  void end() {
    serves_by_itself_ = true;
    dut_.reset();
    serves_by_itself_ = false;
    robot_.serve();
  }
  void turn_for(double seconds) {
    for (const std::int64_t end = now_us_ + std::llround(1e6 * seconds); now_us_ < end;) turn();
  }
  template <typename Condition>
  bool turn_until(Condition condition) {
    for (int i = 0; i < 5'000 && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_fault(const std::string& part) {
    return turn_until([&] { return dut().health().words.find(part) != std::string::npos; });
  }
  /// The head is taken over, and the guard has seen it for a while.
  void start() {
    turn_for(1.0);
    ASSERT_THAT(states_, ::testing::Not(::testing::IsEmpty())) << dut().health().words;
    ASSERT_EQ(dut().health().words, "");
  }
  void command(double yaw_rad, double pitch_rad, double speed_fraction = 0.5) {
    dut().command({now_us_, {yaw_rad, pitch_rad}, speed_fraction});
  }
  FakeNaoqi::Method& method(const std::string& name) {
    return *std::ranges::find(robot_.methods, name, &FakeNaoqi::Method::name);
  }

  std::int64_t monotonic_us() {
    if (serves_by_itself_) {
      robot_.serve();
      now_us_ += 10'000;  // await_answers() may wait so long
    }
    return now_us_ - 1'000'000;
  }

  bool serves_by_itself_ = false;
  FakeNaoqi robot_;
  FakeMotion motion_{robot_};
  std::int64_t now_us_ = 1'700'000'000'000'000;
  std::vector<geometry::HeadState> states_;
  long allocated_ = 0;
  std::optional<NaoqiHead> dut_;
};

}  // namespace gazed::naoqi
