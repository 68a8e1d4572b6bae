// What gazelab triangulate wrote, read back.
#pragma once

#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "agent/lab/io/csv.hpp"

namespace gazed::lab {

inline constexpr std::string_view output_header =
    "id,status,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,range_m,range_sigma_m,residual_px,"
    "parallax_rad";
inline constexpr std::size_t output_columns = 12;

struct Point {
  std::string id, status;
  std::vector<double> numbers;  // nan where there is none
};

inline std::vector<Point> points_of(const std::string& csv) {
  std::vector<Point> points;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, output_header);
  while (std::getline(lines, line)) {
    const auto fields = io::split_csv_line(line);
    EXPECT_TRUE(fields && fields->size() == output_columns) << line;
    if (!fields || fields->size() != output_columns) continue;
    Point point{.id = fields->at(0), .status = fields->at(1), .numbers = {}};
    for (std::size_t i = 2; i < output_columns; ++i) {
      const auto number = io::parsed<double>(fields->at(i));
      EXPECT_TRUE(number) << line;
      point.numbers.push_back(number.value_or(0.0));
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace gazed::lab
