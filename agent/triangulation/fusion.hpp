// Several looks at one target, fused in inverse range.
//
// A pair is look 1 with one later look. Every pair says how far the point under look 1's pixel is;
// what is fused is the inverse range along that ray, whose errors are near Gaussian, never the
// range. Pairs share the noise of look 1, and all looks share the errors of calibration: each
// source of error is followed through every pair, so nothing common is ever averaged away.
//
// By the encoders alone and in closed form. The cycle asks all_looks/locate.hpp, which also has the
// background and the angles' own corrections.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// One look at the target.
struct Look {
  geometry::HeadAngles head;  // measured
  geometry::Pixel pixel;      // as seen, with lens distortion
  /// As the registration reports it, on top of Uncertainty::pixel_sigma_px; not used of the first
  /// look, whose pixel defines the point.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
};

/// What became of a later look. Its numbers are those of its pair with look 1.
struct LookVerdict {
  bool used = false;
  /// How the pair came out by itself; TARGET_LOST also for a look that the others contradict.
  Status status = Status::invalid_input;
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;  // of all sources
  /// For a look that the others contradict: what it adds to their chi-square, one degree of
  /// freedom.
  double chi2 = not_a_number;
};

struct FusedEstimate {
  /// As of one pair. The parallax is the widest of the looks used, the residual the root mean
  /// square of their pairs'. The reason also names the looks that were not used.
  PointEstimate estimate;
  std::array<LookVerdict, looks_max> looks;  // as given; the first is used if any is
  std::size_t looks_used = 0;                // with the first
  double chi2 = not_a_number;                // of the pairs' inverse ranges about the fused one
  int degrees_of_freedom = 0;                // of the chi-square: pairs used less one
};

/// Fuses by the optimal method. A later look is left out when its own pair is degenerate or
/// contradicts itself (estimate_point), and when the pairs' inverse ranges contradict each other
/// (chi-square with their joint covariance, 99.9 %): then the look goes whose loss helps most,
/// until the others agree. They must be more than those that went, else it is not known who is
/// right: TARGET_LOST. Two looks give what estimate_point gives.
///
/// Pairs are weighted by the joint covariance of their noise; the errors of calibration are added
/// to the fused result. Throws std::invalid_argument for fewer than 2 or more than `looks_max`
/// looks.
[[nodiscard]] FusedEstimate fuse_looks(const geometry::HeadGeometry& head,
                                       const geometry::CameraModel& camera,
                                       const geometry::Uncertainty& uncertainty,
                                       std::span<const Look> looks, const Gate& gate);

}  // namespace gazed::triangulation
