// The report's two tests as gazed prints them with --print json, and their truth.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace gazed::integration {

/// One object a line.
inline std::vector<nlohmann::json> points_in(const std::string& lines_of_json) {
  std::vector<nlohmann::json> points;
  std::istringstream lines(lines_of_json);
  for (std::string line; std::getline(lines, line);) points.push_back(nlohmann::json::parse(line));
  return points;
}

/// Along the ray through pixel_1: the profile of nao-v6, the wall 0.30 m from camera 1 along its
/// optical axis, as the simulator's scenes have them.
inline double true_inverse_range_per_m(const nlohmann::json& point) {
  const double x = (point["pixel_1"][0].get<double>() - 319.5) / 608.0;
  const double y = (point["pixel_1"][1].get<double>() - 239.5) / 608.0;
  return 1.0 / (0.30 * std::sqrt(1.0 + x * x + y * y));
}

/// How far off the inverse range is, in its own sigmas.
inline double sigmas_off(const nlohmann::json& point) {
  return std::abs(point["inverse_range_per_m"].get<double>() - true_inverse_range_per_m(point)) /
         point["inverse_range_sigma_per_m"].get<double>();
}

}  // namespace gazed::integration
