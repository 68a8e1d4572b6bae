#include "agent/triangulation/uncertainty.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace gazed {

namespace {

/// What an error of the head changes of torso_from_cam, in one look: the camera's axes turn, its
/// centre moves; both in torso axes.
PoseChange joint_error(const Eigen::Vector3d& axis, const Eigen::Vector3d& neck_m,
                       const Eigen::Vector3d& centre_m, double sigma_rad) {
  return {sigma_rad * axis, sigma_rad * axis.cross(centre_m - neck_m)};
}

/// One look of the head: the pose and how the chain can move it.
struct Look {
  Look(const HeadGeometry& head, HeadAngles measured)
      : torso_from_cam(cam_from_torso(head, measured).inverse()),
        neck_m(head.neck_offset_m),
        pitch_axis(rotation_z(measured.yaw_rad + head.zero.yaw_rad).col(1)) {}

  [[nodiscard]] PoseChange yaw_error(double sigma_rad) const {
    return joint_error(Eigen::Vector3d::UnitZ(), neck_m, torso_from_cam.translation, sigma_rad);
  }
  [[nodiscard]] PoseChange pitch_error(double sigma_rad) const {
    return joint_error(pitch_axis, neck_m, torso_from_cam.translation, sigma_rad);
  }

  Pose torso_from_cam;
  Eigen::Vector3d neck_m;
  Eigen::Vector3d pitch_axis;
};

/// A source that changes torso_from_cam of both looks.
ErrorSource head_source(const Look& look_1, const Look& look_2, const PoseChange& change_1,
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

/// Where view 2 sees the point, linearised: x2 = project(R (direction, 1) + inverse_depth t).
class Linearisation {
 public:
  Linearisation(const TwoViews& views, const InverseDepthPoint& solution)
      : rotated_(views.cam2_from_cam1.rotation * solution.direction.homogeneous()),
        inverse_depth_(solution.inverse_depth_per_m) {
    const Eigen::Vector3d& t = views.cam2_from_cam1.translation;
    const Eigen::Vector3d point_2 = rotated_ + inverse_depth_ * t;
    view_2_ = point_2.hnormalized();
    projection_ << 1, 0, -view_2_.x(), 0, 1, -view_2_.y();
    projection_ /= point_2.z();
    by_direction_ = projection_ * views.cam2_from_cam1.rotation.leftCols<2>();
    by_inverse_depth_ = projection_ * t;
    // The direction across the surface is orthogonal to both kinds of derivative.
    const Eigen::Vector2d across_2(-by_inverse_depth_.y(), by_inverse_depth_.x());
    across_ << -by_direction_.transpose() * across_2, across_2;
    across_.normalize();
  }

  [[nodiscard]] const Eigen::Vector2d& view_2() const { return view_2_; }

  /// What a source looks like as an error of the two image points. A pose that is believed to be
  /// changed predicts view 2 elsewhere, as an image point that is wrong by the opposite would.
  [[nodiscard]] Eigen::Vector4d image_error(const ErrorSource& source) const {
    const PoseChange& pose = source.cam2_from_cam1;
    Eigen::Vector4d error;
    error << source.normalised_1,
        source.normalised_2 -
            projection_ * (pose.rotation_rad.cross(rotated_) + inverse_depth_ * pose.translation_m);
    return error;
  }

  [[nodiscard]] double across(const Eigen::Vector4d& image_error) const {
    return across_.dot(image_error);
  }

  /// How the solution (direction, inverse depth) follows an error of the image points.
  [[nodiscard]] Eigen::Vector3d solution_error(const Eigen::Vector4d& image_error) const {
    const Eigen::Vector4d along = image_error - across(image_error) * across_;
    const Eigen::Vector2d direction = along.head<2>();
    const double inverse_depth =
        by_inverse_depth_.dot(along.tail<2>() - by_direction_ * direction) /
        by_inverse_depth_.squaredNorm();
    return {direction.x(), direction.y(), inverse_depth};
  }

 private:
  Eigen::Vector3d rotated_;
  double inverse_depth_;
  Eigen::Vector2d view_2_;
  Eigen::Matrix<double, 2, 3> projection_;  // d view 2 / d point in camera 2
  Eigen::Matrix2d by_direction_;
  Eigen::Vector2d by_inverse_depth_;
  Eigen::Vector4d across_;
};

/// Sums what each source does.
class Sums {
 public:
  Sums(const TwoViews& views, const InverseDepthPoint& solution)
      : linear_(views, solution),
        solution_(solution),
        ray_(solution.direction.homogeneous()),
        ray_length_(ray_.norm()),
        torso_(views.torso_from_cam1) {
    if (torso_) torso_offset_m_ = torso_->rotation * (ray_ / solution.inverse_depth_per_m);
  }

  void add(const ErrorSource& source) {
    const Eigen::Vector4d image_error = linear_.image_error(source);
    const double across = linear_.across(image_error);
    residual_variance_ += across * across;
    const Eigen::Vector3d error = linear_.solution_error(image_error);
    const Eigen::Vector3d ray_error(error.x(), error.y(), 0.0);
    const double inverse_depth = solution_.inverse_depth_per_m;
    const double inverse_range_error =
        (error.z() - inverse_depth * ray_.dot(ray_error) / (ray_length_ * ray_length_)) /
        ray_length_;
    inverse_range_variance_ += inverse_range_error * inverse_range_error;
    if (!(inverse_depth > 0.0)) return;
    const Eigen::Vector3d point_error =
        (ray_error - ray_ * (error.z() / inverse_depth)) / inverse_depth;
    covariance_ += point_error * point_error.transpose();
    if (!torso_) return;
    const Eigen::Vector3d torso_error = torso_->rotation * point_error +
                                        source.torso_from_cam1.rotation_rad.cross(torso_offset_m_) +
                                        source.torso_from_cam1.translation_m;
    torso_covariance_ += torso_error * torso_error.transpose();
  }

  [[nodiscard]] Propagated result(const TwoViews& views) const {
    Propagated out;
    out.inverse_range_per_m = solution_.inverse_depth_per_m / ray_length_;
    out.inverse_range_sigma_per_m = std::sqrt(inverse_range_variance_);
    Eigen::Vector4d residual;
    residual << views.point_1.normalised - solution_.direction,
        views.point_2.normalised - linear_.view_2();
    out.residual = linear_.across(residual);
    out.residual_sigma = std::sqrt(residual_variance_);
    if (solution_.inverse_depth_per_m > 0.0) {
      out.covariance_m2 = covariance_;
      if (torso_) out.torso_covariance_m2 = torso_covariance_;
    }
    return out;
  }

 private:
  Linearisation linear_;
  InverseDepthPoint solution_;
  Eigen::Vector3d ray_;
  double ray_length_;
  std::optional<Pose> torso_;
  Eigen::Vector3d torso_offset_m_ = Eigen::Vector3d::Zero();  // from camera 1, torso axes
  double residual_variance_ = 0.0;
  double inverse_range_variance_ = 0.0;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d torso_covariance_ = Eigen::Matrix3d::Zero();
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
  if (count_ == capacity) throw std::length_error("more than 15 error sources");
  sources_[count_++] = source;
}

void add_camera_errors(const TwoViews& views, double focal_sigma_px, double centre_sigma_px,
                       ErrorSources& sources) {
  const Eigen::Matrix2d to_normalised_1 = views.point_1.pixel_jacobian.inverse();
  const Eigen::Matrix2d to_normalised_2 = views.point_2.pixel_jacobian.inverse();
  if (focal_sigma_px != 0.0) {
    sources.add({.normalised_1 = -focal_sigma_px * to_normalised_1 * views.point_1.distorted,
                 .normalised_2 = -focal_sigma_px * to_normalised_2 * views.point_2.distorted});
  }
  if (centre_sigma_px == 0.0) return;
  for (int axis = 0; axis < 2; ++axis) {
    sources.add({.normalised_1 = -centre_sigma_px * to_normalised_1.col(axis),
                 .normalised_2 = -centre_sigma_px * to_normalised_2.col(axis)});
  }
}

void add_head_errors(const HeadGeometry& head, HeadAngles measured_1, HeadAngles measured_2,
                     const Uncertainty& uncertainty, ErrorSources& sources) {
  const Look look_1(head, measured_1), look_2(head, measured_2);
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
  // The camera is fixed to the head, and these sigmas hold for every axis: its own axes serve as
  // well as the head's.
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

Propagated propagate(const TwoViews& views, const ErrorSources& sources,
                     const InverseDepthPoint& solution) {
  Sums sums(views, solution);
  const Eigen::Matrix2d noise_1 = normalised_noise(views.point_1);
  const Eigen::Matrix2d noise_2 = normalised_noise(views.point_2);
  for (int k = 0; k < 2; ++k) {
    sums.add({.normalised_1 = noise_1.col(k)});
    sums.add({.normalised_2 = noise_2.col(k)});
  }
  for (const ErrorSource& source : sources.all()) sums.add(source);
  return sums.result(views);
}

double baseline_sigma_m(const Pose& cam2_from_cam1, const ErrorSources& sources) {
  const Eigen::Vector3d along = cam2_from_cam1.translation.normalized();
  double variance = 0.0;
  for (const ErrorSource& source : sources.all()) {
    const double change = along.dot(source.cam2_from_cam1.translation_m);
    variance += change * change;
  }
  return std::sqrt(variance);
}

}  // namespace gazed
