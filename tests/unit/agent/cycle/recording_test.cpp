// Heads that moved as they did, whatever they are told now.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string_view>
#include <vector>

#include "agent/cycle/cycle.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::recording_test {
namespace {

HeadSetup looking(int looks, gaze::Plan plan) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = looks;
  setup.cycle.locate.plan = plan;
  return setup;
}

/// A head that moves as it once did, to and fro, whatever it is told.
struct RecordedHead : SimulatedHead {
  RecordedHead(int looks, gaze::Plan plan) : SimulatedHead(report_test_1, recorded(looks, plan)) {
    obeys = false;
    commanded = [this](const geometry::HeadCommand&) {
      const double away = commands % 2 == 1 ? 0.25 : -0.2;
      robot->command({robot->now_us(), {-away, away}, 0.3});
    };
  }

  static HeadSetup recorded(int looks, gaze::Plan plan) {
    HeadSetup out = looking(looks, plan);
    out.head.obeys = false;
    return out;
  }
};

TEST(Recordings, ARecordedHeadIsNotSentOnDetours) {
  RecordedHead dut(4, gaze::Plan::parallax);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_EQ(dut.commands, 3);
}

TEST(Recordings, ARecordedHeadsMovesAreItsLooks) {
  RecordedHead dut(3, gaze::Plan::report);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  EXPECT_EQ(fixation->status, Status::located);
  EXPECT_EQ(fixation->views, 3);
}

/// What a robot did while it located one object after the other, each in another place.
struct Recording {
  struct Command {
    std::int64_t utime_us;
    geometry::HeadCommand command;
  };
  static constexpr std::string_view scene =
      "[camera]\npixel_noise = 2.0\n"
      "[[target_test]]\nposition_m = [0.35, 0.06, 0.12]\n"
      "[[target_test]]\nposition_m = [0.35, -0.08, 0.08]\n"
      "[[target_test]]\nposition_m = [0.35, 0.10, 0.05]\n"
      "[[target_test]]\nposition_m = [0.35, -0.05, 0.14]\n";
  static constexpr int objects = 4;

  std::vector<Command> commands;
  std::vector<std::int64_t> next_object_us;
  std::vector<std::int64_t> looks_us;

  explicit Recording(const HeadSetup& setup) {
    SimulatedHead live(scene, setup);
    live.commanded = [&](const geometry::HeadCommand& command) {
      commands.push_back({live.robot->now_us(), command});
    };
    live.looked = [&](const UsedSaliency&) { looks_us.push_back(live.robot->now_us()); };
    for (int object = 0; object < objects; ++object) {
      const auto fixation = live.run();
      if (!fixation || fixation->status != Status::located) return;
      next_object_us.push_back(live.robot->now_us());
      live.robot->next_test();
    }
  }
};

/// The recorded robot again, seen by a cycle that does not command it.
struct Playback : SimulatedHead {
  Playback(const Recording& recording, const HeadSetup& setup)
      : SimulatedHead(Recording::scene, setup), recording_(recording) {
    obeys = false;
  }

  /// One event, and what the robot did then.
  std::optional<Fixation> step() {
    constexpr double less_than_an_event_s = 1e-6;
    auto fixation = run(less_than_an_event_s);
    for (; next_command_ < recording_.commands.size(); ++next_command_) {
      const Recording::Command& next = recording_.commands[next_command_];
      if (next.utime_us > robot->now_us()) break;
      robot->command(next.command);
    }
    const std::int64_t next_us = std::min(robot->next_state_utime_us().value_or(INT64_MAX),
                                          robot->next_frame_utime_us().value_or(INT64_MAX));
    // A frame of the same time still shows the last one.
    if (objects_ < Recording::objects && recording_.next_object_us[objects_] < next_us) {
      robot->next_test();
      ++objects_;
    }
    return fixation;
  }

  const Recording& recording_;
  std::size_t next_command_ = 0, objects_ = 0;
};

// A log that is played from its middle, or whose clock steps back, is joined in the middle of a
// fixation. The next object's first two looks were then taken for misses of the last one, and so on
// with every object.
TEST(Recordings, ARecordingThatIsJoinedAmidAFixationIsInStepWithTheNextObject) {
  constexpr int looks = 4;
  HeadSetup setup = looking(looks, gaze::Plan::parallax);
  const Recording recording(setup);
  ASSERT_EQ(recording.next_object_us.size(), std::size_t{Recording::objects});
  setup.head.obeys = false;
  for (std::size_t joined = 0; joined < looks; ++joined) {
    Playback dut(recording, setup);
    const std::int64_t from_us = recording.looks_us[joined] + 1;
    while (dut.robot->now_us() < from_us) (void)dut.step();
    dut.cycle = setup.made();
    int in_step = 0;
    while (dut.objects_ < Recording::objects) {
      const auto fixation = dut.step();
      if (fixation && fixation->status == Status::located && fixation->views == looks) ++in_step;
    }
    EXPECT_EQ(in_step, Recording::objects - 1) << "joined after look " << joined + 1;
  }
}

}  // namespace
}  // namespace gazed::cycle::recording_test
