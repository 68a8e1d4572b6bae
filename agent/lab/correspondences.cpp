#include "agent/lab/correspondences.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/io/csv.hpp"

namespace gazed::lab {

namespace {

constexpr std::array<std::string_view, 5> columns = {"id", "x1", "y1", "x2", "y2"};
constexpr std::string_view correspondences_header = "id,x1,y1,x2,y2";

bool is_header(const std::string& line) {
  const auto fields = io::split_csv_line(line);
  return fields && std::ranges::equal(*fields, columns, {},
                                      [](const std::string& field) { return io::trimmed(field); });
}

double coordinate(const io::LineReader& lines, const std::vector<std::string>& fields,
                  std::size_t column) {
  const std::string_view field = io::trimmed(fields[column]);
  const io::ParsedNumber number = io::parsed_number(field);
  if (number.value) return *number.value;
  throw std::runtime_error(lines.place() + std::string(columns[column]) + " is '" +
                           base::excerpt(field) +
                           (number.out_of_range ? "', beyond what a double can hold"
                                                : "', expected a number of pixels, or nan, inf"));
}

}  // namespace

CorrespondenceReader::CorrespondenceReader(const std::string& file) : lines_(file) {
  if (!next_line()) {
    throw std::runtime_error(lines_.name() + ": is empty, expected the header " +
                             std::string(correspondences_header));
  }
  if (!is_header(lines_.line())) {
    throw std::runtime_error(lines_.place() + "the header is '" + base::excerpt(lines_.line()) +
                             "', expected '" + std::string(correspondences_header) + "'");
  }
}

std::optional<Correspondence> CorrespondenceReader::next() {
  if (!next_line()) return std::nullopt;
  auto fields = io::split_csv_line(lines_.line());
  if (!fields) {
    throw std::runtime_error(lines_.place() + "quotes do not match in '" +
                             base::excerpt(lines_.line()) + "'");
  }
  if (fields->size() != columns.size()) {
    throw std::runtime_error(lines_.place() + std::to_string(fields->size()) + " fields in '" +
                             base::excerpt(lines_.line()) +
                             "', expected 5: " + std::string(correspondences_header));
  }
  const auto number = [&](std::size_t column) { return coordinate(lines_, *fields, column); };
  // In braces the order is that of the columns: of two bad fields the first is named.
  const std::array<double, 4> values{number(1), number(2), number(3), number(4)};
  return Correspondence{.id = std::move(fields->front()),
                        .pixel_1 = {values[0], values[1]},
                        .pixel_2 = {values[2], values[3]}};
}

bool CorrespondenceReader::next_line() {
  while (lines_.next()) {
    if (!io::trimmed(lines_.line()).empty()) return true;
  }
  return false;
}

}  // namespace gazed::lab
