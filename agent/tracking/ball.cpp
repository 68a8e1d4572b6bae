#include "agent/tracking/ball.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "agent/geometry/pose.hpp"

namespace gazed::tracking {

namespace {

// How far what lies inside the outline stands out, in radii. Balls: between a mirrored lamp (half)
// and a printed pattern (one). Flat objects: zero, up to the depth error of their outline.
constexpr double of_balls = 0.55, of_balls_sigma = 0.35, of_flat_sigma = 0.1;
// Additional error of one look's value, in radii: where the outline is blurred, what moves with it
// is taken for the inside.
constexpr double look_sigma = 0.2;
// Additional error of the slopes, as the outline displacement that it causes: 0.05 px at a focal
// length of 550 px.
constexpr double outline_sigma_rad = 0.05 / 550.0;
// A disc whose outline is this round is tilted by at most 22 degrees. A ball has no tilt, but its
// highlights may look like some.
constexpr double flat_tilt_sigma_rad = 0.2, ball_tilt_sigma_rad = 0.05;
// Prior: without evidence the depth is corrected by a fifth. Correcting by half would make flat
// objects as wrong as balls.
constexpr double log_odds_before = -1.25;
// Patterns and shadows may cut pieces out of a ball's outline, too.
constexpr double log_odds_not_round = -1.5;
// The models are sometimes wrong, so no single piece of evidence may count for more.
constexpr double log_odds_max = 4.0;
// Relative error of the squared radius: from higher orders, and from an outline known only to a
// cell.
constexpr double square_error = 0.3;

double log_likelihood(double deviation, double variance) {
  return -0.5 * deviation * deviation / variance - 0.5 * std::log(variance);
}

}  // namespace

void BelievedBall::begin(const Relief& relief) {
  *this = {};
  relief_ = relief;
}

void BelievedBall::see(const WarpFit& fit, const PatchMotion& motion) {
  if (!fit.shape_covariance.allFinite()) return;
  see_relief(fit);
  see_slopes(fit, motion);
}

// The evidence of this look alone. The prior (one radius) is common to all looks, so it is taken
// out.
void BelievedBall::see_relief(const WarpFit& fit) {
  const double sigma = std::sqrt(fit.shape_covariance(2, 2)) / fit.relief_prior_sigma_per_m;
  const double of_look = 1.0 / (sigma * sigma) - 1.0;
  if (!(of_look > 0.0)) return;
  const double stands_out =
      fit.warp.relief_per_m / fit.relief_prior_sigma_per_m / (sigma * sigma * of_look);
  const double information = 1.0 / (1.0 / of_look + look_sigma * look_sigma);
  relief_information_ += information;
  relief_sum_ += information * stands_out;
}

void BelievedBall::see_slopes(const WarpFit& fit, const PatchMotion& motion) {
  const Eigen::Vector3d ray = motion.reference.homogeneous();
  const Eigen::Matrix3d axes = geometry::rotation_between(ray, Eigen::Vector3d::UnitZ());
  const Eigen::Vector2d& g = fit.warp.slope_per_m;
  const Eigen::Vector3d plane(g.x(), g.y(), fit.warp.inverse_depth_per_m - g.dot(motion.reference));
  Eigen::Matrix<double, 3, 2> by_slopes;
  by_slopes << Eigen::Matrix2d::Identity(), -motion.reference.transpose();
  const Eigen::Matrix2d by = axes.topRows<2>() * by_slopes;
  const Eigen::Vector2d slopes = axes.topRows<2>() * plane;
  const Eigen::Vector3d shift =
      axes * (motion.cam2_from_cam1.rotation.transpose() * motion.cam2_from_cam1.translation);
  const Eigen::Vector2d across = shift.head<2>();
  const double inverse_distance = fit.warp.inverse_depth_per_m / ray.norm();
  const double model_sigma =
      outline_sigma_rad / std::max(across.norm() * relief_.radius_rad(), 1e-9);
  const Eigen::Matrix2d covariance =
      by * fit.shape_covariance.topLeftCorner<2, 2>() * by.transpose() +
      model_sigma * model_sigma * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d information = covariance.inverse();
  if (!information.allFinite()) return;
  flat_.add(slopes, information);
  ball_.add(slopes - 0.5 * inverse_distance * inverse_distance * across, information);
  inverse_distance_per_m_ = inverse_distance;
}

void BelievedBall::SameInAllLooks::add(const Eigen::Vector2d& value,
                                       const Eigen::Matrix2d& information) {
  information_ += information;
  sum_ += information * value;
  squares_ += value.dot(information * value);
}

double BelievedBall::SameInAllLooks::chi2(double sigma) const {
  const Eigen::Matrix2d with_prior = information_ + Eigen::Matrix2d::Identity() / (sigma * sigma);
  return squares_ - sum_.dot(with_prior.inverse() * sum_);
}

double BelievedBall::log_odds_by_relief() const {
  if (!(relief_information_ > 0.0)) return 0.0;
  const double stands_out = relief_sum_ / relief_information_, variance = 1.0 / relief_information_;
  return log_likelihood(stands_out - of_balls, variance + of_balls_sigma * of_balls_sigma) -
         log_likelihood(stands_out, variance + of_flat_sigma * of_flat_sigma);
}

double BelievedBall::log_odds_by_slopes() const {
  if (!(inverse_distance_per_m_ > 0.0)) return 0.0;
  return 0.5 * (flat_.chi2(flat_tilt_sigma_rad * inverse_distance_per_m_) -
                ball_.chi2(ball_tilt_sigma_rad * inverse_distance_per_m_));
}

double BelievedBall::probability() const {
  const auto limited = [](double log_odds) {
    return std::clamp(log_odds, -log_odds_max, log_odds_max);
  };
  const double log_odds = log_odds_before + (relief_.is_round() ? 0.0 : log_odds_not_round) +
                          limited(log_odds_by_relief()) + limited(log_odds_by_slopes());
  return 1.0 / (1.0 + std::exp(-log_odds));
}

double BelievedBall::centre_correction_sigma() const {
  const double ball = probability();
  return std::sqrt(ball * (1.0 - ball) + ball * square_error * square_error) * square();
}

}  // namespace gazed::tracking
