#include "agent/triangulation/error_sources.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/geometry/chain.hpp"

namespace gazed::triangulation {

namespace {

/// How an error of the head changes torso_from_cam in one look: the camera's axes turn and its
/// centre moves; both in torso axes.
PoseChange joint_error(const Eigen::Vector3d& axis, const Eigen::Vector3d& neck_m,
                       const Eigen::Vector3d& centre_m, double sigma_rad) {
  return {sigma_rad * axis, sigma_rad * axis.cross(centre_m - neck_m)};
}

/// One look of the head: its pose, and how the kinematic chain can move it.
struct HeadLook {
  HeadLook(const geometry::HeadGeometry& head, geometry::HeadAngles measured)
      : torso_from_cam(geometry::cam_from_torso(head, measured).inverse()),
        neck_m(head.neck_offset_m),
        pitch_axis(geometry::about_z(measured.yaw_rad + head.zero.yaw_rad).col(1)) {}

  [[nodiscard]] PoseChange yaw_error(double sigma_rad) const {
    return joint_error(Eigen::Vector3d::UnitZ(), neck_m, torso_from_cam.translation, sigma_rad);
  }
  [[nodiscard]] PoseChange pitch_error(double sigma_rad) const {
    return joint_error(pitch_axis, neck_m, torso_from_cam.translation, sigma_rad);
  }

  geometry::Pose torso_from_cam;
  Eigen::Vector3d neck_m;
  Eigen::Vector3d pitch_axis;
};

/// A source that changes torso_from_cam of both looks.
ErrorSource head_source(const HeadLook& look_1, const HeadLook& look_2, const PoseChange& change_1,
                        const PoseChange& change_2) {
  const Eigen::Matrix3d cam2_axes_from_torso_axes = look_2.torso_from_cam.rotation.transpose();
  const Eigen::Vector3d between =
      look_1.torso_from_cam.translation - look_2.torso_from_cam.translation;
  ErrorSource source;
  source.cam2_from_cam1.rotation_rad =
      cam2_axes_from_torso_axes * (change_1.rotation_rad - change_2.rotation_rad);
  source.cam2_from_cam1.translation_m =
      cam2_axes_from_torso_axes *
      (change_1.translation_m - change_2.translation_m - change_2.rotation_rad.cross(between));
  source.torso_from_cam1 = change_1;
  return source;
}

/// How one pixel of focal length or centre moves an image point, normalised units.
struct CameraErrors {
  explicit CameraErrors(const ImagePoint& point)
      : by_centre(-point.pixel_jacobian.inverse()), by_focal(by_centre * point.distorted) {}

