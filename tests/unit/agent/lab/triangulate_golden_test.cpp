// gazelab triangulate on the golden correspondences, from file to file. They were made
// with 25 digits, so what differs is gazed's rounding.
#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gmock/gmock.h>
#include <map>
#include <string>
#include <vector>

#include "golden.hpp"
#include "scratch.hpp"
#include "triangulated.hpp"

namespace gazed::lab::triangulate_golden_test {
namespace {

using ::testing::SizeIs;

double number(const Json& text) {
  return text.is_string() ? std::stod(text.get<std::string>()) : text.get<double>();
}

std::string matrix_text(const Json& matrix) {
  std::string text = "[";
  for (const Json& row : matrix) {
    text += "[";
    for (const Json& element : row) text += element.get<std::string>() + ", ";
    text += "], ";
  }
  return text + "]";
}

constexpr double golden_sigma_px = 0.12;

/// The pair of a golden geometry, in metres.
std::string golden_pair(const Json& geometry) {
  const std::string k = "[[752, 0, 331], [0, 752, 253], [0, 0, 1]]\n";
  std::string text = "K1 = " + k + "K2 = " + k + "R = " + matrix_text(geometry["R"]) + "\nt = [";
  char buffer[40];
  for (const Json& element : geometry["t"]) {
    std::snprintf(buffer, sizeof buffer, "%.17g, ", number(element) / 1000.0);
    text += buffer;
  }
  std::snprintf(buffer, sizeof buffer, "]\npixel_sigma_px = %g\n", golden_sigma_px);
  return text + buffer + "relative_sigma_max = 10\n";
}

struct GoldenCase {
  std::string id;
  Eigen::Vector3d point_mm;
};

void expect_golden_points(const std::string& csv, const std::vector<GoldenCase>& cases,
                          double tolerance) {
  const auto points = points_of(csv);
  ASSERT_EQ(points.size(), cases.size());
  std::size_t with_position = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].id, cases[i].id);
    if (std::isnan(points[i].numbers[0])) continue;
    ++with_position;
    const Eigen::Vector3d point_m(points[i].numbers[0], points[i].numbers[1], points[i].numbers[2]);
    EXPECT_LT((1000.0 * point_m - cases[i].point_mm).norm(), tolerance * cases[i].point_mm.norm())
        << cases[i].id;
  }
  EXPECT_GT(with_position, points.size() / 2);
}

Eigen::Vector3d vector(const Json& elements) {
  return {number(elements[0]), number(elements[1]), number(elements[2])};
}

class GazelabTriangulateGolden : public ::testing::Test {
 protected:
  void rows(const std::string& text) { write_text(correspondences_, "id,x1,y1,x2,y2\n" + text); }

  Outcome run(const std::string& method) {
    return run_gazelab(
        {"triangulate", pair_.string(), correspondences_.string(), "--method", method});
  }

  ScratchFolder folder_;
  std::filesystem::path pair_ = folder_ / "pair.toml";
  std::filesystem::path correspondences_ = folder_ / "matches.csv";
};

TEST_F(GazelabTriangulateGolden, PointsOfEveryMethod) {
  const Json geometries = golden("report_geometry.json")["geometries"];
  const Json others = golden("rectification_linmmse.json")["geometries"];
  for (const auto& [name, geometry] : geometries.items()) {
    SCOPED_TRACE(name);
    write_text(pair_, golden_pair(geometry));
    std::string text;
    std::map<std::string, std::vector<GoldenCase>> cases;
    int count = 0;
    for (const Json& one : geometry["cases"]) {
      const std::string id = std::to_string(++count);
      const auto at = [&one](const char* view, int i) { return one[view][i].get<std::string>(); };
      text +=
          id + "," + at("x1", 0) + "," + at("x1", 1) + "," + at("x2", 0) + "," + at("x2", 1) + "\n";
      cases["optimal"].push_back({id, vector(one["X_hs"])});
      const auto index = static_cast<std::size_t>(count - 1);
      cases["rectification"].push_back({id, vector(others[name]["rect"][index]["X"])});
      cases["linear-mmse"].push_back({id, vector(others[name]["linmmse"][index]["iter2"])});
    }
    rows(text);
    for (const auto& [method, expected] : cases) {
      SCOPED_TRACE(method);
      constexpr double accuracy = 1e-9;  // relative to |X|: agent/README.md's rule
      const Outcome outcome = run(method);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      expect_golden_points(outcome.out, expected, accuracy);
    }
  }
}

TEST_F(GazelabTriangulateGolden, Sigmas) {
  const Json geometry = golden("report_geometry.json")["geometries"]["A_yp_m05_p05_t28_29_-24"];
  const Json one = geometry["cases"][1];
  write_text(pair_, golden_pair(geometry));
  const auto at = [&one](const char* view, int i) { return one[view][i].get<std::string>(); };
  rows("a," + at("x1", 0) + "," + at("x1", 1) + "," + at("x2", 0) + "," + at("x2", 1) + "\n");
  const auto points = points_of(run("optimal").out);
  ASSERT_THAT(points, SizeIs(1));
  for (std::size_t i = 0; i < 3; ++i) {
    const double sigma_m =
        golden_sigma_px / 1000.0 * std::sqrt(number(one["cov_unit_px_mm2"][i][i]));
    constexpr double accuracy = 1e-9;
    EXPECT_NEAR(points[0].numbers[3 + i], sigma_m, accuracy * sigma_m);
  }
}

}  // namespace
}  // namespace gazed::lab::triangulate_golden_test
