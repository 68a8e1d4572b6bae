#include "simulated_looks.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>

#include "agent/geometry/robot.hpp"
#include "drivers/log/log_writer.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr std::int64_t start_us = 1'700'000'000'000'000;
constexpr std::int64_t look_us = 1'000'000;  // a turn, and a frame at 1 a second

geometry::RobotProfile v6() {
  return *geometry::robot_profile("nao-v6");
}

using OnFrame = std::function<void(const geometry::Frame&)>;
using OnState = std::function<void(const geometry::HeadState&)>;

/// Serves the robot's events in the order of their times.
void run_until(sim::SimRobot& robot, std::int64_t utime_us, const OnFrame& on_frame,
               const OnState& on_state) {
  while (true) {
    const std::int64_t frame_us = *robot.next_frame_utime_us();
    const std::int64_t state_us = *robot.next_state_utime_us();
    if (std::min(frame_us, state_us) > utime_us) return;
    if (state_us <= frame_us) {
      on_state(*robot.next_state());
    } else {
      on_frame(*robot.next_frame());
    }
  }
}

sim::SimRobot robot_in(const std::string& scene) {
  return {sim::parse_scene(scene, "scene"), v6(), 1, start_us};
}

void command(sim::SimRobot& robot, geometry::HeadAngles target) {
  robot.command({.utime_us = robot.now_us(), .target = target, .speed_fraction = 0.5});
}

}  // namespace

SimulatedLooks simulated_looks(const std::string& scene,
                               std::span<const geometry::HeadAngles> targets) {
  sim::SimRobot robot = robot_in(scene);
  SimulatedLooks looks;
  std::int64_t end_us = start_us;
  for (const geometry::HeadAngles& target : targets) {
    command(robot, target);
    end_us += look_us;
    HeadPicture picture;
    picture.name = "look " + std::to_string(looks.pictures.size());
    std::int64_t taken_us = 0;
    run_until(
        robot, end_us,
        [&](const geometry::Frame& frame) {
          picture.grey = grey_of(frame.image);
          taken_us = frame.utime_us;
        },
        [&](const geometry::HeadState& state) { picture.measured = state.measured; });
    looks.pictures.push_back(picture);
    looks.true_angles.push_back(*robot.true_angles(taken_us));
  }
  looks.truth = robot.truth();
  return looks;
}

void write_simulated_log(const std::string& scene, std::span<const geometry::HeadAngles> targets,
                         const std::filesystem::path& log) {
  sim::SimRobot robot = robot_in(scene);
  log::LogWriter writer(log.string(), lcm::Channels("GAZED"));
  std::int64_t end_us = start_us;
  for (const geometry::HeadAngles& target : targets) {
    command(robot, target);
    end_us += look_us;
    run_until(
        robot, end_us, [&](const geometry::Frame& frame) { writer.write(frame); },
        [&](const geometry::HeadState& state) { writer.write(state); });
  }
}

std::vector<geometry::HeadAngles> grid_of_looks(int yaws, double greatest_yaw_rad, int pitches,
                                                double greatest_pitch_rad,
                                                double middle_pitch_rad) {
  const auto spread = [](int i, int count, double greatest) {
    return greatest * (2.0 * i / (count - 1) - 1.0);
  };
  std::vector<geometry::HeadAngles> looks;
  for (int row = 0; row < pitches; ++row) {
    for (int i = 0; i < yaws; ++i) {
      const int column = row % 2 == 0 ? i : yaws - 1 - i;
      looks.push_back({spread(column, yaws, greatest_yaw_rad),
                       middle_pitch_rad + spread(row, pitches, greatest_pitch_rad)});
    }
  }
  return looks;
}

}  // namespace gazed::lab::calibration
