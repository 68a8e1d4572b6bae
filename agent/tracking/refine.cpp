#include "agent/tracking/refine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "agent/geometry/cholesky.hpp"

namespace gazed::tracking {

namespace {

constexpr int fit_iterations_max = 20;
// Steps in samples of the level: where to stop, what still counts as converged after the last
// iteration (weights may go to and fro), and how far a linearisation is trusted.
constexpr double fit_step_converged = 2e-3;
constexpr double sigmas_converged = 0.05;  // the same of all unknowns, in their own sigmas
constexpr double step_tolerated = 0.02;
constexpr double fit_step_max = 1.5;
constexpr int visible_samples_min = 24;
constexpr double sample_border_px = 1.0;

// Residuals beyond this many scales are outliers; their weight falls with the square.
constexpr double outlier_scales = 2.5;
// A slightly wrong shape or sampling shows at steep places first: they may be this far off
// (samples).
constexpr double edge_tolerance = 0.1;
constexpr double residual_scale_min = 0.7;  // grey levels; rounding alone gives 0.4

// Only keeps the normal matrix of a patch with structure in one direction regular.
constexpr double place_sigma_rad = 0.1;

// A plane's values are smooth: of the camera's white noise variance 0.09 is left and neighbours are
// alike, so that summing over all pixels of an edge gains less than independent residuals would:
// 7.9 times by the kernel's energy and, across the edge, that of a Gaussian of the same variance; 6
// in Monte Carlo, where the residuals also hold the sampling's misfit. Taking every n-th pixel
// divides that, down to 1.
constexpr double noise_correlation = 6.0;

// Three axes with the reference ray last.
Eigen::Matrix3d axes_about(const Eigen::Vector3d& ray) {
  Eigen::Matrix3d axes;
  axes.col(2) = ray.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

// d pixel of the ray / d turn about the first two axes.
Eigen::Matrix2d pixel_by_turn(const geometry::CameraModel& camera, const Eigen::Vector3d& ray,
                              const Eigen::Matrix3d& axes) {
  const Eigen::Vector2d normalised = ray.hnormalized();
  Eigen::Matrix2d normalised_by_turn;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d ray_by_turn = axes.col(k).cross(ray) / ray.z();
    normalised_by_turn.col(k) = ray_by_turn.head<2>() - ray_by_turn.z() * normalised;
  }
  return geometry::pixel_jacobian(camera, normalised) * normalised_by_turn;
}

}  // namespace

void WarpRefinement::reserve(std::size_t samples) {
  pixels_.reserve(samples);
  jacobians_.reserve(samples);
  for (auto* values : {&seen_, &slope2_, &scratch_}) values->reserve(samples);
}

// Reads view 2 at every warped sample, with the derivatives by the geometric unknowns. Returns how
// many samples are visible.
int WarpRefinement::linearise(const Problem& problem, const PatchWarp& warp,
                              const Eigen::Matrix3d& axes) {
  const auto& [level, plane, motion, camera] = problem;
  const Eigen::Matrix3d homography = motion.homography(warp);
  const Eigen::Matrix3d unscaled = warp.turn * motion.plane_homography(warp);
  const Eigen::Vector3d baseline = warp.turn * motion.cam2_from_cam1.translation;
  const double size = std::exp(warp.log_scale);
  const std::size_t count = level.samples.size();
  pixels_.assign(count, geometry::Pixel::Constant(std::numeric_limits<double>::quiet_NaN()));
  seen_.assign(count, std::numeric_limits<float>::quiet_NaN());
  slope2_.resize(count);
  jacobians_.resize(count);
  int visible = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PatchSample& sample = level.samples[i];
    const Eigen::Vector3d ray = homography * sample.normalised.homogeneous();
    if (!(ray.z() > 0.0)) continue;
    const Eigen::Vector2d normalised = ray.hnormalized();
    const geometry::Pixel pixel = geometry::pixel_of(camera, normalised);
    const Eigen::Vector2d at = plane.to_samples(pixel);
    if (!camera.contains(pixel, sample_border_px) || !plane.readable(at)) continue;
    const PlaneSample read = plane.read(at);
    ++visible;
    pixels_[i] = pixel;
    seen_[i] = read.value;
    slope2_[i] = read.dx * read.dx + read.dy * read.dy;
    // d value / d ray, then by each unknown's effect on the ray.
    const Eigen::RowVector2d by_pixel = Eigen::RowVector2d(read.dx, read.dy) / plane.step_px;
    const Eigen::RowVector2d by_normalised =
        by_pixel * geometry::pixel_jacobian(camera, normalised);
    const Eigen::Vector3d by_ray =
        Eigen::Vector3d(by_normalised.x(), by_normalised.y(), -by_normalised.dot(normalised)) /
        ray.z();
    const Eigen::Vector2d offset = size * (sample.normalised - motion.reference);
    Vector& jacobian = jacobians_[i];
    jacobian.head<2>() = axes.leftCols<2>().transpose() * ray.cross(by_ray);
    jacobian[2] = by_ray.dot(unscaled.leftCols<2>() * offset);
    jacobian.segment<2>(3) = by_ray.dot(baseline) * offset;
    jacobian[5] = -sample.value;
    jacobian[6] = -1.0;
  }
  return visible;
}

