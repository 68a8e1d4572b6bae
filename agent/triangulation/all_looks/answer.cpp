#include "agent/triangulation/all_looks/answer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/triangulation/all_looks/target.hpp"
#include "agent/triangulation/degeneracy.hpp"
#include "agent/triangulation/judgement.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Why no look is anywhere else than look 1, in terms of the look that is farthest from it.
std::optional<std::string> what_is_degenerate(const Problem& problem, const Robot& robot,
                                              const Matrix& covariance, const Gate& gate) {
  // Look 1's ray is as hard to tell from the baseline as a later ray, even though it defines the
  // point.
  const double sigma_px = problem.rig.uncertainty.pixel_sigma_px;
  const Eigen::Matrix2d noise_px2 = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  const auto point = [&](std::size_t k) {
    const Problem::TargetObservation& view = problem.target[k];
    return image_point(robot.camera(), view.pixel, k == 0 ? noise_px2 : view.covariance_px2);
  };
  std::optional<std::string> out = "the looks have no rays";
  double widest_m = -1.0;
  const auto point_1 = point(0);
  for (std::size_t k = 1; k < problem.looks; ++k) {
    if (!contains(problem.target_kept, k)) continue;
    const auto point_k = point(k);
    if (!point_1 || !point_k) continue;
    const TwoViews views{.cam2_from_cam1 = robot.look(k).cam_from_cam1(),
                         .point_1 = *point_1,
                         .point_2 = *point_k,
                         .torso_from_cam1 = std::nullopt};
    auto reason = what_is_degenerate(views, baseline_sigma_m(robot, k, covariance), gate);
    if (!reason) return std::nullopt;
    const double baseline_m = views.cam2_from_cam1.translation.norm();
    if (baseline_m > widest_m) {
      widest_m = baseline_m;
      out = std::move(reason);
    }
  }
  return out;
}

/// The angle between a point's rays in look 1 and in a later look.
double parallax(const geometry::Pose& cam_from_cam1, const geometry::InverseDepthPoint& point) {
  const Eigen::Vector3d ray_1 = cam_from_cam1.rotation * point.direction.homogeneous();
  const Eigen::Vector3d ray = ray_1 + point.inverse_depth_per_m * cam_from_cam1.translation;
  return std::atan2(ray_1.cross(ray).norm(), ray_1.dot(ray));
}

}  // namespace

PointEstimate images_of(const Problem& problem, const State& state) {
  const Robot robot(problem, state.robot);
  PointEstimate out;
  out.parallax_rad = 0.0;
  double squared_px2 = 0.0;
  for (std::size_t k = 0; k < problem.looks; ++k) {
    if (!contains(problem.target_kept, k)) continue;
    const geometry::Pose cam_from_cam1 = robot.look(k).cam_from_cam1();
    out.parallax_rad = std::max(out.parallax_rad, parallax(cam_from_cam1, state.target));
    PointInLook seen;
    if (!robot.see_at_target_row(k, state.target, seen)) continue;
    squared_px2 += (seen.pixel - problem.target[k].pixel).squaredNorm();
  }
  out.residual_px = std::sqrt(squared_px2 / (std::popcount(problem.target_kept) - 1));
  return out;
}

PointEstimate answer_of(const Problem& problem, const State& state, const Matrix& covariance,
                        const Gate& gate) {
  const Robot robot(problem, state.robot);
  PointEstimate out;
  if (auto reason = what_is_degenerate(problem, robot, covariance, gate)) {
    out.status = Status::degenerate;
    out.reason = *std::move(reason);
    return out;
  }
  out = images_of(problem, state);
  const Propagated propagated = target_uncertainty(robot, state, covariance);
  out.inverse_range_per_m = propagated.inverse_range_per_m;
  out.inverse_range_sigma_per_m = propagated.inverse_range_sigma_per_m;
  if (out.inverse_range_per_m < -out.inverse_range_sigma_per_m) {
    out.status = Status::behind_camera;
    out.reason = base::text("the rays meet behind camera 1: inverse range %.3f +- %.3f 1/m",
                            out.inverse_range_per_m, out.inverse_range_sigma_per_m);
    return out;
  }
  judge_sigma(state.target, propagated,
              geometry::cam_from_torso(robot.head(), robot.reading(0)).inverse(), gate, out);
  return out;
}

}  // namespace gazed::triangulation::all_looks
