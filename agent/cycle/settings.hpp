// What the cycle is told: how it looks for objects, moves the head, and locates.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "agent/gaze/plan.hpp"
#include "agent/geometry/camera_timing.hpp"
#include "agent/saliency/settings.hpp"
#include "agent/tracking/settings.hpp"
#include "agent/triangulation/gate.hpp"

namespace gazed::cycle {

/// Whose steps lead to the answer: all looks as one problem, or the report's six (Russcher 2011,
/// 4.4) with two looks, for comparison.
enum class LocateMethod : std::uint8_t { all_looks, report };
inline constexpr std::array<std::string_view, 2> locate_method_names{"all_looks", "report"};

/// How a target is located. The looks at it end when the point is known well enough, or when one
/// more would hardly tell more.
struct LocateSettings {
  LocateMethod method = LocateMethod::all_looks;
  int looks = 6;      // the most, with the first; triangulation::looks_min to looks_max
  int looks_min = 3;  // that see the target, unless `looks` is less: two do not show that it moves
  double relative_sigma_goal = 0.03;  // of the inverse range: good enough
  gaze::Plan plan = gaze::Plan::parallax;
  tracking::RegistrationSettings registration;
  triangulation::Gate gate;
};

/// How the head is moved, and when it has arrived.
struct HeadMotionSettings {
  /// Asked for beyond the step rule on both axes, so that what is measured of a move keeps the rule
  /// too. Robots' own: geometry::RobotProfile.
  double move_margin_rad = 0.0;
  /// Kept from every joint limit. Joints miss a command by up to 0.02 rad (Russcher 2011, chapter
  /// 5), and the V6's table of limits is reported as too wide (HULKs/hulk #203): 0.01 rad more.
  double margin_rad = 0.03;
  /// Of each joint's no-load speed. 0.3 is 2.5 rad/s in yaw, well below the loaded speed (6.1
  /// rad/s, Aldebaran documentation, "Motors"): joints still follow their command, and a step of
  /// 0.1 rad takes less than two frames.
  double speed_fraction = 0.3;
  /// Below it, for two samples, a joint is still. A servo that creeps into its goal takes another
  /// 0.1 s from 0.1 rad/s to here; from here on the accuracy does not depend on it
  /// (tests/benchmarks/accuracy), since the sweep of what is left is known.
  double settle_velocity_rad_s = 0.03;
  /// A driven head settles within this of the command, per axis; within three encoder sigmas more
  /// where it measures badly, but never where it would count as arrived before its least step.
  double settle_tolerance_rad = 0.05;
  double settle_timeout_s = 3.0;  // not settled by then is HEAD_FAULT
};

struct CycleSettings {
  saliency::SaliencySettings saliency;
  LocateSettings locate;
  HeadMotionSettings motion;
  geometry::CameraTiming camera;
  /// So long without a head state is HEAD_FAULT, as camera.timeout_s without a frame is
  /// CAMERA_FAULT. No key: heads send their state ten times a second or more, whatever the robot.
  double head_timeout_s = 2.0;
};

}  // namespace gazed::cycle
