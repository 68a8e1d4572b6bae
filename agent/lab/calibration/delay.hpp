// When a camera really exposes, from a recording of a moving head: the picture must turn as the
// joints say, at one time only.
//
// Delay: from a frame's time stamp to the start of exposure of its first row. Readout: from the
// first row's to the last one's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::lab::calibration {

struct DelayEstimate {
  double delay_s = 0.0, delay_sigma_s = 0.0;
  double readout_s = 0.0, readout_sigma_s = 0.0;
  std::size_t pairs = 0;   // of frames while the head moved
  std::size_t points = 0;  // of the scene, followed from one frame to the next
  double rms_px = 0.0;
};

/// From the frames of `log`, each compared with the one before: what stands still in the scene
/// moves in the image as the head's chain says, its rows each at their own time, its range unknown
/// but common to all. The standard deviations count the points of one pair as one witness. Throws
/// std::invalid_argument when the head moves too little in too few frames, std::runtime_error when
/// the log cannot be read.
[[nodiscard]] DelayEstimate estimate_delay(const std::filesystem::path& log,
                                           const std::string& channel_prefix,
                                           const geometry::CameraModel& camera,
                                           const geometry::HeadGeometry& head);

/// The camera.delay_s that the frames of a recording of gazed's have in their stamps; 0 for other
/// logs.
[[nodiscard]] double recorded_delay_s(const std::filesystem::path& log,
                                      const std::string& channel_prefix);

}  // namespace gazed::lab::calibration
