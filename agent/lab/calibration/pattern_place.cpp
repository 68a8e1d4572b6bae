#include "agent/lab/calibration/pattern_place.hpp"

#include <Eigen/Geometry>
#include <array>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "agent/lab/calibration/chain.hpp"

namespace gazed::lab::calibration {

namespace {

CameraPlace<double> place_of(const HeadModel& model, geometry::HeadAngles measured) {
  const std::array<double, 2> sensor{measured.yaw_rad, measured.pitch_rad};
  return camera_place(parameters_of(model).data(), sensor.data());
}

}  // namespace

std::optional<Eigen::Vector3d> direction_in_neck(const HeadModel& model,
                                                 geometry::HeadAngles measured,
                                                 const geometry::Pixel& pixel) {
  const auto ray = geometry::normalise(model.camera, pixel);
  if (!ray) return std::nullopt;
  return place_of(model, measured).neck_from_cam * ray->homogeneous().normalized();
}

std::optional<geometry::Pose> first_pattern_place(const HeadModel& model,
                                                  std::span<const geometry::HeadAngles> looks,
                                                  std::span<const PointSighting> sightings,
                                                  std::span<const Eigen::Vector3d> pattern_m) {
  std::vector<Eigen::Vector3d> directions;
  std::vector<cv::Point3d> points;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), centre_m = Eigen::Vector3d::Zero();
  for (const PointSighting& s : sightings) {
    const geometry::HeadAngles look = looks[static_cast<std::size_t>(s.look)];
    const auto direction = direction_in_neck(model, look, s.pixel);
    if (!direction) continue;
    const Eigen::Vector3d& point = pattern_m[static_cast<std::size_t>(s.point)];
    directions.push_back(*direction);
    points.emplace_back(point.x(), point.y(), point.z());
    middle += *direction;
    centre_m += place_of(model, look).centre_m;
  }
  if (directions.size() < 4 || middle.norm() == 0.0) return std::nullopt;
  centre_m /= static_cast<double>(directions.size());
  // A camera that looks along the middle of all directions.
  const Eigen::Matrix3d camera_from_neck =
      geometry::rotation_between(middle, Eigen::Vector3d::UnitZ());
  constexpr double least_cosine = 0.1;  // beyond it a direction has no place on the image plane
  std::vector<cv::Point2d> images;
  std::vector<cv::Point3d> seen;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d in_camera = camera_from_neck * directions[i];
    if (in_camera.z() < least_cosine) continue;
    images.emplace_back(in_camera.x() / in_camera.z(), in_camera.y() / in_camera.z());
    seen.push_back(points[i]);
  }
  if (seen.size() < 4) return std::nullopt;
  cv::Mat turn, shift, rotation;
  try {
    if (!cv::solvePnP(seen, images, cv::Mat::eye(3, 3, CV_64F), {}, turn, shift, false,
                      cv::SOLVEPNP_SQPNP)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {  // points on one line
    return std::nullopt;
  }
  cv::Rodrigues(turn, rotation);
  geometry::Pose camera_from_pattern;
  cv::cv2eigen(rotation, camera_from_pattern.rotation);
  cv::cv2eigen(shift, camera_from_pattern.translation);
  return geometry::Pose{camera_from_neck, -(camera_from_neck * centre_m)}.inverse() *
         camera_from_pattern;
}

}  // namespace gazed::lab::calibration
