// From two looks at a point to an estimate with its uncertainty and status. All checks of a pair,
// and the gate, are made here.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// Triangulates by `method`, propagates the image noise of both views and every source of `errors`,
/// and decides. Order of checks: finite (INVALID_INPUT), baseline against its own sigma,
/// perpendicular baseline (both rays against the baseline, a point at its epipole, nothing to
/// rectify: DEGENERATE), chi-square of the epipolar residual (TARGET_LOST), cheirality in both
/// views (BEHIND_CAMERA), relative sigma (UNCERTAIN).
///
/// An inverse range whose one-sigma interval reaches 0 has no position: UNCERTAIN, or BEHIND_CAMERA
/// when a point at infinity would come out so far negative in less than one case of six (one
/// sigma).
///
/// What the images say by themselves is judged by the optimal method (or Lindstrom's, which is the
/// same point). Rectification and linear MMSE answer only where that found a point in front of both
/// cameras: elsewhere the answer is the optimal method's. The residual is of the images, whatever
/// the method.
///
/// `prior` is for linear MMSE alone, whose sigmas are right over points that are as the prior says:
/// one far outside it is pulled in, by more than they tell. Never throws.
[[nodiscard]] PointEstimate estimate_point(const TwoViews& views, const ErrorSources& errors,
                                           const Gate& gate,
                                           methods::Method method = methods::Method::optimal,
                                           const methods::Prior& prior = {});

/// Two looks of one camera in one head at the same scene point.
struct TwoLooks {
  geometry::HeadAngles head_1, head_2;  // measured
  geometry::Pixel pixel_1, pixel_2;     // as seen, with lens distortion
  /// Covariance of pixel_2 as the registration reports it, px^2; pixel_1 defines the point and has
  /// none beyond Uncertainty::pixel_sigma_px.
  Eigen::Matrix2d pixel_2_covariance_px2 = Eigen::Matrix2d::Zero();
};

/// What two looks are to the triangulation: their views, and all that may be wrong with them.
struct Observation {
  TwoViews views;
  ErrorSources errors;
};

/// None where the camera model has no ray for a pixel.
[[nodiscard]] std::optional<Observation> observe(const geometry::HeadGeometry& head,
                                                 const geometry::CameraModel& camera,
                                                 const geometry::Uncertainty& uncertainty,
                                                 const TwoLooks& looks);

/// The same with every error source of `uncertainty` propagated through the kinematic chain, and
/// the point in the torso frame too. Never throws.
[[nodiscard]] PointEstimate estimate_point(const geometry::HeadGeometry& head,
                                           const geometry::CameraModel& camera,
                                           const geometry::Uncertainty& uncertainty,
                                           const TwoLooks& looks, const Gate& gate,
                                           methods::Method method = methods::Method::optimal,
                                           const methods::Prior& prior = {});

}  // namespace gazed::triangulation
