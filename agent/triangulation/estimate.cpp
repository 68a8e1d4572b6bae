#include "agent/triangulation/estimate.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "agent/text.hpp"
#include "agent/triangulation/optimal.hpp"

namespace gazed {

namespace {

/// A baseline shorter than this is rounding of the same pose twice.
constexpr double baseline_min_m = 1e-9;
/// An epipolar residual (normalised units) below this is rounding, also when every sigma is 0.
constexpr double residual_rounding = 1e-9;

PointEstimate refused(Status status, std::string reason) {
  PointEstimate out;
  out.status = status;
  out.reason = std::move(reason);
  return out;
}

bool is_covariance(const Eigen::Matrix2d& m) {
  constexpr double rounding = 1e-9;
  const double product = m(0, 0) * m(1, 1);
  return m.allFinite() && m(0, 0) >= 0.0 && m(1, 1) >= 0.0 &&
         std::abs(m(0, 1) - m(1, 0)) <= rounding * std::sqrt(product) &&
         m(0, 1) * m(0, 1) <= product * (1.0 + rounding);
}

std::optional<std::string> what_is_invalid(const ImagePoint& point, const char* view) {
  if (!point.normalised.allFinite() || !point.distorted.allFinite()) {
    return text("image point %s (%g, %g) is not finite", view, point.normalised.x(),
                point.normalised.y());
  }
  if (!point.pixel_jacobian.allFinite() || point.pixel_jacobian.determinant() == 0.0) {
    return text("the camera model cannot be inverted at image point %s", view);
  }
  if (!is_covariance(point.covariance_px2)) {
    return text("the pixel covariance of view %s is none: [%g %g; %g %g] px^2", view,
                point.covariance_px2(0, 0), point.covariance_px2(0, 1), point.covariance_px2(1, 0),
                point.covariance_px2(1, 1));
  }
  return std::nullopt;
}

bool all_finite(const Pose& pose) {
  return pose.rotation.allFinite() && pose.translation.allFinite();
}

bool all_finite(const PoseChange& change) {
  return change.rotation_rad.allFinite() && change.translation_m.allFinite();
}

std::optional<std::string> what_is_invalid(const TwoViews& views, const ErrorSources& errors,
                                           const Gate& gate) {
  if (auto reason = what_is_invalid(views.point_1, "1")) return reason;
  if (auto reason = what_is_invalid(views.point_2, "2")) return reason;
  if (!all_finite(views.cam2_from_cam1) ||
      (views.torso_from_cam1 && !all_finite(*views.torso_from_cam1))) {
    return "a camera pose is not finite";
  }
  for (const ErrorSource& source : errors.all()) {
    if (!source.normalised_1.allFinite() || !source.normalised_2.allFinite() ||
        !all_finite(source.cam2_from_cam1) || !all_finite(source.torso_from_cam1)) {
      return "the size of an error source is not finite";
    }
  }
  if (std::isnan(gate.relative_sigma_max) || std::isnan(gate.epipolar_chi2_max) ||
      std::isnan(gate.baseline_sigmas)) {
    return "a limit of the gate is not a number";
  }
  return std::nullopt;
}

/// How far the ray stands off the baseline, in multiples of its own image noise.
double sigmas_off_baseline(const ImagePoint& point, const Eigen::Vector3d& baseline_direction) {
  const double distance = point.normalised.homogeneous().cross(baseline_direction).norm();
  const Eigen::Matrix2d to_normalised = point.pixel_jacobian.inverse();
  const double variance =  // per axis
      0.5 * (to_normalised * point.covariance_px2 * to_normalised.transpose()).trace();
  return distance / std::sqrt(variance);
}

/// Checks of the geometry alone, before anything is triangulated.
std::optional<std::string> what_is_degenerate(const TwoViews& views, const ErrorSources& errors,
                                              const Gate& gate) {
  const Pose& pose = views.cam2_from_cam1;
  const double baseline_m = pose.translation.norm();
  if (!(baseline_m > baseline_min_m)) return "the camera did not move: no baseline";
  const double sigma_m = baseline_sigma_m(pose, errors);
  if (baseline_m <= gate.baseline_sigmas * sigma_m) {
    return text("baseline %.2f mm is within %.1f sigmas of none (sigma %.2f mm)", 1e3 * baseline_m,
                gate.baseline_sigmas, 1e3 * sigma_m);
  }
  const Eigen::Vector3d direction = pose.translation / baseline_m;
  const double off_1 = sigmas_off_baseline(views.point_1, pose.rotation.transpose() * direction);
  const double off_2 = sigmas_off_baseline(views.point_2, direction);
  if (off_1 <= gate.baseline_sigmas && off_2 <= gate.baseline_sigmas) {
    return text("both rays lie along the baseline: %.1f and %.1f sigmas off it", off_1, off_2);
  }
  return std::nullopt;
}

double parallax(const TwoViews& views, const CorrectedPair& pair) {
  const Eigen::Vector3d ray_1 = views.cam2_from_cam1.rotation * pair.point_1.homogeneous();
  const Eigen::Vector3d ray_2 = pair.point_2.homogeneous();
  return std::atan2(ray_1.cross(ray_2).norm(), ray_1.dot(ray_2));
}

double residual_px(const TwoViews& views, const CorrectedPair& pair) {
  return std::hypot(
      (views.point_1.pixel_jacobian * (pair.point_1 - views.point_1.normalised)).norm(),
      (views.point_2.pixel_jacobian * (pair.point_2 - views.point_2.normalised)).norm());
}

/// Cheirality: why the point is not in front of both cameras beyond doubt. An inverse depth that is
/// negative by chance is judged by what a point at infinity on the same ray would show.
std::optional<std::string> what_is_behind(const TwoViews& views, const ErrorSources& errors,
                                          const InverseDepthPoint& point,
                                          double inverse_range_per_m) {
  const double depth_2 = (views.cam2_from_cam1.rotation * point.direction.homogeneous() +
                          point.inverse_depth_per_m * views.cam2_from_cam1.translation)
                             .z();  // of (direction, 1) / inverse depth, times inverse depth
  if (depth_2 <= 0.0) {
    return text("the rays meet behind camera %s only: inverse range %.3f 1/m from camera 1",
                point.inverse_depth_per_m > 0.0 ? "2" : "1", inverse_range_per_m);
  }
  if (point.inverse_depth_per_m >= 0.0) return std::nullopt;
  const double sigma = propagate(views, errors, {point.direction, 0.0}).inverse_range_sigma_per_m;
  if (inverse_range_per_m >= -sigma) return std::nullopt;
  return text("the rays meet %.3f m behind camera 1: inverse range %.3f 1/m, %.1f sigmas below 0",
              -1.0 / inverse_range_per_m, inverse_range_per_m, -inverse_range_per_m / sigma);
}

/// The position and all that follows from it.
void fill_position(const TwoViews& views, const InverseDepthPoint& point,
                   const Propagated& propagated, PointEstimate& out) {
  out.point_m = point.direction.homogeneous() / point.inverse_depth_per_m;
  out.covariance_m2 = propagated.covariance_m2;
  if (views.torso_from_cam1) {
    out.torso_point_m = *views.torso_from_cam1 * out.point_m;
    out.torso_covariance_m2 = propagated.torso_covariance_m2;
  }
  out.range_m = 1.0 / out.inverse_range_per_m;
  out.range_sigma_m = out.range_m * out.range_m * out.inverse_range_sigma_per_m;
}

/// The gate on the inverse range, for a point in front of both cameras.
void judge_sigma(const TwoViews& views, const InverseDepthPoint& point,
                 const Propagated& propagated, const Gate& gate, PointEstimate& out) {
  const double sigma = out.inverse_range_sigma_per_m;
  if (out.inverse_range_per_m <= sigma) {
    out.status = Status::uncertain;
    out.reason =
        text("inverse range %.3f +- %.3f 1/m: may be at infinity", out.inverse_range_per_m, sigma);
    return;
  }
  fill_position(views, point, propagated, out);
  const double relative_sigma = sigma / out.inverse_range_per_m;
  const bool passed = relative_sigma <= gate.relative_sigma_max;
  out.status = passed ? Status::located : Status::uncertain;
  out.reason = text("relative sigma %.1f %% is %s the gate of %.3g %%", 100.0 * relative_sigma,
                    passed ? "within" : "over", 100.0 * gate.relative_sigma_max);
}

bool has_negative(const Uncertainty& u) {
  return u.pixel_sigma_px < 0.0 || u.encoder_sigma_rad < 0.0 || u.zero_sigma_rad < 0.0 ||
         u.focal_sigma_px < 0.0 || u.centre_sigma_px < 0.0 || u.mount_offset_sigma_m < 0.0 ||
         u.mount_rotation_sigma_rad < 0.0;
}

}  // namespace

PointEstimate estimate_point(const TwoViews& views, const ErrorSources& errors, const Gate& gate) {
  if (auto reason = what_is_invalid(views, errors, gate)) {
    return refused(Status::invalid_input, *std::move(reason));
  }
  if (auto reason = what_is_degenerate(views, errors, gate)) {
    return refused(Status::degenerate, *std::move(reason));
  }
  const std::optional<CorrectedPair> pair =
      correct_optimally(views.cam2_from_cam1, views.point_1.normalised, views.point_2.normalised);
  if (!pair) return refused(Status::degenerate, "an image point is at its epipole");
  const InverseDepthPoint point = intersect(views.cam2_from_cam1, *pair);
  const Propagated propagated = propagate(views, errors, point);
  const double residual_sigmas = std::abs(propagated.residual) / propagated.residual_sigma;
  if (!std::isfinite(propagated.inverse_range_per_m) ||
      !std::isfinite(propagated.inverse_range_sigma_per_m) ||
      !std::isfinite(propagated.residual_sigma)) {
    return refused(Status::degenerate, "the rays do not determine a point");
  }

  PointEstimate out;
  out.parallax_rad = parallax(views, *pair);
  out.residual_px = residual_px(views, *pair);
  if (std::abs(propagated.residual) > residual_rounding &&
      residual_sigmas * residual_sigmas > gate.epipolar_chi2_max) {
    out.status = Status::target_lost;
    out.reason = text("epipolar residual %.2f px, %.1f sigmas: not the same point", out.residual_px,
                      residual_sigmas);
    return out;
  }
  out.inverse_range_per_m = propagated.inverse_range_per_m;
  out.inverse_range_sigma_per_m = propagated.inverse_range_sigma_per_m;
  if (auto reason = what_is_behind(views, errors, point, propagated.inverse_range_per_m)) {
    out.status = Status::behind_camera;
    out.reason = *std::move(reason);
    return out;
  }
  judge_sigma(views, point, propagated, gate, out);
  return out;
}

PointEstimate estimate_point(const HeadGeometry& head, const CameraModel& camera,
                             const Uncertainty& uncertainty, const TwoLooks& looks,
                             const Gate& gate) {
  if (has_negative(uncertainty)) return refused(Status::invalid_input, "a sigma is negative");
  const Eigen::Matrix2d noise_px2 =
      uncertainty.pixel_sigma_px * uncertainty.pixel_sigma_px * Eigen::Matrix2d::Identity();
  const auto point_1 = image_point(camera, looks.pixel_1, noise_px2);
  const auto point_2 = image_point(camera, looks.pixel_2, noise_px2 + looks.pixel_2_covariance_px2);
  if (!point_1 || !point_2) {
    const Pixel& pixel = point_1 ? looks.pixel_2 : looks.pixel_1;
    return refused(Status::invalid_input,
                   text("pixel %s (%g, %g) has no ray", point_1 ? "2" : "1", pixel.x(), pixel.y()));
  }
  const TwoViews views{.cam2_from_cam1 = cam2_from_cam1(head, looks.head_1, looks.head_2),
                       .point_1 = *point_1,
                       .point_2 = *point_2,
                       .torso_from_cam1 = cam_from_torso(head, looks.head_1).inverse()};
  ErrorSources errors;
  add_camera_errors(views, uncertainty.focal_sigma_px, uncertainty.centre_sigma_px, errors);
  add_head_errors(head, looks.head_1, looks.head_2, uncertainty, errors);
  return estimate_point(views, errors, gate);
}

}  // namespace gazed
