// Pictures taken at known head angles: from a folder with frames.csv, or from an LCM log.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::lab::calibration {

struct HeadPicture {
  std::string name;  // what messages call it
  cv::Mat grey;      // 8UC1
  geometry::HeadAngles measured;
};

/// Of a log more rests than this are thinned out evenly: more pictures tell little more.
constexpr std::size_t most_pictures = 80;

/// True for a folder with frames.csv or without pictures, a *.csv, a *.lcm, and whatever begins as
/// an LCM log does.
[[nodiscard]] bool has_head_angles(const std::filesystem::path& source);

/// The luma of an image, 8UC1.
[[nodiscard]] cv::Mat grey_of(const base::ImageView& image);

/// The pictures of FOLDER/frames.csv (`source` names either), or one picture for each place that
/// the head rests at in an LCM log. All must be of the camera's size; those of a
/// log are read out in `readout_s`, first row to last. Throws std::runtime_error that names the
/// file and what is wrong.
[[nodiscard]] std::vector<HeadPicture> read_head_pictures(const std::filesystem::path& source,
                                                          const geometry::CameraModel& camera,
                                                          double readout_s,
                                                          const std::string& channel_prefix);

}  // namespace gazed::lab::calibration
