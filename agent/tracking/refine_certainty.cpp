// Uncertainty of a fitted warp.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "agent/geometry/cholesky.hpp"
#include "agent/tracking/lower_triangle.hpp"
#include "agent/tracking/refine.hpp"
#include "agent/tracking/warp_reader.hpp"

namespace gazed::tracking {

namespace {

// Noise in a plane: variance of its slopes over variance of its values. The plane's filters act
// about like a Gaussian of variance v = 0.83, which gives 1 / (2 v).
constexpr double slope_by_value_noise = 0.6;
// One sample in this many is enough to estimate what the slopes' noise adds up to.
constexpr std::size_t noise_share_stride = 4;

}  // namespace

// Noise has slopes too. The normal matrix consists of squares, so these add up and look like
// structure; along a bare edge there is nothing else.
WarpRefinement::Matrix WarpRefinement::noise_share(const Problem& problem, const Reader& reader,
                                                   double slope_variance) const {
  Matrix share = Matrix::Zero();
  const double by_one = noise_share_stride * slope_variance;
  for (std::size_t i = 0; i < seen_.size(); i += noise_share_stride) {
    if (std::isnan(seen_[i])) continue;
    for (const Eigen::RowVector2d& slopes : {Eigen::RowVector2d(1, 0), Eigen::RowVector2d(0, 1)}) {
      Vector jacobian = reader.jacobian(problem.level.samples[i], slopes);
      jacobian.tail<2>().setZero();
      const Vector weighted = by_one * static_cast<double>(weights_[i]) * jacobian;
      add_lower_triangle(weighted, jacobian, share);
    }
  }
  return share;
}

// Let N be the normal matrix and T its part that is structure. The error of the solution is T^-1
// times a sum over the residuals whose covariance is proportional to N.
WarpRefinement::Covariance WarpRefinement::covariance(const Problem& problem, const Reader& reader,
                                                      const Normal& normal) const {
  using Columns = Eigen::Matrix<double, unknowns, 5>;
  // View 2's share of the residuals' variance.
  const double noise = normal.plain_variance / (1.0 + gain_ * gain_);
  const Matrix by_noise = noise_share(problem, reader, slope_by_value_noise * noise);
  for (const double share : {0.97, 0.9, 0.7, 0.0}) {
    Matrix factors = normal.matrix - share * by_noise;
    if (!geometry::factorise(factors)) continue;
    Columns columns = Columns::Zero();
    int column = 0;
    for (const int unknown : {0, 1, 3, 4, relief_at}) columns(unknown, column++) = 1.0;
    geometry::solve_factorised(factors, columns);
    const Columns scaled = normal.matrix * columns;
    const Covariance covariance = normal.variance * columns.transpose() * scaled;
    return 0.5 * (covariance + covariance.transpose());
  }
  return Covariance::Constant(std::numeric_limits<double>::quiet_NaN());
}

// Differences between neighbouring places: a change that is equal all around does not move the
// match.
double WarpRefinement::background_change() const {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const double change : behind_change_) {
    if (std::isnan(change)) continue;
    n += 1.0;
    sum += change;
    squares += change * change;
  }
  if (!(n > 0.0 && contrast_ > 0.0)) return 0.0;
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n))) / contrast_;
}

}  // namespace gazed::tracking
