#include "agent/triangulation/methods/lindstrom.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "agent/geometry/epipolar.hpp"

namespace gazed::triangulation::methods {

namespace {

/// Two image points as one vector: (point 1, point 2).
using Points = Eigen::Vector4d;

/// The epipolar constraint q(x) = x2^T E x1 of two image points, a quadric in four dimensions.
class Constraint {
 public:
  explicit Constraint(const Eigen::Matrix3d& e) : e_(e) {}

  [[nodiscard]] double value(const Points& x) const {
    return x.tail<2>().homogeneous().dot(e_ * x.head<2>().homogeneous());
  }
  [[nodiscard]] Points gradient(const Points& x) const {
    Points out;
    out << (e_.transpose() * x.tail<2>().homogeneous()).head<2>(),
        (e_ * x.head<2>().homogeneous()).head<2>();
    return out;
  }
  /// The constant second derivative times `x`.
  [[nodiscard]] Points curve(const Points& x) const {
    Points out;
    out << e_.topLeftCorner<2, 2>().transpose() * x.tail<2>(),
        e_.topLeftCorner<2, 2>() * x.head<2>();
    return out;
  }
  /// An upper bound of the largest eigenvalue of the second derivative.
  [[nodiscard]] double curvature() const { return e_.topLeftCorner<2, 2>().norm(); }

 private:
  Eigen::Matrix3d e_;
};

/// A correction with `step` = -multiplier * gradient at its end, which holds at the optimum.
struct Correction {
  Points step;
  double multiplier;
};

/// Lindstrom 2010, listing 3.
Correction two_iterations(const Constraint& constraint, const Points& measured) {
  Points n = constraint.gradient(measured);
  const double c = constraint.value(measured);
  const double a = 0.5 * n.dot(constraint.curve(n));
  const double b = 0.5 * n.squaredNorm();
  const double d = std::sqrt(b * b - a * c);
  const double first = c / (b + d);
  n -= first * constraint.curve(n);
  const double second = first * 2.0 * d / n.squaredNorm();
  return {-second * n, second};
}

/// With one quadratic constraint, a stationary point is the global minimum if the Lagrangian's
/// second derivative, I + multiplier * curvature, is positive definite (Boyd and Vandenberghe 2004,
/// B.1).
bool is_the_minimum(const Constraint& constraint, const Points& measured,
                    const Correction& correction) {
  constexpr double least_eigenvalue = 0.5;
  // Relative to the step; their squares are the relative excess of the cost.
  constexpr double most_off_direction = 1e-4, most_off_surface = 1e-7;
  // Relative rounding error of an image point.
  constexpr double rounding = 1e-15;
  if (!(std::abs(correction.multiplier) * constraint.curvature() <= 1.0 - least_eigenvalue)) {
    return false;
  }
  const Points corrected = measured + correction.step;
  const Points n = constraint.gradient(corrected);
  const double length = correction.step.norm();
  const double off_surface = std::abs(constraint.value(corrected)) / n.norm();
  const double off_direction = (correction.step + correction.multiplier * n).norm();
  return off_surface <= most_off_surface * length + rounding &&
         off_direction <= most_off_direction * length + rounding;
}

}  // namespace

std::optional<CorrectedPair> correct_in_two_iterations(const geometry::Pose& cam2_from_cam1,
                                                       const Eigen::Vector2d& point_1,
                                                       const Eigen::Vector2d& point_2) {
  const Constraint constraint(geometry::essential_matrix(cam2_from_cam1).normalized());
  const Points measured = (Points() << point_1, point_2).finished();
  const Correction correction = two_iterations(constraint, measured);
  if (!is_the_minimum(constraint, measured, correction)) {
    return correct_optimally(cam2_from_cam1, point_1, point_2);
  }
  const Points corrected = measured + correction.step;
  return CorrectedPair{.point_1 = corrected.head<2>(),
                       .point_2 = corrected.tail<2>(),
                       .cost = correction.step.squaredNorm()};
}

}  // namespace gazed::triangulation::methods
