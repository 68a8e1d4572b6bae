// frames.csv: which picture was taken when, and where the head was.
//
//   utime_us,file,yaw_rad,pitch_rad
//   1700000000000000,first.jpg,0.0,0.0
//   1700000000500000,second.jpg,-0.12,0.1
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "agent/geometry/head.hpp"

namespace gazed::lab::io {

struct RecordedFrame {
  std::int64_t utime_us = 0;   // start of exposure, microseconds since the Unix epoch
  std::filesystem::path file;  // as written, relative to the folder of frames.csv
  geometry::HeadAngles head;
  int line = 0;  // of frames.csv, the header is line 1
};

/// Two frames closer than this are an error: no head turns in between.
constexpr std::int64_t least_frame_interval_us = 1'000;
/// So are two frames farther apart: most likely one time is in another unit.
constexpr std::int64_t greatest_frame_interval_us = 60'000'000;

/// The rows of `file`, at least one, times ascending. CRLF line ends, a byte order mark and empty
/// lines are accepted. Throws std::runtime_error "FILE:LINE: ..." with what was read and what is
/// expected: another header, a wrong number of fields, a time that is not a whole number from 0
/// or not least_frame_interval_us to greatest_frame_interval_us after the one before, an angle that
/// is not finite or beyond +-pi, an empty file name, no rows.
[[nodiscard]] std::vector<RecordedFrame> read_frames_csv(const std::filesystem::path& file);

}  // namespace gazed::lab::io
