// Measured marks instead of pictures: where the head was, where the mark was seen, where it is.
//
//   yaw_rad,pitch_rad,x_px,y_px,X_m,Y_m,Z_m
//   0.0,0.1,412.3,250.9,0.50,-0.12,0.20
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::lab::calibration {

struct MarkReading {
  geometry::HeadAngles measured;
  geometry::Pixel pixel = geometry::Pixel::Zero();
  Eigen::Vector3d mark_m = Eigen::Vector3d::Zero();  // in the marks' own frame
};

/// The rows of `file` ("-": standard input), at least one; empty lines are accepted. Throws
/// std::runtime_error "FILE:LINE: ..." with what was read and what is expected.
[[nodiscard]] std::vector<MarkReading> read_marks_csv(const std::filesystem::path& file);

}  // namespace gazed::lab::calibration
