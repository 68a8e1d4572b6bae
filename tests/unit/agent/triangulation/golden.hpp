// The golden files: tests/data/golden, computed with 25 digits by two independent implementations
// (their own headers say how). Lengths in millimetres there, metres here.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// One correspondence of report_geometry.json and what the optimal method makes of it.
struct GoldenCase {
  std::string name;
  geometry::Pose cam2_from_cam1;
  geometry::Pixel pixel_1, pixel_2;
  geometry::Pixel corrected_1, corrected_2;
  double cost_px2 = 0.0;
  Eigen::Vector3d point_m;
  Eigen::Matrix3d covariance_m2;  // for 1 px of noise per coordinate
};

/// One correspondence of rectification_linmmse.json: what rectification and linear MMSE (prior and
/// noise as in MmseModel) make of one of report_geometry.json.
struct GoldenMethods {
  std::string name;
  geometry::Pose cam2_from_cam1;
  geometry::Pixel pixel_1, pixel_2;
  geometry::Pixel rectified_1, rectified_2;
  Eigen::Vector3d rectification_m;
  Eigen::Vector3d mmse_m;
  Eigen::Matrix3d mmse_covariance_m2;
};

/// One case of degenerate.json.
struct DegenerateCase {
  std::string name;
  geometry::Pose cam2_from_cam1;
  Eigen::Vector2d normalised_1, normalised_2;
  std::string expected_class;
};

/// The camera of report_geometry.json: the report's calibration.
[[nodiscard]] geometry::CameraModel golden_camera();
[[nodiscard]] std::vector<GoldenCase> golden_cases();
[[nodiscard]] std::vector<GoldenMethods> golden_methods();
[[nodiscard]] std::vector<DegenerateCase> degenerate_cases();
[[nodiscard]] DegenerateCase degenerate_case(const std::string& name);

/// `point` seen by a camera without distortion.
[[nodiscard]] ImagePoint undistorted_point(const Eigen::Vector2d& normalised, double focal_px,
                                           double pixel_sigma_px);

}  // namespace gazed::triangulation
