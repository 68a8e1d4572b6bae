// The turntable sequence "Dinosaur" of Oxford's Visual Geometry Group: 36 calibrated views, real
// tracks. What the methods make of real noise, side by side.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/solution.hpp"

#include "projection.hpp"
#include "real_data.hpp"

namespace gazed::triangulation::dinosaur_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr std::size_t frames = 36;
constexpr double pixel_sigma_px = 0.3;

/// The 36 matrices of dino_Ps.mat, a MATLAB 5 file of a cell array, not compressed: each 3x4 matrix
/// is a data element of 96 bytes of type 9 (double), column by column.
std::vector<Projection> cameras(const std::filesystem::path& file) {
  static_assert(std::endian::native == std::endian::little, "as the file is");
  std::ifstream stream = open_data(file);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::array<unsigned char, 8> tag{9, 0, 0, 0, 96, 0, 0, 0};
  const std::string wanted(tag.begin(), tag.end());
  std::vector<Projection> out;
  for (auto at = bytes.find(wanted); at != std::string::npos; at = bytes.find(wanted, at + 1)) {
    Eigen::Matrix<double, 3, 4> p;
    if (at + tag.size() + sizeof(double) * 12 > bytes.size()) break;
    std::memcpy(p.data(), bytes.data() + at + tag.size(), sizeof(double) * 12);
    p.col(2) *= -1.0;  // their world is left-handed: its points would all lie behind the cameras
    out.push_back(decompose(p));
  }
  return out;
}

/// Where one scene point was seen, frame by frame; (row, column) in the file, -1 where it was not.
using Track = std::vector<std::pair<std::size_t, Vector2d>>;

std::vector<Track> tracks(const std::filesystem::path& file) {
  std::ifstream stream = open_data(file);
  std::vector<Track> out;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream numbers(line);
    Track track;
    double row = 0.0, column = 0.0;
    for (std::size_t frame = 0; numbers >> row >> column; ++frame) {
      if (row >= 0.0) track.emplace_back(frame, Vector2d(column, row));
    }
    out.push_back(std::move(track));
  }
  return out;
}

std::vector<TwoViews> neighbouring_views(const std::vector<Projection>& projections,
                                         const std::vector<Track>& all) {
  std::vector<TwoViews> out;
  for (const Track& track : all) {
    for (std::size_t i = 0; i + 1 < track.size(); ++i) {
      const auto& [frame_1, pixel_1] = track[i];
      const auto& [frame_2, pixel_2] = track[i + 1];
      if (frame_2 != frame_1 + 1) continue;
      const Projection &first = projections[frame_1], &second = projections[frame_2];
      out.push_back({.cam2_from_cam1 = relative_pose(first.cam_from_world, second.cam_from_world),
                     .point_1 = image_point(first.k, pixel_1, pixel_sigma_px),
                     .point_2 = image_point(second.k, pixel_2, pixel_sigma_px),
                     .torso_from_cam1 = first.cam_from_world.inverse()});
    }
  }
  return out;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Summed squared image errors on the plane z = 1, which is where optimal is optimal: these pixels
/// are not square.
double cost(const TwoViews& views, methods::Method method, const methods::Prior& prior) {
  const Solution solution = solve(method, views, prior).value();
  return (solution.point.direction - views.point_1.normalised).squaredNorm() +
         (solution.linearisation.view_2() - views.point_2.normalised).squaredNorm();
}

TEST(Dinosaur, EveryMethodOnRealCorrespondences) {
  const auto folder = real_data("vgg_dinosaur");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  const std::vector<Projection> projections = cameras(folder / "dino_Ps.mat");
  ASSERT_EQ(projections.size(), frames);
  const std::vector<Track> all = tracks(folder / "viff.xy");
  ASSERT_EQ(all.size(), 4983U);
  std::size_t image_points = 0;
  for (const Track& track : all) image_points += track.size();
  EXPECT_EQ(image_points, 16'432U);
  const std::vector<TwoViews> pairs = neighbouring_views(projections, all);
  ASSERT_GT(pairs.size(), 11'000U);

  // The object is as deep as the world's origin, give or take its own size; the unit is unknown.
  const double depth = projections.front().cam_from_world.translation.z();
  const methods::Prior prior{.mean_m = {0.0, 0.0, depth},
                             .sigma_m = {0.3 * depth, 0.3 * depth, 0.3 * depth}};
  std::array<std::vector<double>, methods::all_methods.size()> errors_px, off_optimal;
  int located = 0, lost = 0, other = 0;
  for (const TwoViews& views : pairs) {
    const PointEstimate optimal = estimate_point(views, {}, {});
    located += optimal.status == Status::located ? 1 : 0;
    lost += optimal.status == Status::target_lost ? 1 : 0;
    other += optimal.status != Status::located && optimal.status != Status::target_lost ? 1 : 0;
    if (optimal.status != Status::located) continue;
    const double least_cost = cost(views, methods::Method::optimal, prior);
    for (std::size_t m = 0; m < methods::all_methods.size(); ++m) {
      constexpr double rounding = 1e-9;
      const PointEstimate estimate = estimate_point(views, {}, {}, methods::all_methods[m], prior);
      ASSERT_EQ(estimate.status, Status::located)
          << methods::name(methods::all_methods[m]) << estimate.reason;
      // The residual is of both images together.
      errors_px[m].push_back(estimate.residual_px / std::sqrt(2.0));
      off_optimal[m].push_back((estimate.point_m - optimal.point_m).norm() / optimal.range_sigma_m);
      EXPECT_GE(cost(views, methods::all_methods[m], prior), least_cost * (1.0 - rounding) - 1e-20);
    }
  }
  constexpr double most_px = 0.25;
  for (std::size_t m = 0; m < methods::all_methods.size(); ++m) {
    RecordProperty(std::string(methods::name(methods::all_methods[m])) + " median px",
                   std::to_string(median(errors_px[m])));
    RecordProperty(
        std::string(methods::name(methods::all_methods[m])) + " median off optimal, sigmas",
        std::to_string(median(off_optimal[m])));
    EXPECT_LE(median(errors_px[m]), most_px) << methods::name(methods::all_methods[m]);
    // Where the geometry is good all methods agree far better than the noise lets them be right.
    EXPECT_LE(median(off_optimal[m]), 0.25) << methods::name(methods::all_methods[m]);
  }
  // A few per cent of the tracks are wrong (README of the data).
  EXPECT_GE(located, 0.85 * static_cast<double>(pairs.size()));
  EXPECT_LE(lost, 0.15 * static_cast<double>(pairs.size()));
  EXPECT_LE(other, 0.01 * static_cast<double>(pairs.size()));
  RecordProperty("located", located);
  RecordProperty("lost", lost);
}

}  // namespace
}  // namespace gazed::triangulation::dinosaur_test
