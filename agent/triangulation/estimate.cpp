#include "agent/triangulation/estimate.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/triangulation/degeneracy.hpp"
#include "agent/triangulation/judgement.hpp"
#include "agent/triangulation/methods/rectification.hpp"
#include "agent/triangulation/solution.hpp"
#include "agent/triangulation/validity.hpp"

namespace gazed::triangulation {

namespace {

/// An epipolar residual (normalised units) below this is rounding, even if every sigma is 0.
constexpr double residual_rounding = 1e-9;

PointEstimate refused(Status status, std::string reason) {
  PointEstimate out;
  out.status = status;
  out.reason = std::move(reason);
  return out;
}

std::optional<std::string> what_is_degenerate(const TwoViews& views, const ErrorSources& errors,
                                              const Gate& gate, methods::Method method) {
  const geometry::Pose& pose = views.cam2_from_cam1;
  if (auto reason = what_is_degenerate(views, baseline_sigma_m(pose, errors), gate)) return reason;
  if (method == methods::Method::rectification && !methods::rectify(pose)) {
    return "the baseline lies along the optical axis: nothing to rectify";
  }
  return std::nullopt;
}

double parallax(const TwoViews& views, const Solution& solution) {
  const Eigen::Vector3d ray_1 =
      views.cam2_from_cam1.rotation * solution.point.direction.homogeneous();
  const Eigen::Vector3d ray_2 = solution.linearisation.view_2().homogeneous();
  return std::atan2(ray_1.cross(ray_2).norm(), ray_1.dot(ray_2));
}

double residual_px(const TwoViews& views, const Solution& solution) {
  const auto distance_px = [](const ImagePoint& measured, const Eigen::Vector2d& predicted) {
    return (measured.pixel_jacobian * (predicted - measured.normalised)).norm();
  };
  return std::hypot(distance_px(views.point_1, solution.point.direction),
                    distance_px(views.point_2, solution.linearisation.view_2()));
}

/// Depth in camera 2 of (direction, 1); the true depth is this over the inverse depth.
double scaled_depth_2(const TwoViews& views, const geometry::InverseDepthPoint& point) {
  return (views.cam2_from_cam1.rotation * point.direction.homogeneous() +
          point.inverse_depth_per_m * views.cam2_from_cam1.translation)
      .z();
}

/// Cheirality: why the point is not clearly in front of both cameras. An inverse depth that is
/// negative by chance is judged by what a point at infinity on the same ray would show.
std::optional<std::string> what_is_behind(const TwoViews& views, const ErrorSources& errors,
                                          methods::Method method,
                                          const geometry::InverseDepthPoint& point,
                                          double inverse_range_per_m) {
  const bool behind_2 = scaled_depth_2(views, point) <= 0.0;
  if (!behind_2 && point.inverse_depth_per_m >= 0.0) return std::nullopt;
  if (method == methods::Method::linear_mmse) {  // the images show a point in front of both cameras
    return base::text("the prior leads behind a camera: inverse range %.3f 1/m",
                      inverse_range_per_m);
  }
  if (behind_2) {
    return base::text("the rays meet behind camera %s only: inverse range %.3f 1/m from camera 1",
                      point.inverse_depth_per_m > 0.0 ? "2" : "1", inverse_range_per_m);
  }
  const auto infinity = solution_at({point.direction, 0.0}, method, views);
  const double sigma = propagate(views, errors, infinity.value()).inverse_range_sigma_per_m;
  if (inverse_range_per_m >= -sigma) return std::nullopt;
  return base::text(
      "the rays meet %.3f m behind camera 1: inverse range %.3f 1/m, %.1f sigmas below 0",
      -1.0 / inverse_range_per_m, inverse_range_per_m, -inverse_range_per_m / sigma);
}

bool is_finite(const Propagated& propagated) {
  return std::isfinite(propagated.inverse_range_per_m) &&
         std::isfinite(propagated.inverse_range_sigma_per_m) &&
         std::isfinite(propagated.residual_sigma);
}

/// A method's answer to two views. Not finite if the rays do not determine it.
struct Answer {
  std::optional<Solution> solution;
  Propagated propagated;
};

Answer answer(methods::Method method, const TwoViews& views, const ErrorSources& errors,
              const methods::Prior& prior) {
  Answer out{.solution = solve(method, views, prior), .propagated = {}};
  if (out.solution) out.propagated = propagate(views, errors, *out.solution);
  return out;
}

/// Judges cheirality and the sigma of the inverse range.
void judge_position(const TwoViews& views, const ErrorSources& errors, const Gate& gate,
                    methods::Method method, const Answer& answer, PointEstimate& out) {
  const geometry::InverseDepthPoint& point = answer.solution->point;
  out.inverse_range_per_m = answer.propagated.inverse_range_per_m;
  out.inverse_range_sigma_per_m = answer.propagated.inverse_range_sigma_per_m;
  if (auto reason = what_is_behind(views, errors, method, point, out.inverse_range_per_m)) {
    out.status = Status::behind_camera;
    out.reason = *std::move(reason);
    return;
  }
  judge_sigma(point, answer.propagated, views.torso_from_cam1, gate, out);
}

/// All checks from the chi-square on, for a method whose point is the nearest to the images.
PointEstimate estimate_from_images(const TwoViews& views, const ErrorSources& errors,
                                   const Gate& gate, methods::Method method) {
  const Answer nearest = answer(method, views, errors, {});
  if (!is_finite(nearest.propagated)) {
    return refused(Status::degenerate, "the rays do not determine a point");
  }
  PointEstimate out;
  out.parallax_rad = parallax(views, *nearest.solution);
  out.residual_px = residual_px(views, *nearest.solution);
  const double residual = std::abs(nearest.propagated.residual);
  const double residual_sigmas = residual / nearest.propagated.residual_sigma;
  if (residual > residual_rounding && residual_sigmas * residual_sigmas > gate.epipolar_chi2_max) {
    out.status = Status::target_lost;
    out.reason = base::text("epipolar residual %.2f px, %.1f sigmas: not the same point",
                            out.residual_px, residual_sigmas);
    return out;
  }
  judge_position(views, errors, gate, method, nearest, out);
  return out;
}

/// For a method whose point is not the nearest to the images, if those show a point in front of
/// both cameras. The method's own distance from the images is not judged: a linearisation at its
/// point describes another place.
PointEstimate estimate_off_images(const TwoViews& views, const ErrorSources& errors,
                                  const Gate& gate, methods::Method method,
                                  const methods::Prior& prior, double image_residual_px) {
  const Answer own = answer(method, views, errors, prior);
  if (!is_finite(own.propagated)) {
    return refused(Status::degenerate, "the rays do not determine a point");
  }
  PointEstimate out;
  out.parallax_rad = parallax(views, *own.solution);
  out.residual_px = image_residual_px;
  judge_position(views, errors, gate, method, own, out);
  return out;
}

}  // namespace

PointEstimate estimate_point(const TwoViews& views, const ErrorSources& errors, const Gate& gate,
                             methods::Method method, const methods::Prior& prior) {
  auto invalid = what_is_invalid(views, errors, gate);
  if (!invalid && method == methods::Method::linear_mmse) invalid = what_is_invalid(prior);
  if (invalid) return refused(Status::invalid_input, *std::move(invalid));
  if (auto reason = what_is_degenerate(views, errors, gate, method)) {
    return refused(Status::degenerate, *std::move(reason));
  }
  const bool nearest_to_images =
      method == methods::Method::optimal || method == methods::Method::lindstrom;
  PointEstimate from_images = estimate_from_images(
      views, errors, gate, nearest_to_images ? method : methods::Method::optimal);
  if (nearest_to_images || !std::isfinite(from_images.range_m)) return from_images;
  return estimate_off_images(views, errors, gate, method, prior, from_images.residual_px);
}

std::optional<Observation> observe(const geometry::Rig& rig, const TwoLooks& looks) {
  const geometry::Uncertainty& uncertainty = rig.uncertainty;
  const Eigen::Matrix2d noise_px2 =
      uncertainty.pixel_sigma_px * uncertainty.pixel_sigma_px * Eigen::Matrix2d::Identity();
  const auto point_1 = image_point(rig.camera, looks.pixel_1, noise_px2);
  const auto point_2 =
      image_point(rig.camera, looks.pixel_2, noise_px2 + looks.pixel_2_covariance_px2);
  if (!point_1 || !point_2) return std::nullopt;
  Observation out{
      .views = {.cam2_from_cam1 = geometry::cam2_from_cam1(rig.head, looks.head_1, looks.head_2),
                .point_1 = *point_1,
                .point_2 = *point_2,
                .torso_from_cam1 = geometry::cam_from_torso(rig.head, looks.head_1).inverse()},
      .errors = {}};
  add_camera_errors(out.views, uncertainty.focal_sigma_px, uncertainty.centre_sigma_px, out.errors);
  add_lens_errors(out.views, rig.camera, uncertainty.distortion_sigma, out.errors);
  add_head_errors(rig, looks.head_1, looks.head_2, out.errors);
  return out;
}

PointEstimate estimate_point(const geometry::Rig& rig, const TwoLooks& looks, const Gate& gate,
                             methods::Method method, const methods::Prior& prior) {
  if (auto reason = what_is_invalid(rig.uncertainty)) {
    return refused(Status::invalid_input, *std::move(reason));
  }
  const auto observation = observe(rig, looks);
  if (!observation) {
    const bool first = !geometry::normalise(rig.camera, looks.pixel_1);
    const geometry::Pixel& pixel = first ? looks.pixel_1 : looks.pixel_2;
    return refused(Status::invalid_input, base::text("pixel %s (%g, %g) has no ray",
                                                     first ? "1" : "2", pixel.x(), pixel.y()));
  }
  return estimate_point(observation->views, observation->errors, gate, method, prior);
}

}  // namespace gazed::triangulation
