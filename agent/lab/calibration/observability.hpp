// What the pictures tell about each parameter, and what they cannot: standard deviations, and the
// directions in which the answer is the prior's.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

/// A direction in the space of the parameters about which the pictures say little.
struct WeakDirection {
  std::string name;
  /// Of the information along it, what comes from the pictures; the rest is the prior. In [0, 0.5].
  double data_share = 0.0;
};
/// Below this share the prior is all there is: the direction is unobservable.
constexpr double unobservable_share = 0.05;

struct Certainty {
  Parameters sigma = Parameters::Zero();  // 0 for what was held
  /// The same with the joints' zeros held: a turned zero is taken up by a turned mount, so that
  /// only one of the two may be uncertain for it.
  Parameters sigma_given_zeros = Parameters::Zero();
  std::vector<WeakDirection> weak;  // the least known first
};

/// `information`: of the free parameters of `prior`, from the pictures alone (BundleResult).
/// The directions are those of the eigenvectors of the information in units of the prior's, so that
/// they are found, not presumed; the known gauges of a head only lend their names: a constant zero
/// of yaw turns the world with the robot, one of pitch is taken up by the mount, the size of a
/// scene that nobody measured follows the length of the arm.
[[nodiscard]] Certainty certainty_of(const Eigen::MatrixXd& information, const Prior& prior,
                                     const Parameters& estimate);

/// Of a matrix whose eigenvalues are not negative: those that are zero but for rounding stay zero.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace gazed::lab::calibration
