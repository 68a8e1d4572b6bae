// The patch's place in view 2 to sub-pixel: least squares on the warp, gain and bias.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/tracking/patch.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

/// Standard deviations of the warp's prior. Nothing is assumed about the position.
struct WarpPrior {
  double slope_sigma_per_m = 0.0;  // of each component of g
  double log_scale_sigma = 0.0;
  double relief_sigma_per_m = 0.0;  // of h
};

/// How well a warp fits.
struct WarpFit {
  PatchWarp warp;
  bool converged = false;
  double correlation = 0.0;  // normalised, over the visible samples
  double gain = 1.0;         // contrast in view 2 over contrast in view 1, by regression
  double visible = 0.0;      // share of the samples that are inside view 2
  // Only set by a fit at full size.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();    // of the reference point in view 2
  Eigen::Matrix3d shape_covariance = Eigen::Matrix3d::Zero();  // of g and h, 1/m^2
  double relief_prior_sigma_per_m = 0.0;                       // prior sigma of h
  /// How much the background behind the outline changed from view 1 to view 2, in units of the
  /// patch's contrast.
  double background_change = 0.0;
};

class WarpRefinement {
 public:
  void reserve(std::size_t samples);

  /// Gauss-Newton from `start` on one level; the residual is view 2 at the warped place - (gain *
  /// value + bias). Samples that do not fit, because something is in front of the object, are
  /// weighted down.
  WarpFit run(const PatchLevel& level, const PlaneLevel& plane_2, const PatchMotion& motion,
              const geometry::CameraModel& camera, const WarpPrior& prior, const PatchWarp& start);

  /// Where the samples of the last run lie in view 2; NaN if outside.
  [[nodiscard]] std::span<const geometry::Pixel> pixels_2() const { return pixels_; }

 private:
  // Unknowns: turn about two axes perpendicular to the reference ray, log scale, slopes, relief;
  // gain, bias. A turn about the ray is left out: angle errors hardly cause one, and a round object
  // would follow its own pixel pattern around.
  static constexpr int unknowns = 8, relief_at = 5;
  using Vector = Eigen::Matrix<double, unknowns, 1>;
  using Matrix = Eigen::Matrix<double, unknowns, unknowns>;

  struct Problem {
    const PatchLevel& level;
    const PlaneLevel& plane_2;
    const PatchMotion& motion;
    const geometry::CameraModel& camera;
  };
  struct Normal {
    Matrix matrix = Matrix::Zero();
    Vector right_side = Vector::Zero();
    double variance = 0.0;        // of a residual, corrected for correlation
    double plain_variance = 0.0;  // of a residual, as observed
  };

  /// What view 2 shows at a sample's place.
  struct Reading {
    geometry::Pixel pixel;
    PlaneSample plane;
    Vector jacobian;
  };
  class Reader;
  /// The part of a normal matrix that camera noise in the slopes has contributed.
  [[nodiscard]] Matrix noise_share(const Problem& problem, const Reader& reader,
                                   double slope_variance) const;
  /// Of turn, slopes and relief.
  using Covariance = Eigen::Matrix<double, 5, 5>;
  [[nodiscard]] Covariance covariance(const Problem& problem, const Reader& reader,
                                      const Normal& normal) const;

  int linearise(const Problem& problem, const PatchWarp& warp, const Eigen::Matrix3d& axes,
                bool may_reappear);
  void correlate(const PatchLevel& level, bool fit_gain);
  Normal accumulate(const PatchLevel& level);
  void add_prior(const WarpPrior& prior, const PatchWarp& warp, Normal& normal) const;
  [[nodiscard]] double background_change() const;
  void take_step(const Vector& step, const Eigen::Matrix3d& axes, PatchWarp& warp);

  std::vector<float> weights_;
  double contrast_ = 0.0;        // of the patch: twice the standard deviation of its values
  double contrast_ratio_ = 1.0;  // view 2 over view 1
  double gain_ = 1.0, bias_ = 0.0, correlation_ = 0.0;
  std::vector<geometry::Pixel> pixels_;
  std::vector<Vector> jacobians_;
  std::vector<float> seen_;    // view 2 at pixels_; NaN if outside
  std::vector<float> fitted_;  // the same, minus the change of the background
  std::vector<float> slope2_;  // squared, per sample spacing
  std::vector<float> scratch_;
  // of the background's values, view 1 to view 2; NaN if unseen
  std::vector<double> behind_change_;
  std::vector<Vector> behind_jacobian_;    // derivatives of that
  std::vector<std::uint8_t> behind_seen_;  // whether view 2 shows each background place
};

}  // namespace gazed::tracking
