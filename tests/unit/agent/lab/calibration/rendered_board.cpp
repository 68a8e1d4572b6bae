#include "rendered_board.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace gazed::lab::calibration {

namespace {

constexpr int parts = 4;  // of a pixel's side

}  // namespace

BoardRenderer::BoardRenderer(const geometry::CameraModel& camera, const Chessboard& board,
                             PictureQuality quality)
    : camera_(camera), board_(board), quality_(quality) {
  for (int y = 0; y < parts * camera.height_px; ++y) {
    for (int x = 0; x < parts * camera.width_px; ++x) {
      const geometry::Pixel pixel((x + 0.5) / parts - 0.5, (y + 0.5) / parts - 0.5);
      rays_.emplace_back(geometry::normalise(camera, pixel)->cast<float>());
    }
  }
}

cv::Mat BoardRenderer::picture(const BoardPose& pose, std::uint64_t seed) const {
  const double angle_rad = pose.turn_rad.norm();
  const Eigen::AngleAxisd turn(angle_rad, angle_rad > 0.0 ? (pose.turn_rad / angle_rad).eval()
                                                          : Eigen::Vector3d::UnitX().eval());
  // From a ray to the board's plane, in squares from its top left corner.
  Eigen::Matrix3d plane;
  plane << turn.toRotationMatrix().leftCols<2>(), pose.middle_m;
  Eigen::Matrix3f squares_from_ray = plane.inverse().cast<float>();
  squares_from_ray.topRows<2>() /= static_cast<float>(board_.square_m);
  const float columns = static_cast<float>(board_.columns + 1);
  const float rows = static_cast<float>(board_.rows + 1);
  cv::Mat fine(parts * camera_.height_px, parts * camera_.width_px, CV_32FC1);
  std::size_t at = 0;
  for (int y = 0; y < fine.rows; ++y) {
    auto* const row = fine.ptr<float>(y);
    for (int x = 0; x < fine.cols; ++x) {
      const Eigen::Vector3f p = squares_from_ray * rays_[at++].homogeneous();
      const float u = p.x() / p.z() + 0.5F * columns, v = p.y() / p.z() + 0.5F * rows;
      const bool inside = u >= 0.0F && u < columns && v >= 0.0F && v < rows;
      const bool dark = inside && (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0;
      row[x] = dark ? 40.0F : 210.0F;
    }
  }
  cv::Mat picture, noise(camera_.height_px, camera_.width_px, CV_32FC1);
  cv::resize(fine, picture, noise.size(), 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(picture, picture, {0, 0}, quality_.blur_sigma_px);
  cv::RNG(seed + 1).fill(noise, cv::RNG::NORMAL, 0.0, quality_.noise);
  cv::Mat result;
  cv::Mat(picture + noise).convertTo(result, CV_8UC1);
  return result;
}

geometry::CameraModel rendered_camera() {
  geometry::CameraModel camera{.width_px = 640, .height_px = 480};
  camera.focal_px = {540.0, 540.0};
  camera.centre_px = {330.0, 235.0};
  camera.distortion = {-0.08, 0.04, 0.0, 0.0, 0.0};
  return camera;
}

std::vector<BoardPose> board_poses(int count, double tilt_rad, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  // From the raw numbers: the library's distributions differ.
  const auto between = [&random](double least, double greatest) {
    return least + (greatest - least) * std::ldexp(static_cast<double>(random() >> 11), -53);
  };
  std::vector<BoardPose> poses;
  for (int i = 0; i < count; ++i) {
    const double depth_m = between(0.4, 0.6);
    const double axis_rad = between(0.0, 2.0 * std::numbers::pi);
    const double tilt = between(0.0, tilt_rad);
    poses.push_back(
        {.middle_m = {between(-0.25, 0.25) * depth_m, between(-0.2, 0.2) * depth_m, depth_m},
         .turn_rad = {tilt * std::cos(axis_rad), tilt * std::sin(axis_rad), 0.0}});
  }
  return poses;
}

}  // namespace gazed::lab::calibration
