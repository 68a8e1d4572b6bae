// Sixteen calibrated views of a plaster temple (Seitz and others 2006): real pictures, matched by
// their features alone.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "agent/triangulation/estimate.hpp"

#include "projection.hpp"
#include "real_data.hpp"

namespace gazed::triangulation::temple_test {
namespace {

using Eigen::Vector3d;

struct TempleView {
  std::string file;
  Projection projection;
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

std::vector<TempleView> temple_views(const std::filesystem::path& folder) {
  std::ifstream stream = open_data(folder / "templeSR_par.txt");
  std::size_t count = 0;
  stream >> count;
  std::vector<TempleView> views(count);
  const auto sift = cv::SIFT::create();
  for (TempleView& view : views) {
    stream >> view.file;
    for (Eigen::Matrix3d* m : {&view.projection.k, &view.projection.cam_from_world.rotation}) {
      for (int i = 0; i < 9; ++i) stream >> (*m)(i / 3, i % 3);
    }
    for (double& t : view.projection.cam_from_world.translation) stream >> t;
    const cv::Mat image = cv::imread((folder / view.file).string(), cv::IMREAD_GRAYSCALE);
    sift->detectAndCompute(image, cv::noArray(), view.points, view.descriptors);
  }
  return views;
}

/// Best matches that are each other's best, and clearly better than the second (Lowe 2004).
std::vector<cv::DMatch> matches(const TempleView& first, const TempleView& second) {
  constexpr float most_of_second = 0.7F;
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> forth;
  std::vector<cv::DMatch> back, out;
  matcher.knnMatch(first.descriptors, second.descriptors, forth, 2);
  matcher.match(second.descriptors, first.descriptors, back);
  for (const auto& candidates : forth) {
    if (candidates.size() < 2) continue;
    const cv::DMatch& best = candidates[0];
    if (best.distance < most_of_second * candidates[1].distance &&
        back[static_cast<std::size_t>(best.trainIdx)].trainIdx == best.queryIdx) {
      out.push_back(best);
    }
  }
  return out;
}

TEST(Temple, LocatedPointsLieInThePublishedBox) {
  const auto folder = real_data("templeSparseRing");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  const std::vector<TempleView> views = temple_views(folder);
  ASSERT_EQ(views.size(), 16U);
  // README of the data, and 5 mm for the noise of the points.
  Eigen::AlignedBox3d box(Vector3d(-0.073568, 0.021728, -0.012445),
                          Vector3d(0.028855, 0.181892, 0.062736));
  box.min().array() -= 0.005;
  box.max().array() += 0.005;

  // Matches of two views are known to about a third of a pixel.
  constexpr double pixel_sigma_px = 0.3;
  std::array<int, methods::all_methods.size()> located{}, inside{};
  std::vector<double> residuals_px;
  std::size_t matched = 0;
  for (std::size_t i = 0; i + 1 < views.size(); ++i) {
    const TempleView &first = views[i], &second = views[i + 1];
    const auto point = [](const TempleView& view, int index) {
      const cv::Point2f& p = view.points[static_cast<std::size_t>(index)].pt;
      return image_point(view.projection.k, {static_cast<double>(p.x), static_cast<double>(p.y)},
                         pixel_sigma_px);
    };
    const auto pairs = matches(first, second);
    matched += pairs.size();
    for (const cv::DMatch& match : pairs) {
      const TwoViews two{.cam2_from_cam1 = relative_pose(first.projection.cam_from_world,
                                                         second.projection.cam_from_world),
                         .point_1 = point(first, match.queryIdx),
                         .point_2 = point(second, match.trainIdx),
                         .torso_from_cam1 = first.projection.cam_from_world.inverse()};
      for (std::size_t m = 0; m < methods::all_methods.size(); ++m) {
        const PointEstimate estimate = estimate_point(two, {}, {}, methods::all_methods[m]);
        if (estimate.status != Status::located) continue;
        ++located[m];
        inside[m] += box.contains(estimate.torso_point_m) ? 1 : 0;
        if (methods::all_methods[m] == methods::Method::optimal)
          residuals_px.push_back(estimate.residual_px);
      }
    }
  }
  ASSERT_GT(matched, 1000U);
  std::sort(residuals_px.begin(), residuals_px.end());
  RecordProperty("matched", static_cast<int>(matched));
  RecordProperty("median residual px", std::to_string(residuals_px[residuals_px.size() / 2]));
  EXPECT_LE(residuals_px[residuals_px.size() / 2], 0.3);
  for (std::size_t m = 0; m < methods::all_methods.size(); ++m) {
    SCOPED_TRACE(methods::name(methods::all_methods[m]));
    RecordProperty(std::string(methods::name(methods::all_methods[m])) + " located", located[m]);
    RecordProperty(std::string(methods::name(methods::all_methods[m])) + " inside", inside[m]);
    EXPECT_GE(located[m], 0.8 * static_cast<double>(matched));
    EXPECT_GE(inside[m], 0.985 * located[m]);
  }
}

}  // namespace
}  // namespace gazed::triangulation::temple_test
