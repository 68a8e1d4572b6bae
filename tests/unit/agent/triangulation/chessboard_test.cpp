// OpenCV's own stereo pairs of a chessboard with squares of 25 mm: a metric answer that is known.
#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/triangulation/estimate.hpp"

#include "real_data.hpp"

namespace gazed::triangulation::chessboard_test {
namespace {

using Eigen::Vector3d;

const cv::Size board(9, 6);  // inner corners
constexpr double square_m = 0.025;

using Corners = std::vector<cv::Point2f>;

struct StereoViews {
  std::vector<Corners> left, right;
};

Corners corners_of(const std::filesystem::path& file) {
  const cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  Corners corners;
  if (image.empty() || !cv::findChessboardCorners(image, board, corners)) return {};
  cv::cornerSubPix(image, corners, {5, 5}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3});
  return corners;
}

StereoViews stereo_views(const std::filesystem::path& folder) {
  StereoViews views;
  for (int i = 1; i <= 14; ++i) {
    if (i == 10) continue;  // was never published
    Corners left = corners_of(folder / base::text("left%02d.jpg", i));
    Corners right = corners_of(folder / base::text("right%02d.jpg", i));
    if (left.empty() || right.empty()) continue;
    views.left.push_back(std::move(left));
    views.right.push_back(std::move(right));
  }
  return views;
}

std::vector<std::vector<cv::Point3f>> board_points(std::size_t views) {
  std::vector<cv::Point3f> points;
  for (int y = 0; y < board.height; ++y) {
    for (int x = 0; x < board.width; ++x) {
      points.emplace_back(static_cast<float>(x * square_m), static_cast<float>(y * square_m), 0.0F);
    }
  }
  return std::vector(views, points);
}

geometry::CameraModel camera_of(const cv::Mat& k, const cv::Mat& distortion) {
  geometry::CameraModel camera;
  camera.focal_px = {k.at<double>(0, 0), k.at<double>(1, 1)};
  camera.centre_px = {k.at<double>(0, 2), k.at<double>(1, 2)};
  for (int i = 0; i < 5; ++i) {
    camera.distortion[static_cast<std::size_t>(i)] = distortion.reshape(1, 1).at<double>(i);
  }
  return camera;
}

struct Stereo {
  geometry::CameraModel left, right;
  geometry::Pose right_from_left;
};

/// The left camera as it was published; the right one and the pose between them from the board.
Stereo calibrated(const std::filesystem::path& folder, const StereoViews& views) {
  cv::FileStorage published((folder / "left_intrinsics.yml").string(), cv::FileStorage::READ);
  cv::Mat k_left, d_left, k_right, d_right, rotation, translation, e, f;
  published["camera_matrix"] >> k_left;
  published["distortion_coefficients"] >> d_left;
  const cv::Size size(640, 480);
  const auto points = board_points(views.left.size());
  cv::calibrateCamera(points, views.right, size, k_right, d_right, cv::noArray(), cv::noArray(),
                      cv::CALIB_FIX_ASPECT_RATIO);
  cv::stereoCalibrate(points, views.left, views.right, k_left, d_left, k_right, d_right, size,
                      rotation, translation, e, f, cv::CALIB_FIX_INTRINSIC);
  Stereo out{camera_of(k_left, d_left), camera_of(k_right, d_right), {}};
  for (int i = 0; i < 3; ++i) {
    out.right_from_left.translation(i) = translation.at<double>(i);
    for (int j = 0; j < 3; ++j) out.right_from_left.rotation(i, j) = rotation.at<double>(i, j);
  }
  return out;
}

class Chessboard : public testing::TestWithParam<methods::Method> {};

INSTANTIATE_TEST_SUITE_P(Methods, Chessboard, testing::ValuesIn(methods::all_methods),
                         [](const auto& case_info) {
                           return case_info.param == methods::Method::linear_mmse
                                      ? "linear_mmse"
                                      : std::string(name(case_info.param));
                         });

TEST_P(Chessboard, NeighbouringCornersAreASquareApart) {
  const auto folder = real_data("opencv_calib");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  static const StereoViews views = stereo_views(folder);
  ASSERT_EQ(views.left.size(), 13U);
  static const Stereo stereo = calibrated(folder, views);
  EXPECT_NEAR(stereo.right_from_left.translation.norm(), 0.0836, 1e-3) << "README of the data";

  constexpr double pixel_sigma_px = 0.4;  // about what the calibration leaves over
  const Eigen::Matrix2d noise_px2 = pixel_sigma_px * pixel_sigma_px * Eigen::Matrix2d::Identity();
  double sum = 0.0, sum_2 = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < views.left.size(); ++i) {
    std::vector<Vector3d> points_m;
    for (std::size_t k = 0; k < views.left[i].size(); ++k) {
      const auto pixel = [](const cv::Point2f& p) {
        return geometry::Pixel(static_cast<double>(p.x), static_cast<double>(p.y));
      };
      const PointEstimate estimate = estimate_point(
          {.cam2_from_cam1 = stereo.right_from_left,
           .point_1 = *image_point(stereo.left, pixel(views.left[i][k]), noise_px2),
           .point_2 = *image_point(stereo.right, pixel(views.right[i][k]), noise_px2),
           .torso_from_cam1 = {}},
          {}, {}, GetParam());
      ASSERT_EQ(estimate.status, Status::located) << estimate.reason;
      points_m.push_back(estimate.point_m);
    }
    const auto add = [&](std::size_t a, std::size_t b) {
      const double distance_m = (points_m[a] - points_m[b]).norm();
      sum += distance_m;
      sum_2 += distance_m * distance_m;
      ++count;
    };
    const auto width = static_cast<std::size_t>(board.width);
    for (std::size_t k = 0; k < points_m.size(); ++k) {
      if (k % width + 1 < width) add(k, k + 1);
      if (k + width < points_m.size()) add(k, k + width);
    }
  }
  const double mean_m = sum / count;
  const double deviation_m = std::sqrt(sum_2 / count - mean_m * mean_m);
  RecordProperty("mean_mm", std::to_string(1e3 * mean_m));
  RecordProperty("deviation_mm", std::to_string(1e3 * deviation_m));
  EXPECT_NEAR(mean_m, square_m, 0.1e-3);
  EXPECT_LE(deviation_m, 0.5e-3);
}

}  // namespace
}  // namespace gazed::triangulation::chessboard_test
