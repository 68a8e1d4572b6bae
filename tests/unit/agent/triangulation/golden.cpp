#include "golden.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gazed::triangulation {

namespace {

using Json = nlohmann::json;

Json read(const std::string& file) {
  std::ifstream stream(std::string(GAZED_TEST_DATA) + "/golden/" + file);
  if (!stream) throw std::runtime_error("cannot open golden file " + file);
  return Json::parse(stream);
}

/// Numbers are written as such or, with all their digits, as strings; null is not a number.
double number(const Json& json) {
  if (json.is_null()) return not_a_number;
  return json.is_string() ? std::stod(json.get<std::string>()) : json.get<double>();
}

template <int rows>
Eigen::Matrix<double, rows, 1> vector(const Json& json) {
  Eigen::Matrix<double, rows, 1> out;
  for (int i = 0; i < rows; ++i) out(i) = number(json.at(static_cast<std::size_t>(i)));
  return out;
}

Eigen::Matrix3d matrix(const Json& json) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) out.row(i) = vector<3>(json.at(static_cast<std::size_t>(i)));
  return out;
}

constexpr double m_per_mm = 1e-3;

}  // namespace

geometry::CameraModel golden_camera() {
  geometry::CameraModel camera;
  camera.focal_px = {752.0, 752.0};
  camera.centre_px = {331.0, 253.0};
  return camera;
}

std::vector<GoldenCase> golden_cases() {
  std::vector<GoldenCase> cases;
  const Json file = read("report_geometry.json");
  for (const auto& [name, geometry] : file.at("geometries").items()) {
    const geometry::Pose pose{matrix(geometry.at("R")), m_per_mm * vector<3>(geometry.at("t"))};
    for (const Json& json : geometry.at("cases")) {
      cases.push_back(
          {.name = name + " " + json.at("point").dump() + " " + json.at("perturbation_px").dump(),
           .cam2_from_cam1 = pose,
           .pixel_1 = vector<2>(json.at("x1")),
           .pixel_2 = vector<2>(json.at("x2")),
           .corrected_1 = vector<2>(json.at("x1_opt")),
           .corrected_2 = vector<2>(json.at("x2_opt")),
           .cost_px2 = number(json.at("cost_px2")),
           .point_m = m_per_mm * vector<3>(json.at("X_hs")),
           .covariance_m2 = m_per_mm * m_per_mm * matrix(json.at("cov_unit_px_mm2"))});
    }
  }
  return cases;
}

std::vector<GoldenMethods> golden_methods() {
  std::vector<GoldenMethods> out;
  const Json inputs = read("report_geometry.json").at("geometries");
  const Json file = read("rectification_linmmse.json");
  for (const auto& [name, geometry] : file.at("geometries").items()) {
    const Json& input = inputs.at(name);
    const geometry::Pose pose{matrix(input.at("R")), m_per_mm * vector<3>(input.at("t"))};
    for (std::size_t i = 0; i < input.at("cases").size(); ++i) {
      const Json &seen = input.at("cases").at(i), &rectified = geometry.at("rect").at(i),
                 &mmse = geometry.at("linmmse").at(i);
      if (seen.at("point") != mmse.at("point") || seen.at("perturbation_px") != mmse.at("pert")) {
        throw std::runtime_error("the golden files are not of the same cases");
      }
      out.push_back({.name = name + " " + std::to_string(i),
                     .cam2_from_cam1 = pose,
                     .pixel_1 = vector<2>(seen.at("x1")),
                     .pixel_2 = vector<2>(seen.at("x2")),
                     .rectified_1 = vector<2>(rectified.at("ur1")),
                     .rectified_2 = vector<2>(rectified.at("ur2")),
                     .rectification_m = m_per_mm * vector<3>(rectified.at("X")),
                     .mmse_m = m_per_mm * vector<3>(mmse.at("iter2")),
                     .mmse_covariance_m2 = m_per_mm * m_per_mm * matrix(mmse.at("cov"))});
    }
  }
  return out;
}

DegenerateCase degenerate_case(const std::string& name) {
  for (DegenerateCase& c : degenerate_cases()) {
    if (c.name == name) return c;
  }
  throw std::runtime_error("no case " + name);
}

std::vector<DegenerateCase> degenerate_cases() {
  std::vector<DegenerateCase> cases;
  const Json file = read("degenerate.json");
  for (const Json& json : file.at("cases")) {
    const Eigen::Matrix3d rotation = matrix(json.at("R"));
    cases.push_back({.name = json.at("name"),
                     .cam2_from_cam1 = {rotation, -(rotation * vector<3>(json.at("c2_m")))},
                     .normalised_1 = vector<2>(json.at("u1_norm")),
                     .normalised_2 = vector<2>(json.at("u2_norm")),
                     .expected_class = json.at("expect")});
  }
  return cases;
}

ImagePoint undistorted_point(const Eigen::Vector2d& normalised, double focal_px,
                             double pixel_sigma_px) {
  return {.normalised = normalised,
          .distorted = normalised,
          .pixel_jacobian = focal_px * Eigen::Matrix2d::Identity(),
          .covariance_px2 = pixel_sigma_px * pixel_sigma_px * Eigen::Matrix2d::Identity()};
}

}  // namespace gazed::triangulation
