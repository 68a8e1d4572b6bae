// What goes out on the wire, whatever the agent says and the robot does: read back by the robot's
// own decoder.
#include <array>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string_view>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body_control.hpp"
#include "drivers/lola/order_packet.hpp"

#include "tests/lola_robot/encoding.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::wire_test {
namespace {

// The greatest speeds of NAO.md 1.3, in one cycle of 12 ms.
constexpr double greatest_yaw_step_rad = 8.26797 * 0.012;
constexpr double greatest_pitch_step_rad = 7.19407 * 0.012;

/// Commands as an agent gone mad may give them.
class MadAgent {
 public:
  HeadCommand next() { return {0, {angle(), angle()}, speed()}; }

  double uniform(double min, double max) {
    return min + (max - min) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  std::uint64_t below(std::uint64_t end) { return random_() % end; }

 private:
  double angle() {
    switch (below(8)) {
      case 0:
        return std::bit_cast<double>(random_());
      case 1:
        return special_[below(special_.size())];
      case 2:
        return uniform(-0.05, 0.05);
      default:
        return uniform(-2.5, 2.5);
    }
  }
  double speed() {
    switch (below(8)) {
      case 0:
        return std::bit_cast<double>(random_());
      case 1:
        return special_[below(special_.size())];
      default:
        return uniform(-0.1, 1.5);
    }
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr std::array<double, 8> special_{
      std::numeric_limits<double>::quiet_NaN(),  infinity, -infinity, 1e300, -1e300, 0.0,
      std::numeric_limits<double>::denorm_min(), 1.526988};
  std::mt19937_64 random_{20'240'601};
};

lola_robot::Order decoded(const LolaOrder& order) {
  const OrderPacket packet = order_packet(order);
  const auto read = lola_robot::read_order({packet.data(), packet.size()});
  EXPECT_TRUE(std::holds_alternative<lola_robot::Order>(read)) << std::get<std::string>(read);
  return std::get<lola_robot::Order>(read);
}

/// A robot's state that follows its orders, now and then with somebody's hand in it.
LolaState next_state(const LolaState& before, const lola_robot::Order& order, MadAgent& agent) {
  LolaState state = before;
  for (const std::size_t joint : {head_yaw, head_pitch}) {
    state.position_rad[joint] += 0.4F * (order.position[joint] - state.position_rad[joint]);
    state.stiffness[joint] = order.stiffness[joint];
  }
  if (agent.below(1000) == 0)
    state.position_rad[head_yaw] = static_cast<float>(agent.uniform(-3, 3));
  if (agent.below(1000) == 0)
    state.position_rad[head_pitch] = static_cast<float>(agent.uniform(-3, 3));
  if (agent.below(5000) == 0) state.temperature_status[head_yaw] ^= 1;
  return state;
}

TEST(Wire, NoCommandLeavesTheLimitsOrTheSpeedOfTheJoints) {
  MadAgent agent;
  BodyControl control(OtherJoints::hold);
  LolaState state;
  state.stiffness.fill(0.6F);
  for (std::size_t i = 2; i < joint_count; ++i)
    state.position_rad[i] = 0.01F * static_cast<float>(i);
  const LolaState first = state;
  const HeadLimits limits;
  lola_robot::Order last;
  last.position[head_yaw] = last.position[head_pitch] = 0.0F;
  std::int64_t now_us = 0;
  for (int i = 0; i < trials(1'000'000, 20'000); ++i) {
    control.command(agent.next());
    // Mostly 12 ms; now and then the loop comes late, or twice at once.
    now_us += agent.below(50) == 0 ? static_cast<std::int64_t>(agent.below(200'000)) : 12'000;
    const auto answer = control.answer(state, now_us);
    ASSERT_TRUE(answer) << control.silence();
    const lola_robot::Order order = decoded(*answer);
    const HeadAngles head{static_cast<double>(order.position[head_yaw]),
                          static_cast<double>(order.position[head_pitch])};
    ASSERT_TRUE(limits.contains(head)) << i << ": " << head.yaw_rad << ' ' << head.pitch_rad;
    const auto moved = [&](std::size_t joint) {
      return std::abs(static_cast<double>(order.position[joint]) -
                      static_cast<double>(last.position[joint]));
    };
    ASSERT_LE(moved(head_yaw), greatest_yaw_step_rad) << i;
    ASSERT_LE(moved(head_pitch), greatest_pitch_step_rad) << i;
    for (std::size_t joint = 2; joint < joint_count; ++joint) {
      ASSERT_EQ(order.position[joint], first.position_rad[joint]);
      ASSERT_EQ(order.stiffness[joint], first.stiffness[joint]);
    }
    ASSERT_TRUE(order.stiffness[head_yaw] >= 0.0F && order.stiffness[head_yaw] <= 1.0F);
    state = next_state(state, order, agent);
    last = order;
  }
  EXPECT_GT(control.refused_commands(), 0);
}

}  // namespace
}  // namespace gazed::wire_test
