// How one fixation ended: everything that is published of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "agent/cycle/settings.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/tracking/outline.hpp"
#include "agent/triangulation/all_looks/believed_robot.hpp"
#include "agent/triangulation/all_looks/error_budget.hpp"
#include "agent/triangulation/feature_observations.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::cycle {

/// How a fixation ended. The numbers are those of located_point_t.
enum class Status : std::int8_t {
  located = 0,
  no_salient_object = 1,
  target_lost = 2,
  degenerate = 3,
  behind_camera = 4,
  uncertain = 5,
  head_fault = 6,
  camera_fault = 7,
};
inline constexpr int status_count = 8;

/// "LOCATED", "NO_SALIENT_OBJECT", ...
[[nodiscard]] std::string_view name(Status status);

/// How a fixation ends that ended in a triangulation. What that calls invalid is, seen from
/// outside, a pixel without a ray: no target there.
[[nodiscard]] Status status_of(triangulation::Status status);

[[nodiscard]] inline geometry::Pixel no_pixel() {
  return geometry::Pixel::Constant(triangulation::not_a_number);
}
inline constexpr geometry::HeadAngles no_angles{triangulation::not_a_number,
                                                triangulation::not_a_number};

/// A corner of the background in one look.
struct LookCorner {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  bool used = false;  // believed, and of use for the angles
};

/// One look, and what became of it. What has no meaning is NaN: of a look that missed the target
/// nothing but what was measured is known.
struct FixationLook {
  std::int64_t utime_us = 0;                  // start of the view's exposure
  geometry::HeadAngles measured = no_angles;  // when the target's row was exposed
  geometry::HeadAngles refined = no_angles;   // all_looks::Estimate::reading
  geometry::Pose torso_1_from_torso;          // all_looks::Estimate
  geometry::Pixel pixel = no_pixel();         // with lens distortion, as seen
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Constant(triangulation::not_a_number);
  geometry::Pixel epipole = no_pixel();       // of camera 1's centre; none in look 1
  double chi2 = triangulation::not_a_number;  // all_looks::LookVerdict
  // What this look and look 1 say by themselves: all_looks::LookVerdict.
  double pair_inverse_range_per_m = triangulation::not_a_number;
  double pair_inverse_range_sigma_per_m = triangulation::not_a_number;
  bool used = false;   // the estimate is made of it
  std::string reason;  // why not
  std::array<LookCorner, triangulation::features_max> corners{};
  std::size_t corner_count = 0;
};

/// All looks at one target, or the attempt, and what they came to: located or not. A number without
/// a meaning is NaN.
struct Fixation {
  std::int64_t utime_us = 0;  // capture of the last view used
  std::int32_t number = 0;    // from 1
  bool counts = true;         // false for a fault that comes back while nothing is being looked at
  int views = 0;              // views used, looks_max at most
  Status status = Status::target_lost;
  std::string reason;                     // in words, with the numbers that decided
  triangulation::PointEstimate estimate;  // its numbers; its own status and reason go no further
  geometry::Pixel pixel_1 = no_pixel();
  geometry::Pixel pixel_2 = no_pixel();     // in the last view
  geometry::HeadAngles head_1 = no_angles;  // measured at capture
  geometry::HeadAngles head_2 = no_angles;  // of the last view
  float saliency = static_cast<float>(triangulation::not_a_number);
  float distinctness = static_cast<float>(triangulation::not_a_number);
  double duration_s = 0.0;  // from the first frame looked at to the last view's capture

  // How it came about.
  std::array<FixationLook, triangulation::looks_max> looks;  // as taken, those that missed too
  std::size_t look_count = 0;
  tracking::Outline outline;                                // of the target in look 1
  double patch_half_size_px = triangulation::not_a_number;  // Registration::half_size_px
  triangulation::all_looks::BelievedRobot robot;            // after the looks
  LocateMethod method = LocateMethod::all_looks;            // that was asked for
  /// What the report's own six steps say (triangulation/report_answer.hpp), whatever the method;
  /// torso frame.
  Eigen::Vector3d report_position_m = Eigen::Vector3d::Constant(triangulation::not_a_number);
  /// How far that is from camera 1; negative behind it.
  double report_range_m = triangulation::not_a_number;
  triangulation::all_looks::ErrorBudget budget;  // all_looks::Estimate
  std::size_t features_used = 0;                 // corners of the background, over all looks
  std::size_t features_rejected = 0;
};

}  // namespace gazed::cycle
