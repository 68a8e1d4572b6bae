#include "agent/lab/calibration/marks_csv.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "agent/base/text.hpp"
#include "agent/lab/io/csv.hpp"
#include "agent/lab/io/line_reader.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr std::string_view marks_header = "yaw_rad,pitch_rad,x_px,y_px,X_m,Y_m,Z_m";

struct Column {
  std::string_view name;
  double greatest;
  std::string_view allowed;
};
constexpr std::array<Column, 7> columns{{
    {"yaw_rad", std::numbers::pi, "an angle in radians between -pi and pi"},
    {"pitch_rad", std::numbers::pi, "an angle in radians between -pi and pi"},
    {"x_px", 1e5, "a number of pixels"},
    {"y_px", 1e5, "a number of pixels"},
    {"X_m", 100.0, "metres, -100 to 100"},
    {"Y_m", 100.0, "metres, -100 to 100"},
    {"Z_m", 100.0, "metres, -100 to 100"},
}};

MarkReading reading_of(const io::LineReader& lines) {
  const auto fields = io::split_csv_line(lines.line());
  if (!fields || fields->size() != columns.size()) {
    throw std::runtime_error(lines.place() + "'" + base::excerpt(lines.line()) +
                             "' found, expected " + std::to_string(columns.size()) +
                             " fields: " + std::string(marks_header));
  }
  std::array<double, columns.size()> values{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string_view field = io::trimmed((*fields)[i]);
    const io::ParsedNumber number = io::parsed_number(field);
    if (!number.value || !(std::abs(*number.value) <= columns[i].greatest)) {
      throw std::runtime_error(lines.place() + std::string(columns[i].name) + " is '" +
                               base::excerpt(field) + "', expected " +
                               std::string(columns[i].allowed));
    }
    values[i] = *number.value;
  }
  return {.measured = {values[0], values[1]},
          .pixel = {values[2], values[3]},
          .mark_m = {values[4], values[5], values[6]}};
}

}  // namespace

std::vector<MarkReading> read_marks_csv(const std::filesystem::path& file) {
  io::LineReader lines(file.string());
  std::vector<MarkReading> readings;
  bool header_seen = false;
  while (lines.next()) {
    const std::string_view line = io::trimmed(lines.line());
    if (line.empty()) continue;
    if (!header_seen) {
      if (line != marks_header) {
        throw std::runtime_error(lines.place() + "the header is '" + base::excerpt(line) +
                                 "', expected '" + std::string(marks_header) + "'");
      }
      header_seen = true;
      continue;
    }
    readings.push_back(reading_of(lines));
  }
  if (!header_seen) {
    throw std::runtime_error(lines.name() + ": is empty, expected the header " +
                             std::string(marks_header));
  }
  if (readings.empty()) throw std::runtime_error(lines.name() + ": no readings after the header");
  return readings;
}

}  // namespace gazed::lab::calibration