// The correlation; gain and bias by linear regression when they are not known yet.
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
  if (fit_gain) {
    gain_ = spread_1 > 0.0 ? common / spread_1 : 0.0;
    bias_ = (sum_2 - gain_ * sum_1) / n;
  }
  correlation_ = spread_1 > 0.0 && spread_2 > 0.0 ? common / std::sqrt(spread_1 * spread_2) : 0.0;
}

WarpRefinement::Normal WarpRefinement::accumulate(const PatchLevel& level) {
  const auto residual = [&](std::size_t i) {
    return seen_[i] - gain_ * static_cast<double>(level.samples[i].value) - bias_;
  };
  scratch_.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (!std::isnan(seen_[i])) scratch_.push_back(static_cast<float>(std::abs(residual(i))));
  }
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
  std::nth_element(scratch_.begin(), middle, scratch_.end());
  const double scale = std::max(residual_scale_min, 1.4826 * static_cast<double>(*middle));

  Normal normal;
  double weight_sum = 0.0, weighted_squares = 0.0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (std::isnan(seen_[i])) continue;
    const double r = residual(i);
    const double limit2 = outlier_scales * outlier_scales *
                          (scale * scale + edge_tolerance * edge_tolerance * slope2_[i]);
    const double weight = r * r > limit2 ? limit2 / (r * r) : 1.0;
    const Vector weighted = weight * jacobians_[i];
    for (int k = 0; k < unknowns; ++k) normal.matrix.col(k) += jacobians_[i][k] * weighted;
    normal.right_side -= r * weighted;
    weight_sum += weight;
    weighted_squares += weight * r * r;
  }
  // As if the residuals were independent: what their likeness takes is in the variance.
  normal.variance = std::max(1.0, noise_correlation / level.edge_stride) *
                    std::max(weighted_squares / std::max(weight_sum - unknowns, 1.0),
                             residual_scale_min * residual_scale_min);
  return normal;
}

// Adds what is known beforehand about the warp, with the residuals' variance as the unit.
void WarpRefinement::add_prior(const WarpPrior& prior, const PatchWarp& warp, Normal& normal) {
  Vector information = Vector::Zero(), deviation = Vector::Zero();
  information << Eigen::Vector2d::Constant(std::pow(place_sigma_rad, -2)),
      std::pow(prior.log_scale_sigma, -2),
      Eigen::Vector2d::Constant(std::pow(prior.slope_sigma_per_m, -2)), 0.0, 0.0;
  deviation[2] = warp.log_scale;
  deviation.segment<2>(3) = warp.slope_per_m;
  normal.matrix.diagonal() += normal.variance * information;
  normal.right_side -= normal.variance * information.cwiseProduct(deviation);
}

void WarpRefinement::take_step(const Vector& step, const Eigen::Matrix3d& axes, PatchWarp& warp) {
  warp.turn = rotation_by(axes.leftCols<2>() * step.head<2>()) * warp.turn;
  warp.log_scale += step[2];
  warp.slope_per_m += step.segment<2>(3);
  gain_ += step[5];
  bias_ += step[6];
}

WarpFit WarpRefinement::run(const PatchLevel& level, const PlaneLevel& plane_2,
                            const PatchMotion& motion, const geometry::CameraModel& camera,
                            const WarpPrior& prior, const PatchWarp& start) {
  const Problem problem{level, plane_2, motion, camera};
  const double samples_per_rad = camera.focal_px.mean() / plane_2.step_px;
  WarpFit fit;
  fit.warp = start;
  for (int iteration = 0; iteration < fit_iterations_max; ++iteration) {
    const Eigen::Vector3d ray = motion.homography(fit.warp) * motion.reference.homogeneous();
    if (!(ray.z() > 0.0)) return fit;
    const Eigen::Matrix3d axes = axes_about(ray);
    const int visible = linearise(problem, fit.warp, axes);
    fit.visible = static_cast<double>(visible) / static_cast<double>(level.samples.size());
    if (visible < visible_samples_min) return fit;
    correlate(level, iteration == 0);
    fit.gain = gain_;
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
    fit.converged = length < step_tolerated;
    const bool done = length < fit_step_converged && sigmas < sigmas_converged;
    if (done || iteration + 1 == fit_iterations_max) {
      // Of the covariance of all unknowns the first two rows and columns.
      Eigen::Matrix<double, unknowns, 2> of_turn = Eigen::Matrix<double, unknowns, 2>::Identity();
      geometry::solve_factorised(factors, of_turn);
      const Eigen::Matrix2d by_turn = pixel_by_turn(camera, ray, axes);
      fit.covariance_px2 = normal.variance * by_turn * of_turn.topRows<2>() * by_turn.transpose();
    }
    if (length > fit_step_max) step *= fit_step_max / length;
    take_step(step, axes, fit.warp);
    if (done) break;
  }
  return fit;
}

}  // namespace gazed::tracking
