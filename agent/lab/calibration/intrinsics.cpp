#include "agent/lab/calibration/intrinsics.hpp"

#include <Eigen/Core>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "agent/base/text.hpp"

namespace gazed::lab::calibration {

namespace {

double covered_share(const std::vector<std::vector<cv::Point2f>>& pictures, cv::Size image) {
  cv::Mat covered = cv::Mat::zeros(image, CV_8UC1);
  for (const auto& corners : pictures) {
    std::vector<cv::Point2f> hull;
    cv::convexHull(corners, hull);
    const std::vector<cv::Point> outline(hull.begin(), hull.end());
    cv::fillConvexPoly(covered, outline, cv::Scalar(1));
  }
  return static_cast<double>(cv::countNonZero(covered)) / image.area();
}

/// From OpenCV's order fx fy cx cy k1 k2 p1 p2 k3.
geometry::CameraModel camera_model(const cv::Mat& numbers, cv::Size image) {
  const auto at = [&](int i) { return numbers.at<double>(i); };
  geometry::CameraModel camera{.width_px = image.width, .height_px = image.height};
  camera.focal_px = {at(0), at(1)};
  camera.centre_px = {at(2), at(3)};
  camera.distortion = {at(4), at(5), at(6), at(7), at(8)};
  return camera;
}

}  // namespace

Intrinsics calibrated_intrinsics(const Chessboard& board,
                                 std::span<const std::vector<geometry::Pixel>> corners,
                                 cv::Size image) {
  if (corners.size() < fewest_boards) {
    throw std::invalid_argument(
        base::text("%zu pictures with the whole board found; allowed: from %zu", corners.size(),
                   fewest_boards));
  }
  std::vector<cv::Point3f> places;
  for (const Eigen::Vector3d& p : corner_places(board)) {
    places.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  }
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const std::vector<geometry::Pixel>& picture : corners) {
    auto& row = pixels.emplace_back();
    for (const geometry::Pixel& p : picture) {
      row.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    }
  }
  const std::vector<std::vector<cv::Point3f>> points(pixels.size(), places);
  cv::Mat k, distortion, turns, shifts, sigma, pose_sigma, picture_rms;
  Intrinsics result;
  try {
    result.rms_px = cv::calibrateCamera(points, pixels, image, k, distortion, turns, shifts, sigma,
                                        pose_sigma, picture_rms);
  } catch (const cv::Exception& error) {
    throw std::runtime_error("the boards' poses determine no camera: " + error.err);
  }
  cv::Mat numbers(9, 1, CV_64F);
  numbers.at<double>(0) = k.at<double>(0, 0);
  numbers.at<double>(1) = k.at<double>(1, 1);
  numbers.at<double>(2) = k.at<double>(0, 2);
  numbers.at<double>(3) = k.at<double>(1, 2);
  for (int i = 0; i < 5; ++i) numbers.at<double>(4 + i) = distortion.at<double>(i);
  result.camera = camera_model(numbers, image);
  result.sigma = camera_model(sigma, image);
  result.picture_rms_px.assign(picture_rms.begin<double>(), picture_rms.end<double>());
  result.covered = covered_share(pixels, image);
  if (!cv::checkRange(k) || !cv::checkRange(distortion)) {
    throw std::runtime_error(
        "the boards' poses determine no camera: hold the board at more angles");
  }
  return result;
}

}  // namespace gazed::lab::calibration
