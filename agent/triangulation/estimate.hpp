// From two looks at a point to an estimate with uncertainty and status. All checks of a pair are
// made here, including the gate.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// Triangulates by `method`, propagates the image noise of both views and every source in `errors`,
/// and judges. Order of the checks: finite numbers (INVALID_INPUT); baseline against its own sigma,
/// rays against the baseline, a point at its epipole, nothing to rectify (DEGENERATE); chi-square
/// of the epipolar residual (TARGET_LOST); cheirality in both views (BEHIND_CAMERA); relative sigma
/// (UNCERTAIN).
///
/// If the one-sigma interval of the inverse range reaches 0, there is no position: the status is
/// UNCERTAIN, or BEHIND_CAMERA if the inverse range is so far negative that a point at infinity
/// would produce it in less than one case of six (one sigma).
///
/// The optimal method judges what the images say by themselves (Lindstrom's finds the same point).
/// Rectification and linear MMSE answer only if that found a point in front of both cameras;
/// otherwise the answer is the optimal method's. The residual is always that of the images.
///
/// `prior` is used by linear MMSE alone. Its sigmas hold on average over points distributed like
/// the prior; a point far outside is pulled in by more than its sigma. Never throws.
[[nodiscard]] PointEstimate estimate_point(const TwoViews& views, const ErrorSources& errors,
                                           const Gate& gate,
                                           methods::Method method = methods::Method::optimal,
                                           const methods::Prior& prior = {});

/// Two looks of one camera in one head at the same scene point.
struct TwoLooks {
  geometry::HeadAngles head_1, head_2;  // measured
  geometry::Pixel pixel_1, pixel_2;     // as seen, with lens distortion
  /// Covariance of pixel_2 from the registration, px^2. pixel_1 defines the point and has no noise
  /// beyond Uncertainty::pixel_sigma_px.
  Eigen::Matrix2d pixel_2_covariance_px2 = Eigen::Matrix2d::Zero();
};

/// What the triangulation needs to know of two looks: their views, and everything that may be wrong
/// with them.
struct Observation {
  TwoViews views;
  ErrorSources errors;
};

/// None if the camera model has no ray for a pixel.
[[nodiscard]] std::optional<Observation> observe(const geometry::Rig& rig, const TwoLooks& looks);

/// The same for two looks of a head, with every error source of the rig propagated through the
/// kinematic chain, and with the point also in the torso frame. Never throws.
[[nodiscard]] PointEstimate estimate_point(const geometry::Rig& rig, const TwoLooks& looks,
                                           const Gate& gate,
                                           methods::Method method = methods::Method::optimal,
                                           const methods::Prior& prior = {});

}  // namespace gazed::triangulation
