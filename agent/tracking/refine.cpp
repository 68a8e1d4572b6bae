#include "agent/tracking/refine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "agent/geometry/cholesky.hpp"
#include "agent/tracking/lower_triangle.hpp"
#include "agent/tracking/warp_reader.hpp"

namespace gazed::tracking {

namespace {

constexpr int fit_iterations_max = 20;
// A sample at the frame's border may enter with one step and leave with the next, for ever: after
// this many iterations, samples that are out of the frame stay out.
constexpr int reappearing_iterations = 8;
// Steps, in samples of the level: where to stop, what still counts as converged after the last
// iteration (the weights may oscillate), and how far a linearisation is trusted.
constexpr double fit_step_converged = 2e-3;
constexpr double sigmas_converged = 0.05;  // the same for all unknowns, in units of their sigmas
constexpr double step_tolerated = 0.02;
// A larger last step is tolerated if it is small against the answer's sigma.
constexpr double step_tolerated_max = 0.1, sigmas_tolerated = 0.3;
constexpr double fit_step_max = 1.5;
constexpr int visible_samples_min = 24;
constexpr std::size_t edges_min = 24;
// With less background, its change is negligible.
constexpr float share_behind_min = 0.003F;

// Residuals beyond this many scales are outliers; their weight falls with the square.
constexpr double outlier_scales = 2.5;
// A slightly wrong shape or sampling shows first at steep places: they may be off by this much
// (samples).
constexpr double edge_tolerance = 0.1;
constexpr double residual_scale_min = 0.7;  // grey levels; rounding alone gives 0.4

// How much exposure and lighting may change from look to look. Without this prior a flat interior
// fits best with zero gain, whatever its edges say.
constexpr double log_gain_sigma = 0.3;
constexpr double bias_sigma_levels = 20.0;
constexpr double smallest_gain = 0.05;
constexpr double first_gain_min = 0.6, first_gain_max = 1.7;

// Only keeps the normal matrix regular when a patch has structure in one direction.
constexpr double place_sigma_rad = 0.1;

// A plane's values are smoothed: 0.09 of the variance of the camera's white noise is left, and
// neighbours are correlated, so summing over all pixels of an edge gains less than with independent
// residuals. The kernel's energy and, across the edge, that of a Gaussian of the same variance give
// a factor of 7.9; Monte Carlo, where the residuals also contain sampling errors, gives 6. Taking
// every n-th pixel divides it by n, down to 1.
constexpr double noise_correlation = 6.0;

// Three axes, the reference ray being the last.
Eigen::Matrix3d axes_about(const Eigen::Vector3d& ray) {
  Eigen::Matrix3d axes;
  axes.col(2) = ray.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

void WarpRefinement::reserve(std::size_t samples) {
  pixels_.reserve(samples);
  jacobians_.reserve(samples);
  for (auto* values : {&seen_, &fitted_, &slope2_, &scratch_, &weights_}) values->reserve(samples);
  behind_change_.reserve(Rim::points_max);
  behind_jacobian_.reserve(Rim::points_max);
  behind_seen_.reserve(Rim::points_max * Rim::places_behind);
}

// Reads view 2 at every warped sample. Where view 2 shows a share of the background, that share of
// the background's change is subtracted. Returns how many samples are visible.
int WarpRefinement::linearise(const Problem& problem, const PatchWarp& warp,
                              const Eigen::Matrix3d& axes, bool may_reappear) {
  const PatchLevel& level = problem.level;
  const Reader reader(problem, warp, axes);
  Reading reading;
  constexpr std::size_t places = Rim::places_behind;
  behind_change_.assign(level.behind.size() / places, std::numeric_limits<double>::quiet_NaN());
  behind_jacobian_.resize(behind_change_.size());
  if (may_reappear) behind_seen_.assign(level.behind.size(), 1);
  for (std::size_t point = 0; point < behind_change_.size(); ++point) {
    double n = 0.0, change = 0.0;
    Vector jacobian = Vector::Zero();
    for (std::size_t i = places * point; i < places * (point + 1); ++i) {
      const PatchSample& behind = level.behind[i];
      if (behind_seen_[i] == 0 || std::isnan(behind.value) || !reader.read(behind, reading)) {
        behind_seen_[i] = 0;
        continue;
      }
      n += 1.0;
      change += reading.plane.value - gain_ * static_cast<double>(behind.value) - bias_;
      jacobian += reading.jacobian;
    }
    if (n == 0.0) continue;
    behind_change_[point] = change / n;
    behind_jacobian_[point] = jacobian / n;
  }
  const std::size_t count = level.samples.size();
  pixels_.assign(count, geometry::Pixel::Constant(std::numeric_limits<double>::quiet_NaN()));
  if (may_reappear) seen_.assign(count, 0.0F);
  fitted_.assign(count, std::numeric_limits<float>::quiet_NaN());
  slope2_.resize(count);
  jacobians_.resize(count);
  int visible = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PatchSample& sample = level.samples[i];
    if (std::isnan(seen_[i]) || !reader.read(sample, reading)) {
      seen_[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    ++visible;
    pixels_[i] = reading.pixel;
    seen_[i] = fitted_[i] = reading.plane.value;
    slope2_[i] = reading.plane.dx * reading.plane.dx + reading.plane.dy * reading.plane.dy;
    jacobians_[i] = reading.jacobian;
    if (sample.share_behind < share_behind_min || std::isnan(behind_change_[sample.behind]))
      continue;
    const double share = static_cast<double>(sample.share_behind);
    fitted_[i] -= static_cast<float>(share * behind_change_[sample.behind]);
    jacobians_[i] -= share * behind_jacobian_[sample.behind];
  }
  return visible;
}

// Correlation of what is seen. The background's change is not subtracted here: otherwise an empty
// wall would match anything of one colour. Gain and bias come from linear regression if not known
// yet.
void WarpRefinement::correlate(const PatchLevel& level, bool fit_gain) {
  double n = 0.0, sum_1 = 0.0, sum_2 = 0.0, square_1 = 0.0, square_2 = 0.0, product = 0.0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (std::isnan(seen_[i])) continue;
    const double value_1 = level.samples[i].value, value_2 = seen_[i];
    n += 1.0;
    sum_1 += value_1;
    sum_2 += value_2;
    square_1 += value_1 * value_1;
    square_2 += value_2 * value_2;
    product += value_1 * value_2;
  }
  const double spread_1 = square_1 - sum_1 * sum_1 / n, spread_2 = square_2 - sum_2 * sum_2 / n;
  const double common = product - sum_1 * sum_2 / n;
  contrast_ = 2.0 * std::sqrt(std::max(spread_1, 0.0) / n);
  contrast_ratio_ = spread_1 > 0.0 ? common / spread_1 : 0.0;
  if (fit_gain) {
    gain_ = std::clamp(contrast_ratio_, first_gain_min, first_gain_max);
    bias_ = (sum_2 - gain_ * sum_1) / n;
  }
  correlation_ = spread_1 > 0.0 && spread_2 > 0.0 ? common / std::sqrt(spread_1 * spread_2) : 0.0;
}

WarpRefinement::Normal WarpRefinement::accumulate(const PatchLevel& level) {
  const auto residual = [&](std::size_t i) {
    return fitted_[i] - gain_ * static_cast<double>(level.samples[i].value) - bias_;
  };
  // Flat samples fit whatever the gain is. Where they are the majority, they must not determine how
  // well edges should fit.
  scratch_.clear();
  const std::size_t judged = level.edges >= edges_min ? level.edges : seen_.size();
  for (std::size_t i = 0; i < judged; ++i) {
    if (!std::isnan(seen_[i])) scratch_.push_back(static_cast<float>(std::abs(residual(i))));
  }
  if (scratch_.empty()) scratch_.push_back(0.0F);
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
  std::nth_element(scratch_.begin(), middle, scratch_.end());
  const double scale = std::max(residual_scale_min, 1.4826 * static_cast<double>(*middle));

  Normal normal;
  weights_.assign(seen_.size(), 0.0F);
  double weight_sum = 0.0, weighted_squares = 0.0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (std::isnan(seen_[i])) continue;
    const double r = residual(i);
    const double limit2 = outlier_scales * outlier_scales *
                          (scale * scale + edge_tolerance * edge_tolerance * slope2_[i]);
    const double weight = r * r > limit2 ? limit2 / (r * r) : 1.0;
    weights_[i] = static_cast<float>(weight);
    const Vector weighted = weight * jacobians_[i];
    add_lower_triangle(weighted, jacobians_[i], normal.matrix);
    normal.right_side -= r * weighted;
    weight_sum += weight;
    weighted_squares += weight * r * r;
  }
  normal.matrix.triangularView<Eigen::StrictlyUpper>() = normal.matrix.transpose();
  // As if the residuals were independent: their correlation is accounted for in the variance.
  normal.plain_variance = weighted_squares / std::max(weight_sum - unknowns, 1.0);
  normal.variance = std::max(1.0, noise_correlation / level.edge_stride) *
                    std::max(normal.plain_variance, residual_scale_min * residual_scale_min);
  return normal;
}

// Adds the prior of the warp, in units of the residuals' variance.
void WarpRefinement::add_prior(const WarpPrior& prior, const PatchWarp& warp,
                               Normal& normal) const {
  // The prior is on the logarithm of the gain, linearised at the current gain.
  const double gain = std::max(gain_, smallest_gain);
  Vector information = Vector::Zero(), deviation = Vector::Zero();
  information << Eigen::Vector2d::Constant(std::pow(place_sigma_rad, -2)),
      std::pow(prior.log_scale_sigma, -2),
      Eigen::Vector2d::Constant(std::pow(prior.slope_sigma_per_m, -2)),
      std::pow(prior.relief_sigma_per_m, -2), std::pow(log_gain_sigma * gain, -2),
      std::pow(bias_sigma_levels, -2);
  deviation[2] = warp.log_scale;
  deviation.segment<2>(3) = warp.slope_per_m;
  deviation[relief_at] = warp.relief_per_m;
  deviation[6] = gain * std::log(gain);
  deviation[7] = bias_;
  normal.matrix.diagonal() += normal.variance * information;
  normal.right_side -= normal.variance * information.cwiseProduct(deviation);
}

void WarpRefinement::take_step(const Vector& step, const Eigen::Matrix3d& axes, PatchWarp& warp) {
  warp.turn = geometry::rotation_by(axes.leftCols<2>() * step.head<2>()) * warp.turn;
  warp.log_scale += step[2];
  warp.slope_per_m += step.segment<2>(3);
  warp.relief_per_m += step[relief_at];
  gain_ += step[6];
  bias_ += step[7];
}

WarpFit WarpRefinement::run(const PatchLevel& level, const PlaneLevel& plane_2,
                            const PatchMotion& motion, const geometry::CameraModel& camera,
                            const WarpPrior& prior, const PatchWarp& start) {
  const Problem problem{level, plane_2, motion, camera};
  gain_ = 1.0;
  bias_ = 0.0;
  const double samples_per_rad = camera.focal_px.mean() / plane_2.step_px;
  WarpFit fit;
  fit.warp = start;
  for (int iteration = 0; iteration < fit_iterations_max; ++iteration) {
    const Eigen::Vector3d ray = motion.homography(fit.warp) * motion.reference.homogeneous();
    if (!(ray.z() > 0.0)) return fit;
    const Eigen::Matrix3d axes = axes_about(ray);
    const int visible = linearise(problem, fit.warp, axes, iteration < reappearing_iterations);
    fit.visible = static_cast<double>(visible) / static_cast<double>(level.samples.size());
    if (visible < visible_samples_min) return fit;
    correlate(level, iteration == 0);
    fit.gain = contrast_ratio_;
    fit.correlation = correlation_;
    Normal normal = accumulate(level);
    add_prior(prior, fit.warp, normal);
    Matrix factors = normal.matrix;
    if (!geometry::factorise(factors)) return fit;
    Vector step = normal.right_side;
    geometry::solve_factorised(factors, step);
    if (!step.allFinite()) return fit;

    const double length = step.head<2>().norm() * samples_per_rad;
    const double sigmas = std::sqrt(std::abs(step.dot(normal.right_side)) / normal.variance);
    fit.converged =
        length < step_tolerated || (length < step_tolerated_max && sigmas < sigmas_tolerated);
    const bool done = length < fit_step_converged && sigmas < sigmas_converged;
    const bool is_full_size = plane_2.step_px == 1;  // reduced levels only lead there
    if (is_full_size && (done || iteration + 1 == fit_iterations_max)) {
      fit.background_change = background_change();
      const Eigen::Matrix2d by_turn = pixel_by_turn(camera, ray, axes);
      const Covariance known = covariance(problem, Reader(problem, fit.warp, axes), normal);
      fit.covariance_px2 = by_turn * known.topLeftCorner<2, 2>() * by_turn.transpose();
      fit.shape_covariance = known.bottomRightCorner<3, 3>();
      fit.relief_prior_sigma_per_m = prior.relief_sigma_per_m;
    }
    if (length > fit_step_max) step *= fit_step_max / length;
    take_step(step, axes, fit.warp);
    if (done) break;
  }
  return fit;
}

}  // namespace gazed::tracking
