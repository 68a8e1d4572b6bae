// The calibration files of other programs: ROS's camera_info and OpenCV's YAML, Kalibr's camchain,
// OpenCV's XML.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "agent/geometry/camera.hpp"

namespace gazed::lab::calibration {

/// The camera that a file describes, of a camchain the first; a file without an image size gives
/// that of `believed`. Throws std::invalid_argument that names the file, what was found and what is
/// allowed: other lens models than the pinhole with radial and tangential distortion are refused.
[[nodiscard]] geometry::CameraModel read_camera_file(const std::filesystem::path& path,
                                                     const geometry::CameraModel& believed);

/// What a camera file's ending says of its format; none for another ending.
enum class CameraFormat { ros_yaml, opencv_xml };
[[nodiscard]] std::optional<CameraFormat> camera_format_of(const std::filesystem::path& file);

/// `camera` in that format: .yaml as ROS's camera_info, .xml as OpenCV's.
[[nodiscard]] std::string camera_text(const geometry::CameraModel& camera, CameraFormat format);

}  // namespace gazed::lab::calibration
