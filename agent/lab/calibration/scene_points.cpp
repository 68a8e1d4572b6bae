#include "agent/lab/calibration/scene_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/lab/io/progress.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr int corners_a_picture = 60;
constexpr double least_corner_quality = 0.01;  // of the picture's best
// Pairs farther apart share too little of the scene.
constexpr double greatest_turn_rad = 0.5;
constexpr std::size_t most_neighbours = 12;
constexpr int window_px = 21;
constexpr int pyramid_levels = 4;  // 10 px x 2^4 can be bridged
constexpr double there_and_back_px = 0.3;
constexpr int least_sightings = 3;

/// Differences of light taken out: less the mean, over the standard deviation of the surroundings.
cv::Mat evened(const cv::Mat& grey) {
  constexpr double surroundings_px = 16.0;  // sigma
  constexpr double noise_grey = 4.0;        // added: flat areas stay flat
  constexpr double gain = 50.0, middle = 128.0;
  cv::Mat picture, mean, square;
  grey.convertTo(picture, CV_32F);
  cv::GaussianBlur(picture, mean, {}, surroundings_px);
  picture -= mean;
  cv::GaussianBlur(picture.mul(picture), square, {}, surroundings_px);
  cv::sqrt(square, square);
  square += noise_grey;
  cv::divide(picture, square, picture);
  cv::Mat result;
  picture.convertTo(result, CV_8U, gain, middle);
  return result;
}

/// Where a far point at a pixel of picture `to` is seen in picture `from`: K R K^-1.
Eigen::Matrix3d turn_between(const HeadModel& model, geometry::HeadAngles from,
                             geometry::HeadAngles to) {
  const Eigen::Matrix3d k = geometry::calibration_matrix(model.camera);
  const Eigen::Matrix3d rotation = geometry::cam2_from_cam1(model.head, to, from).rotation;
  return k * rotation * k.inverse();
}

cv::Point2f moved(const Eigen::Matrix3d& homography, cv::Point2f p) {
  const Eigen::Vector3d at = homography * Eigen::Vector3d(p.x, p.y, 1.0);
  return {static_cast<float>(at.x() / at.z()), static_cast<float>(at.y() / at.z())};
}

std::vector<std::size_t> neighbours(std::span<const HeadPicture> pictures, std::size_t own) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const double turn = geometry::greatest_difference(pictures[i].measured, pictures[own].measured);
    if (i != own && turn <= greatest_turn_rad) near.emplace_back(turn, i);
  }
  std::ranges::sort(near);
  // Of many, near ones and far ones alike.
  const std::size_t count = std::min(near.size(), most_neighbours);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(near[i * near.size() / count].second);
  return result;
}

class Tracker {
 public:
  Tracker(std::span<const HeadPicture> pictures, const HeadModel& model)
      : pictures_(pictures), model_(model) {
    for (const HeadPicture& picture : pictures) evened_.push_back(evened(picture.grey));
  }

  /// Adds the corners of one picture with all their sightings.
  void follow_from(std::size_t own, ScenePoints& points) const {
    const std::vector<cv::Point2f> corners = corners_of(own);
    if (corners.empty()) return;
    std::vector<std::vector<PointSighting>> found(corners.size());
    for (const std::size_t other : neighbours(pictures_, own)) find(own, other, corners, found);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (found[i].size() + 1 < least_sightings) continue;
      found[i].push_back({static_cast<int>(own), 0, {corners[i].x, corners[i].y}});
      for (PointSighting& sighting : found[i]) {
        sighting.point = points.point_count;
        points.sightings.push_back(sighting);
      }
      ++points.point_count;
    }
  }

 private:
  [[nodiscard]] std::vector<cv::Point2f> corners_of(std::size_t own) const {
    std::vector<cv::Point2f> corners;
    const double apart_px = 0.06 * pictures_[own].grey.cols;
    const int border = window_px / 2;
    const cv::Rect inner(border, border, pictures_[own].grey.cols - 2 * border,
                         pictures_[own].grey.rows - 2 * border);
    cv::Mat mask = cv::Mat::zeros(pictures_[own].grey.size(), CV_8UC1);
    mask(inner).setTo(1);
    cv::goodFeaturesToTrack(evened_[own], corners, corners_a_picture, least_corner_quality,
                            apart_px, mask);
    return corners;
  }

  void find(std::size_t own, std::size_t other, const std::vector<cv::Point2f>& corners,
            std::vector<std::vector<PointSighting>>& found) const {
    const Eigen::Matrix3d own_from_other =
        turn_between(model_, pictures_[own].measured, pictures_[other].measured);
    const Eigen::Matrix3d other_from_own = own_from_other.inverse();
    cv::Mat homography, turned;
    cv::eigen2cv(own_from_other, homography);
    cv::warpPerspective(evened_[other], turned, homography, evened_[own].size(), cv::INTER_LINEAR,
                        cv::BORDER_CONSTANT, cv::Scalar(128));
    std::vector<cv::Point2f> there, back;
    std::vector<std::uint8_t> there_ok, back_ok;
    std::vector<float> error;
    const cv::Size window(window_px, window_px);
    cv::calcOpticalFlowPyrLK(evened_[own], turned, corners, there, there_ok, error, window,
                             pyramid_levels);
    cv::calcOpticalFlowPyrLK(turned, evened_[own], there, back, back_ok, error, window,
                             pyramid_levels);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (there_ok[i] == 0 || back_ok[i] == 0) continue;
      if (cv::norm(back[i] - corners[i]) > there_and_back_px) continue;
      const cv::Point2f pixel = moved(other_from_own, there[i]);
      if (!model_.camera.contains({pixel.x, pixel.y}, 0.5 * window_px)) continue;
      found[i].push_back({static_cast<int>(other), 0, {pixel.x, pixel.y}});
    }
  }

  std::span<const HeadPicture> pictures_;
  const HeadModel& model_;
  std::vector<cv::Mat> evened_;
};

}  // namespace

ScenePoints find_scene_points(std::span<const HeadPicture> pictures, const HeadModel& model) {
  const Tracker tracker(pictures, model);
  ScenePoints points;
  io::Progress progress(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    tracker.follow_from(i, points);
    progress.show(i + 1, base::text("%zu of %zu pictures matched", i + 1, pictures.size()));
  }
  return points;
}

}  // namespace gazed::lab::calibration
