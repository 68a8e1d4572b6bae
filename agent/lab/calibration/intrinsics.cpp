#include "agent/lab/calibration/intrinsics.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/board_fit.hpp"

namespace gazed::lab::calibration {

namespace {

using PixelsOfPictures = std::vector<std::vector<cv::Point2f>>;

constexpr const char* tilt_advice = "tilt the board by 20 to 40 degrees, each way, in 5 pictures";

double covered_share(const PixelsOfPictures& pictures, cv::Size image) {
  cv::Mat covered = cv::Mat::zeros(image, CV_8UC1);
  for (const auto& corners : pictures) {
    std::vector<cv::Point2f> hull;
    cv::convexHull(corners, hull);
    const std::vector<cv::Point> outline(hull.begin(), hull.end());
    cv::fillConvexPoly(covered, outline, cv::Scalar(1));
  }
  return static_cast<double>(cv::countNonZero(covered)) / image.area();
}

geometry::CameraModel camera_model(const CameraNumbers& numbers, cv::Size image) {
  geometry::CameraModel camera{.width_px = image.width, .height_px = image.height};
  camera.focal_px = numbers.head<2>();
  camera.centre_px = numbers.segment<2>(2);
  std::ranges::copy(numbers.tail<5>(), camera.distortion.begin());
  return camera;
}

PixelsOfPictures pixels_of(const std::vector<std::vector<geometry::Pixel>>& corners) {
  PixelsOfPictures pixels;
  for (const std::vector<geometry::Pixel>& picture : corners) {
    auto& row = pixels.emplace_back();
    for (const geometry::Pixel& p : picture) {
      row.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    }
  }
  return pixels;
}

void check_count(const Chessboard& board, std::size_t pictures) {
  if (pictures < fewest_boards) {
    throw std::invalid_argument(base::text(
        "%zu pictures with the whole board found; allowed: from %zu", pictures, fewest_boards));
  }
  const std::size_t corners = pictures * static_cast<std::size_t>(board.corner_count());
  const std::size_t unknowns = 9 + 6 * pictures;  // the camera's, a pose's
  if (corners > unknowns) return;
  throw std::invalid_argument(base::text(
      "%zu corners in all for %zu unknown numbers of the camera and the boards' poses; needed: "
      "more pictures or a larger board",
      corners, unknowns));
}

/// Root mean square of the corners' distances between two pictures.
double distance_px(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Point2f d = a[i] - b[i];
    sum += static_cast<double>(d.dot(d));
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// A view that is there twice tells nothing twice: the second one goes, by name.
void leave_out_repeated_views(PixelsOfPictures& pixels, BoardPictures& pictures) {
  constexpr double same_view_px = 0.2;  // no hand holds a board so still; a choice
  for (std::size_t i = 1; i < pixels.size();) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    const auto same = std::find_if(pixels.begin(), pixels.begin() + at, [&](const auto& earlier) {
      return distance_px(earlier, pixels[i]) < same_view_px;
    });
    if (same == pixels.begin() + at) {
      ++i;
      continue;
    }
    const auto& first = pictures.names[static_cast<std::size_t>(same - pixels.begin())];
    pictures.unused.push_back(
        base::text("%s: has the board where %s has it: they tell the same, and count once",
                   pictures.names[i].c_str(), first.c_str()));
    pixels.erase(pixels.begin() + at);
    pictures.names.erase(pictures.names.begin() + at);
  }
}

/// The picture that fits far worse than most; none when there is no such.
std::size_t worst_misfit(const std::vector<double>& rms_px) {
  std::vector<double> sorted = rms_px;
  std::ranges::sort(sorted);
  constexpr double far_worse = 3.0, negligible_px = 0.3;
  const double limit_px = std::max(negligible_px, far_worse * sorted[sorted.size() / 2]);
  const auto worst = std::ranges::max_element(rms_px);
  return *worst > limit_px ? static_cast<std::size_t>(worst - rms_px.begin()) : rms_px.size();
}

}  // namespace

Intrinsics calibrated_intrinsics(const Chessboard& board, BoardPictures pictures) {
  std::vector<cv::Point3f> places;
  for (const Eigen::Vector3d& p : corner_places(board)) {
    places.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  }
  PixelsOfPictures pixels = pixels_of(pictures.corners);
  check_count(board, pixels.size());
  leave_out_repeated_views(pixels, pictures);
  BoardFit fit = fit_boards(places, pixels, pictures.size);
  for (;;) {
    const std::size_t worst = worst_misfit(fit.picture_rms_px);
    if (worst == pixels.size() || pixels.size() <= fewest_boards) break;
    pictures.unused.push_back(base::text("%s: fits far worse than most, %.2f px rms",
                                         pictures.names[worst].c_str(), fit.picture_rms_px[worst]));
    const auto at = static_cast<std::ptrdiff_t>(worst);
    pixels.erase(pixels.begin() + at);
    pictures.names.erase(pictures.names.begin() + at);
    fit = fit_boards(places, pixels, pictures.size);
  }
  Intrinsics result{.camera = camera_model(fit.camera, pictures.size),
                    .sigma = camera_model(fit.sigma, pictures.size),
                    .rms_px = fit.rms_px,
                    .names = std::move(pictures.names),
                    .picture_rms_px = std::move(fit.picture_rms_px),
                    .unused = std::move(pictures.unused),
                    .corners_left_out = fit.corners_left_out,
                    .covered = covered_share(pixels, pictures.size)};
  constexpr double greatest_share = 0.2;  // gazed could only call everything UNCERTAIN
  const double sigma_px = result.sigma.focal_px.maxCoeff();
  const double focal_px = result.camera.focal_px.minCoeff();
  if (!(sigma_px <= greatest_share * focal_px)) {
    throw std::invalid_argument(
        base::text("the pictures do not determine the focal length: %.0f +- %.0f px. The boards "
                   "are parallel to the image, or nearly: %s",
                   focal_px, sigma_px, tilt_advice));
  }
  return result;
}

bool focal_length_is_vague(const Intrinsics& intrinsics) {
  constexpr double share = 0.01;  // a calibration as it should be is within 0.2 %
  return intrinsics.sigma.focal_px.maxCoeff() > share * intrinsics.camera.focal_px.minCoeff();
}

}  // namespace gazed::lab::calibration