  Eigen::Matrix2d by_centre;
  Eigen::Vector2d by_focal;
};

/// One standard deviation of an image point along two independent directions, as columns.
Eigen::Matrix2d normalised_noise(const ImagePoint& point) {
  const Eigen::Matrix2d& c = point.covariance_px2;
  // Cholesky; the covariance may be singular, or zero.
  const double xx = std::sqrt(c(0, 0));
  const double xy = xx > 0.0 ? c(0, 1) / xx : 0.0;
  const double yy = std::sqrt(std::max(0.0, c(1, 1) - xy * xy));
  return point.pixel_jacobian.inverse() * Eigen::Matrix2d{{xx, 0.0}, {xy, yy}};
}

}  // namespace

void ErrorSources::add(const ErrorSource& source) {
  if (count_ == capacity)
    throw std::length_error(base::text("more than %zu error sources", capacity));
  sources_[count_++] = source;
}

void add_camera_errors(const TwoViews& views, double focal_sigma_px, double centre_sigma_px,
                       ErrorSources& sources) {
  const CameraErrors errors_1(views.point_1), errors_2(views.point_2);
  if (focal_sigma_px != 0.0) {
    sources.add({.normalised_1 = focal_sigma_px * errors_1.by_focal,
                 .normalised_2 = focal_sigma_px * errors_2.by_focal});
  }
  if (centre_sigma_px == 0.0) return;
  for (int axis = 0; axis < 2; ++axis) {
    sources.add({.normalised_1 = centre_sigma_px * errors_1.by_centre.col(axis),
                 .normalised_2 = centre_sigma_px * errors_2.by_centre.col(axis)});
  }
}

void add_lens_errors(const TwoViews& views, const geometry::CameraModel& camera,
                     const std::array<double, 2>& distortion_sigma, ErrorSources& sources) {
  const auto error = [&](const ImagePoint& point, int power) {
    const Eigen::Vector2d by_coefficient = std::pow(point.normalised.squaredNorm(), power) *
                                           camera.focal_px.cwiseProduct(point.normalised);
    return Eigen::Vector2d(-point.pixel_jacobian.inverse() * by_coefficient);
  };
  for (int i = 0; i < 2; ++i) {
    const double sigma = distortion_sigma[static_cast<std::size_t>(i)];
    if (sigma == 0.0) continue;
    sources.add({.normalised_1 = sigma * error(views.point_1, i + 1),
                 .normalised_2 = sigma * error(views.point_2, i + 1)});
  }
}

void add_separate_camera_errors(const TwoViews& views, double focal_sigma_px,
                                double centre_sigma_px, ErrorSources& sources) {
  const CameraErrors errors_1(views.point_1), errors_2(views.point_2);
  if (focal_sigma_px != 0.0) {
    sources.add({.normalised_1 = focal_sigma_px * errors_1.by_focal});
    sources.add({.normalised_2 = focal_sigma_px * errors_2.by_focal});
  }
  if (centre_sigma_px == 0.0) return;
  for (int axis = 0; axis < 2; ++axis) {
    sources.add({.normalised_1 = centre_sigma_px * errors_1.by_centre.col(axis)});
    sources.add({.normalised_2 = centre_sigma_px * errors_2.by_centre.col(axis)});
  }
}

void add_head_errors(const geometry::Rig& rig, geometry::HeadAngles measured_1,
                     geometry::HeadAngles measured_2, ErrorSources& sources) {
  const geometry::Uncertainty& uncertainty = rig.uncertainty;
  const HeadLook look_1(rig.head, measured_1), look_2(rig.head, measured_2);
  const auto add = [&](const PoseChange& change_1, const PoseChange& change_2) {
    sources.add(head_source(look_1, look_2, change_1, change_2));
  };
  if (const double sigma = uncertainty.encoder_sigma_rad; sigma != 0.0) {
    add(look_1.yaw_error(sigma), {});
    add(look_1.pitch_error(sigma), {});
    add({}, look_2.yaw_error(sigma));
    add({}, look_2.pitch_error(sigma));
  }
  if (const double sigma = uncertainty.zero_sigma_rad; sigma != 0.0) {
    add(look_1.yaw_error(sigma), look_2.yaw_error(sigma));
    add(look_1.pitch_error(sigma), look_2.pitch_error(sigma));
  }
  // The camera is fixed to the head and these sigmas hold for every axis, so the camera's own axes
  // serve as well as the head's.
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d axis_1 = look_1.torso_from_cam.rotation.col(axis);
    const Eigen::Vector3d axis_2 = look_2.torso_from_cam.rotation.col(axis);
    if (const double sigma = uncertainty.mount_offset_sigma_m; sigma != 0.0) {
      add({.translation_m = sigma * axis_1}, {.translation_m = sigma * axis_2});
    }
    if (const double sigma = uncertainty.mount_rotation_sigma_rad; sigma != 0.0) {
      add({.rotation_rad = sigma * axis_1}, {.rotation_rad = sigma * axis_2});
    }
  }
}

void add_relative_pose_errors(double rotation_sigma_rad, double translation_sigma_m,
                              ErrorSources& sources) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    ErrorSource source;
    if (rotation_sigma_rad != 0.0) {
      source.cam2_from_cam1 = {.rotation_rad = rotation_sigma_rad * unit};
      sources.add(source);
    }
    if (translation_sigma_m != 0.0) {
      source.cam2_from_cam1 = {.rotation_rad = Eigen::Vector3d::Zero(),
                               .translation_m = translation_sigma_m * unit};
      sources.add(source);
    }
  }
}

std::array<ErrorSource, image_sources> image_noise(const TwoViews& views) {
  const Eigen::Matrix2d noise_1 = normalised_noise(views.point_1);
  const Eigen::Matrix2d noise_2 = normalised_noise(views.point_2);
  return {ErrorSource{.normalised_1 = noise_1.col(0)}, ErrorSource{.normalised_1 = noise_1.col(1)},
          ErrorSource{.normalised_2 = noise_2.col(0)}, ErrorSource{.normalised_2 = noise_2.col(1)}};
}

double baseline_sigma_m(const geometry::Pose& cam2_from_cam1, const ErrorSources& sources) {
  const Eigen::Vector3d along = cam2_from_cam1.translation.normalized();
  double variance = 0.0;
  for (const ErrorSource& source : sources.all()) {
    const double change = along.dot(source.cam2_from_cam1.translation_m);
    variance += change * change;
  }
  return std::sqrt(variance);
}

}  // namespace gazed::triangulation
