// What goes out on the wire, whatever the agent says and the robot does: read back by the robot's
// own decoder.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <variant>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body_control.hpp"
#include "drivers/lola/order_packet.hpp"

#include "tests/lola_robot/encoding.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::lola::wire_test {
namespace {

// The greatest speeds of the NAO's URDFs, in one cycle of 12 ms.
constexpr double greatest_yaw_step_rad = 8.26797 * 0.012;
constexpr double greatest_pitch_step_rad = 7.19407 * 0.012;
// From nothing to 0.7 in half a second, in one cycle; and a float's rounding.
constexpr double greatest_stiffening = 0.7 / 0.5 * 0.012 + 1e-6;
constexpr double margin_rad = 1e-5;  // of the set point to the limits, and more

/// Commands as an agent gone mad may give them.
class MadAgent {
 public:
  geometry::HeadCommand next() { return {0, {angle(), angle()}, speed()}; }

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
  state.torso_rad[0] = agent.below(5000) == 0 ? 1.0F : 0.0F;  // it falls, for a cycle
  return state;
}

double difference(float a, float b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

/// What holds of any order, when the joints had `before`: the order before it, or what the robot
/// measured where it is taken over.
void expect_allowed(const lola_robot::Order& order, const lola_robot::Order& before,
                    const LolaState& found) {
  const geometry::HeadAngles head{static_cast<double>(order.position[head_yaw]),
                                  static_cast<double>(order.position[head_pitch])};
  ASSERT_TRUE(geometry::HeadLimits().contains(head)) << head.yaw_rad << ' ' << head.pitch_rad;
  ASSERT_LE(difference(order.position[head_yaw], before.position[head_yaw]), greatest_yaw_step_rad);
  ASSERT_LE(difference(order.position[head_pitch], before.position[head_pitch]),
            greatest_pitch_step_rad);
  for (const std::size_t joint : {head_yaw, head_pitch}) {
    ASSERT_TRUE(order.stiffness[joint] >= 0.0F && order.stiffness[joint] <= 1.0F);
    ASSERT_LE(difference(order.stiffness[joint], before.stiffness[joint]), greatest_stiffening);
  }
  for (std::size_t joint = 2; joint < joint_count; ++joint) {
    ASSERT_EQ(order.position[joint], found.position_rad[joint]);
    ASSERT_EQ(order.stiffness[joint], found.stiffness[joint]);
  }
}

/// As what the head counts where it is taken over; limp where it must not be.
lola_robot::Order taken_over(const LolaState& state) {
  lola_robot::Order order;
  const geometry::HeadAngles allowed = geometry::HeadLimits().clamp(state.head());
  order.position[head_yaw] = static_cast<float>(allowed.yaw_rad);
  order.position[head_pitch] = static_cast<float>(allowed.pitch_rad);
  const bool outside = geometry::greatest_difference(allowed, state.head()) >
                       drivers::HeadGuard::follows_within_rad + margin_rad;
  for (const std::size_t joint : {head_yaw, head_pitch})
    order.stiffness[joint] = outside ? 0.0F : state.stiffness[joint];
  return order;
}

TEST(Wire, NoCommandLeavesTheLimitsOrTheSpeedOfTheJoints) {
  constexpr int life = 10'000, end_of_life = 100;  // cycles of a gazed; those in which it lets go
  MadAgent agent;
  BodyControl control(OtherJoints::hold);
  LolaState state;
  state.stiffness.fill(0.6F);
  for (std::size_t i = 2; i < joint_count; ++i)
    state.position_rad[i] = 0.01F * static_cast<float>(i);
  const LolaState found = state;
  lola_robot::Order last = taken_over(state);
  std::int64_t now_us = 0, refused = 0;
  int answers = 0, take_overs = 0;
  bool interrupted = true;
  const int cycles = test::trials(1'000'000, 20'000);
  for (int i = 0; i < cycles; ++i) {
    if (i % life == 0) {
      control = BodyControl(OtherJoints::hold);
      interrupted = true;
    }
    if (i % life == life - end_of_life) control.let_go();
    if (agent.below(2000) == 0) {
      control.interrupt();
      interrupted = true;
    }
    if (i % life < life - end_of_life) control.command(agent.next());
    // Mostly 12 ms; now and then the loop comes late, or twice at once.
    now_us += agent.below(50) == 0 ? static_cast<std::int64_t>(agent.below(200'000)) : 12'000;
    const auto answer = control.answer(state, now_us);
    if (!answer) {
      interrupted = true;
    } else {
      const lola_robot::Order order = decoded(*answer);
      expect_allowed(order, interrupted ? taken_over(state) : last, found);
      if (testing::Test::HasFatalFailure()) FAIL() << "order " << i;
      ++answers;
      if (interrupted) ++take_overs;
      last = order;
      interrupted = false;
    }
    if (i % life == life - 1) {
      EXPECT_TRUE(control.has_let_go() || interrupted) << i;
      refused += control.refused_commands();
    }
    state = next_state(state, last, agent);
  }
  EXPECT_GT(answers, cycles / 2);
  EXPECT_GT(take_overs, cycles / 10'000);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace gazed::lola::wire_test
