// A gazed that dies in mid-turn, and what the head does then: a head played here, over LCM.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <vector>

#include "agent/geometry/limits.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/conversions.hpp"
#include "drivers/lcm/link.hpp"
#include "msgs/gazed/saliency_map_t.hpp"

#include "tests/integration/program.hpp"
#include "tests/network_namespace.hpp"

namespace gazed::integration {
namespace {

using namespace std::chrono_literals;
using test::require;
using Clock = std::chrono::steady_clock;

const std::string url = "udpm://239.255.76.67:7667?ttl=0";
constexpr auto patience = 30s;         // for a gazed that starts under an emulator
constexpr auto control_period = 12ms;  // LoLA's
// Of the head's motion: where the machine holds this process up, the head stands still, too.
constexpr double step_max_s = 0.05;
constexpr double slow_rad_s = 0.2;        // a step of 0.1 rad lasts half a second
constexpr double leaving_max_rad = 0.05;  // half of the smallest turn
constexpr double still_rad_s = 0.03;      // gazed's default for head.settle_velocity_rad_s

std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// Goes where it was last sent, slowly, and says where it is.
class PlayedHead {
 public:
  PlayedHead() {
    link_.subscribe(channels_.head_command, 1000, [this](auto bytes) {
      head_command_t message{};
      require(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) > 0);
      commands.push_back(lcm::from_message(message));
      target = commands.back().target;
    });
    link_.subscribe(channels_.saliency, 100'000, [this](auto bytes) {
      saliency_map_t message{};
      require(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) > 0);
      looks_us.push_back(message.utime);
    });
  }

  // Until `done`, at most for `duration`; whether it was done.
  template <class Condition>
  bool play(Clock::duration duration, Condition done) {
    const Clock::time_point end = Clock::now() + duration;
    while (!done()) {
      if (Clock::now() >= end) return false;
      step();
      const Clock::time_point next = Clock::now() + control_period;
      while (Clock::now() < next) {
        pollfd wait{link_.descriptor(), POLLIN, 0};
        poll(&wait, 1, 2);
        link_.handle();
      }
    }
    return true;
  }
  void play(Clock::duration duration) {
    (void)play(duration, [] { return false; });
  }
  bool there() const {
    return position.yaw_rad == target.yaw_rad && position.pitch_rad == target.pitch_rad;
  }

  geometry::HeadAngles position, target;
  std::vector<geometry::HeadCommand> commands;
  std::vector<std::int64_t> looks_us;  // when the frames of the saliency maps were taken
  std::int64_t last_moved_us = 0;

 private:
  void step() {
    const std::int64_t now = now_us();
    const double elapsed_s =
        last_step_us_ == 0
            ? 0.0
            : std::clamp(1e-6 * static_cast<double>(now - last_step_us_), 0.0, step_max_s);
    last_step_us_ = now;
    const auto towards = [elapsed_s](double& from, double to) {
      from += std::clamp(to - from, -slow_rad_s * elapsed_s, slow_rad_s * elapsed_s);
    };
    if (!there()) last_moved_us = now;
    towards(position.yaw_rad, target.yaw_rad);
    towards(position.pitch_rad, target.pitch_rad);
    head_state_t message{};
    const double moving_rad_s = there() ? 0.0 : slow_rad_s;
    lcm::to_message(geometry::HeadState{now, position, {moving_rad_s, moving_rad_s}, 1.0F, 30.0F},
                    message);
    require(link_.publish(channels_.head_state, message));
  }

  lcm::LcmLink link_{url};
  lcm::Channels channels_{"GAZED"};
  std::int64_t last_step_us_ = 0;
};

std::vector<std::string> gazed_in_the_played_head() {
  return {GAZED_PROGRAM, "--lcm-url", url, "--camera", "sim", "--head", "lcm", "--print", "none"};
}

TEST(Restart, KilledInMidTurnTheHeadArrivesAndStaysAndTheNextGazedWaitsForIt) {
  static_assert(slow_rad_s > still_rad_s);
  (void)temporary_file("before the fork");  // the folder is this process's to remove
  const int result = test::in_empty_network([](test::Network& network) {
    require(network.set_loopback_up() && network.add_multicast_route());
    PlayedHead head;
    {
      RunningProgram running(gazed_in_the_played_head());
      require(head.play(patience, [&] { return !head.commands.empty(); }));
      head.play(100ms);
      require(!head.there());  // in mid-turn
      running.send_signal(SIGKILL);
      require(running.finish().exit_code == 128 + SIGKILL);
    }
    // One command is all that the head has, to a place where it may be.
    require(head.commands.size() == 1);
    require(geometry::HeadLimits(0.0).contains(head.commands[0].target));
    require(head.play(patience, [&] { return head.there(); }));
    head.play(400ms);
    require(head.there() && head.commands.size() == 1);
    require(now_us() - head.last_moved_us > 300'000);

    // Somebody else turns it while the next gazed starts.
    head.looks_us.clear();
    head.target.yaw_rad += head.target.yaw_rad > 0.0 ? -0.25 : 0.25;
    RunningProgram running(gazed_in_the_played_head());
    require(head.play(patience, [&] { return head.there(); }));
    const std::int64_t arrived_us = head.last_moved_us;
    require(head.commands.size() == 1);
    require(head.play(patience, [&] { return head.commands.size() > 1; }));
    require(!head.looks_us.empty() && head.looks_us.front() >= arrived_us);
    // Asked to end, it leaves the head where it is, also in mid-turn.
    head.play(50ms);
    require(!head.there());
    const double asked_at_rad = head.position.yaw_rad;
    running.send_signal(SIGTERM);
    require(running.finish().exit_code == 0);
    require(head.play(patience, [&] { return head.there(); }));
    head.play(300ms);
    require(head.there() && std::abs(head.position.yaw_rad - asked_at_rad) < leaving_max_rad);
  });
  if (result == test::no_namespace)
    GTEST_SKIP() << "this needs the right to make a network namespace";
  EXPECT_EQ(result, test::passed);
}

}  // namespace
}  // namespace gazed::integration
