// What view 2 shows at a patch's warped samples, and how that changes with the warp.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "agent/tracking/refine.hpp"

namespace gazed::tracking {

// d pixel of the ray / d turn about the first two axes.
inline Eigen::Matrix2d pixel_by_turn(const geometry::CameraModel& camera,
                                     const Eigen::Vector3d& ray, const Eigen::Matrix3d& axes) {
  const Eigen::Vector2d normalised = ray.hnormalized();
  Eigen::Matrix2d normalised_by_turn;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d ray_by_turn = axes.col(k).cross(ray) / ray.z();
    normalised_by_turn.col(k) = ray_by_turn.head<2>() - ray_by_turn.z() * normalised;
  }
  return geometry::pixel_jacobian(camera, normalised) * normalised_by_turn;
}

// Reads view 2 at warped samples, with the derivatives of the residual by the unknowns.
class WarpRefinement::Reader {
 public:
  static constexpr double sample_border_px = 1.0;  // samples keep this far from the frame's border

  Reader(const Problem& problem, const PatchWarp& warp, const Eigen::Matrix3d& axes)
      : problem_(problem),
        axes_(axes),
        homography_(problem.motion.homography(warp)),
        unscaled_(warp.turn * problem.motion.plane_homography(warp)),
        baseline_(warp.turn * problem.motion.cam2_from_cam1.translation),
        size_(std::exp(warp.log_scale)),
        relief_(warp.relief_per_m * baseline_) {}

  /// False if view 2 does not show the sample.
  bool read(const PatchSample& sample, Reading& out) const {
    const auto& [level, plane, motion, camera] = problem_;
    const Eigen::Vector3d ray = ray_of(sample);
    if (!(ray.z() > 0.0)) return false;
    const Eigen::Vector2d normalised = ray.hnormalized();
    out.pixel = geometry::pixel_of(camera, normalised);
    const Eigen::Vector2d at = plane.to_samples(out.pixel);
    if (!camera.contains(out.pixel, sample_border_px) || !plane.readable(at)) return false;
    out.plane = plane.read(at);
    out.jacobian =
        jacobian(sample, ray, normalised, Eigen::RowVector2d(out.plane.dx, out.plane.dy));
    return true;
  }

  /// d residual / d unknowns where view 2 has these slopes per sample spacing.
  Vector jacobian(const PatchSample& sample, const Eigen::RowVector2d& slopes) const {
    const Eigen::Vector3d ray = ray_of(sample);
    return jacobian(sample, ray, ray.hnormalized(), slopes);
  }

 private:
  [[nodiscard]] Eigen::Vector3d ray_of(const PatchSample& sample) const {
    return homography_ * sample.normalised.homogeneous() +
           static_cast<double>(sample.relief) * relief_;
  }

  Vector jacobian(const PatchSample& sample, const Eigen::Vector3d& ray,
                  const Eigen::Vector2d& normalised, const Eigen::RowVector2d& slopes) const {
    const auto& [level, plane, motion, camera] = problem_;
    // d value / d ray, then multiplied by each unknown's effect on the ray.
    const Eigen::RowVector2d by_pixel = slopes / plane.step_px;
    const Eigen::RowVector2d by_normalised =
        by_pixel * geometry::pixel_jacobian(camera, normalised);
    const Eigen::Vector3d by_ray =
        Eigen::Vector3d(by_normalised.x(), by_normalised.y(), -by_normalised.dot(normalised)) /
        ray.z();
    const Eigen::Vector2d offset = size_ * (sample.normalised - motion.reference);
    Vector out;
    out.head<2>() = axes_.leftCols<2>().transpose() * ray.cross(by_ray);
    out[2] = by_ray.dot(unscaled_.leftCols<2>() * offset);
    const double by_inverse_depth = by_ray.dot(baseline_);
    out.segment<2>(3) = by_inverse_depth * offset;
    out[5] = by_inverse_depth * static_cast<double>(sample.relief);
    out[6] = -sample.value;
    out[7] = -1.0;
    return out;
  }

  const Problem& problem_;
  const Eigen::Matrix3d& axes_;
  Eigen::Matrix3d homography_, unscaled_;
  Eigen::Vector3d baseline_;
  double size_;
  Eigen::Vector3d relief_;
};

}  // namespace gazed::tracking
