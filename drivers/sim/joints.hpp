// The simulated head's two joints: they follow commands as motors do, and their sensors err.
//
// Angles are those that a perfect sensor would give; the head's zero offsets belong to its
// geometry.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "agent/base/random.hpp"
#include "agent/geometry/limits.hpp"
#include "drivers/head.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::sim {

/// A course along a straight segment of angles: both joints start and arrive together, with limited
/// speed and acceleration (a trapezoid of speed).
class JointCourse {
 public:
  JointCourse() = default;
  JointCourse(geometry::HeadAngles from, geometry::HeadAngles to,
              geometry::HeadAngles max_speed_rad_s, double acceleration_rad_s2);

  [[nodiscard]] geometry::HeadAngles at(double time_s) const;
  [[nodiscard]] double duration_s() const { return 2.0 * ramp_s_ + cruise_s_; }
  /// Of length 1, of both joints together; 0 where there is no way to go.
  [[nodiscard]] geometry::HeadAngles direction() const;

 private:
  geometry::HeadAngles from_, way_;
  double acceleration_ = 1.0;  // of the share of the way, 1/s^2
  double ramp_s_ = 0.0;        // speeding up, and slowing down
  double cruise_s_ = 0.0;      // in between
};

class SimJoints {
 public:
  /// Between two of these the angles change evenly.
  static constexpr std::int64_t step_us = 1000;

  SimJoints(const JointBehaviour& behaviour, geometry::HeadAngles max_speed_rad_s,
            std::uint64_t seed, std::int64_t utime_us);

  /// Moves the joints on; never back.
  void advance_to(std::int64_t utime_us);
  /// Takes effect at the command's utime, or now if that is past. Ignored when not finite, without
  /// speed, or the same again; clamped to the joints' limits.
  void command(const geometry::HeadCommand& command);
  /// The head stops where it is.
  void hold();
  /// The head stands at `angles` and has stood there for ever.
  void reset(geometry::HeadAngles angles, std::int64_t utime_us);
  /// The head is moved by somebody else: at `angles` now, on a straight way since the last time. A
  /// time that goes back, or on by more than 256 ms, starts anew there.
  void follow(geometry::HeadAngles angles, std::int64_t utime_us);

  /// What the sensors say now.
  [[nodiscard]] geometry::HeadState measure();
  /// Where the camera is turned to; of the last 256 ms.
  [[nodiscard]] geometry::HeadAngles camera_angles(std::int64_t utime_us) const;
  [[nodiscard]] bool moved_since(std::int64_t utime_us) const;

 private:
  static constexpr std::int64_t history_steps = 256;

  void start(const geometry::HeadCommand& command);
  void step();
  void remember(geometry::HeadAngles motor);
  void draw_look_error();
  [[nodiscard]] double encoded(double angle_rad);
  [[nodiscard]] geometry::HeadAngles& camera_at(std::int64_t step);
  [[nodiscard]] const geometry::HeadAngles& camera_at(std::int64_t step) const;

  JointBehaviour behaviour_;
  geometry::HeadAngles max_speed_rad_s_;
  geometry::HeadLimits limits_;
  double lag_share_;  // of the distance to the course, covered in one step
  base::Random settling_, encoder_, look_, velocity_noise_;
  std::int64_t start_us_;
  std::int64_t steps_ = 0;      // done since start_us_
  std::int64_t last_move_ = 0;  // the step in which the camera last turned
  std::int64_t course_start_ = 0;
  JointCourse course_;
  std::optional<geometry::HeadCommand> pending_;
  std::optional<geometry::HeadAngles> goal_;  // of the last command
  geometry::HeadAngles motor_, motor_before_;
  geometry::HeadAngles look_error_;
  std::array<geometry::HeadAngles, history_steps> camera_{};
};

}  // namespace gazed::sim
