#include "agent/lab/io/frames_csv.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "agent/lab/io/csv.hpp"
#include "agent/lab/io/line_reader.hpp"

namespace gazed::lab::io {

namespace {

constexpr std::string_view frames_header = "utime_us,file,yaw_rad,pitch_rad";
constexpr std::size_t field_count = 4;

/// The line under way, for its messages.
struct Place {
  const LineReader& lines;

  [[noreturn]] void fail(std::initializer_list<std::string_view> why) const {
    std::string message = lines.place();
    for (const std::string_view part : why) message += part;
    throw std::runtime_error(message);
  }
};

std::int64_t time_of(const Place& place, std::string_view text) {
  const auto utime_us = parsed<std::int64_t>(text);
  if (!utime_us || *utime_us < 0) {
    place.fail({"utime_us is '", text, "', expected a whole number of microseconds from 0"});
  }
  return *utime_us;
}

double angle_of(const Place& place, std::string_view name, std::string_view text) {
  const auto angle_rad = parsed<double>(text);
  if (!angle_rad || !std::isfinite(*angle_rad) || std::abs(*angle_rad) > std::numbers::pi) {
    place.fail({name, " is '", text, "', expected an angle in radians between -pi and pi"});
  }
  return *angle_rad;
}

RecordedFrame frame_of(const Place& place, std::string_view line) {
  const auto fields = split_csv_line(line);
  if (!fields) place.fail({"quotes do not match in '", line, "'"});
  if (fields->size() != field_count) {
    place.fail({std::to_string(fields->size()), " fields in '", line, "', expected ",
                std::to_string(field_count), ": ", frames_header});
  }
  const std::string_view file = trimmed((*fields)[1]);
  if (file.empty()) place.fail({"the file name is empty in '", line, "'"});
  return {.utime_us = time_of(place, trimmed((*fields)[0])),
          .file = file,
          .head = {angle_of(place, "yaw_rad", trimmed((*fields)[2])),
                   angle_of(place, "pitch_rad", trimmed((*fields)[3]))},
          .line = static_cast<int>(place.lines.number())};
}

void check_order(const Place& place, const RecordedFrame& before, const RecordedFrame& frame) {
  const std::int64_t interval_us = frame.utime_us - before.utime_us;  // both are at least 0
  if (interval_us >= least_frame_interval_us && interval_us <= greatest_frame_interval_us) return;
  place.fail({"utime_us is ", std::to_string(frame.utime_us), ", line ",
              std::to_string(before.line), " has ", std::to_string(before.utime_us),
              ": each time must lie ", std::to_string(least_frame_interval_us), " to ",
              std::to_string(greatest_frame_interval_us), " us after the one before"});
}

}  // namespace

std::vector<RecordedFrame> read_frames_csv(const std::filesystem::path& file) {
  LineReader lines(file);
  const Place place{lines};
  std::vector<RecordedFrame> frames;
  bool header_seen = false;
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    if (line.empty()) continue;
    if (!header_seen) {
      if (line != frames_header) {
        place.fail({"the header is '", line, "', expected '", frames_header, "'"});
      }
      header_seen = true;
      continue;
    }
    frames.push_back(frame_of(place, line));
    if (frames.size() > 1) check_order(place, frames[frames.size() - 2], frames.back());
  }
  const auto fail = [&lines](std::string_view why) {
    throw std::runtime_error((lines.name() + ": ").append(why));
  };
  if (!header_seen) fail("is empty, expected the header " + std::string(frames_header));
  if (frames.empty()) fail("no frames after the header");
  return frames;
}

}  // namespace gazed::lab::io
