// The simulated head's two joints: they follow commands as motors do, and their sensors err.
//
// Angles are those that a perfect sensor would give; the head's zero offsets belong to its
// geometry.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "agent/geometry/limits.hpp"
#include "drivers/head.hpp"
#include "drivers/sim/random.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed {

/// A course along a straight segment of angles: both joints start and arrive together, with limited
/// speed and acceleration (a trapezoid of speed).
class JointCourse {
 public:
  JointCourse() = default;
  JointCourse(HeadAngles from, HeadAngles to, HeadAngles max_speed_rad_s,
              double acceleration_rad_s2);

  [[nodiscard]] HeadAngles at(double time_s) const;

 private:
  HeadAngles from_, way_;
  double acceleration_ = 1.0;  // of the share of the way, 1/s^2
  double ramp_s_ = 0.0;        // speeding up, and slowing down
  double cruise_s_ = 0.0;      // in between
};

class SimJoints {
 public:
  SimJoints(const JointBehaviour& behaviour, HeadAngles max_speed_rad_s, std::uint64_t seed,
            std::int64_t utime_us);

  /// Moves the joints on; never back.
  void advance_to(std::int64_t utime_us);
  /// Takes effect at the command's utime, or now if that is past. Ignored when not finite, without
  /// speed, or the same again; clamped to the joints' limits.
  void command(const HeadCommand& command);
  /// The head stops where it is.
  void hold();
  /// The head stands at `angles` and has stood there for ever.
  void reset(HeadAngles angles, std::int64_t utime_us);
  /// The head is moved by somebody else: at `angles` now, on a straight way since the last time. A
  /// time that goes back, or on by more than 256 ms, starts anew there.
  void follow(HeadAngles angles, std::int64_t utime_us);

  /// What the sensors say now.
  [[nodiscard]] HeadState measure();
  /// Where the camera is turned to; of the last 256 ms.
  [[nodiscard]] HeadAngles camera_angles(std::int64_t utime_us) const;
  [[nodiscard]] bool moved_since(std::int64_t utime_us) const;

 private:
  static constexpr std::int64_t step_us = 1000;
  static constexpr std::int64_t history_steps = 256;

  void start(const HeadCommand& command);
  void step();
  void remember(HeadAngles motor);
  void draw_look_error();
  [[nodiscard]] double encoded(double angle_rad);
  [[nodiscard]] HeadAngles& camera_at(std::int64_t step);
  [[nodiscard]] const HeadAngles& camera_at(std::int64_t step) const;

  JointBehaviour behaviour_;
  HeadAngles max_speed_rad_s_;
  HeadLimits limits_;
  double lag_share_;  // of the distance to the course, covered in one step
  RandomStream settling_, encoder_, look_, velocity_noise_;
  std::int64_t start_us_;
  std::int64_t steps_ = 0;      // done since start_us_
  std::int64_t last_move_ = 0;  // the step in which the camera last turned
  std::int64_t course_start_ = 0;
  JointCourse course_;
  std::optional<HeadCommand> pending_;
  std::optional<HeadAngles> goal_;  // of the last command
  HeadAngles motor_, motor_before_;
  HeadAngles look_error_;
  std::array<HeadAngles, history_steps> camera_{};
};

}  // namespace gazed
