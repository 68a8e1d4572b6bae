#include "tests/benchmarks/fixations.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "agent/lab/io/csv.hpp"

#include "tests/benchmarks/metrics.hpp"

namespace gazed::benchmarks {

namespace {

constexpr double picture_width_px = 800.0, picture_height_px = 600.0;

std::optional<double> number(const std::string& text) {
  std::size_t read = 0;
  try {
    const double value = std::stod(text, &read);
    if (read == text.size() && std::isfinite(value)) return value;
  } catch (const std::logic_error&) {  // not a number, or one too large
  }
  return std::nullopt;
}

std::optional<cv::Point> cell_of(const std::string& x_text, const std::string& y_text) {
  const auto x = number(x_text), y = number(y_text);
  if (!x || !y || *x < 0 || *y < 0 || *x >= picture_width_px || *y >= picture_height_px)
    return std::nullopt;
  return cv::Point(static_cast<int>(*x * scored_size.width / picture_width_px),
                   static_cast<int>(*y * scored_size.height / picture_height_px));
}

}  // namespace

Fixations read_fixations(std::istream& csv) {
  Fixations fixations;
  std::string line;
  int line_number = 1;
  const auto refuse = [&] {
    throw std::runtime_error("line " + std::to_string(line_number) + ": '" + line + "' found");
  };
  if (!std::getline(csv, line) || line != "image,subject,order,x_px,y_px,duration_ms") refuse();
  while (std::getline(csv, line)) {
    ++line_number;
    const auto fields = lab::io::split_csv_line(line);
    if (!fields || fields->size() != 6) refuse();
    const auto order = number((*fields)[2]);
    const auto cell = cell_of((*fields)[3], (*fields)[4]);
    if (!order || !cell) refuse();
    if (*order > 1.0) fixations[(*fields)[0]].push_back(*cell);
  }
  return fixations;
}

std::vector<cv::Point> fixations_elsewhere(const Fixations& fixations, const std::string& picture) {
  std::vector<cv::Point> elsewhere;
  for (const auto& [other, cells] : fixations)
    if (other != picture) elsewhere.insert(elsewhere.end(), cells.begin(), cells.end());
  return elsewhere;
}

}  // namespace gazed::benchmarks
