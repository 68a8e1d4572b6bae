#include "agent/triangulation/all_looks/error_budget.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>

#include "agent/triangulation/all_looks/target.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// The cause that an unknown belongs to.
Cause cause_of(const Problem& problem, int unknown) {
  const int calibration = unknown - problem.calibration_at();
  if (calibration < 0) {
    const bool is_sweep = unknown % look_unknowns < reading_of(0);
    return is_sweep ? Cause::rolling_shutter : Cause::encoders;
  }
  if (calibration >= calibration_count) return Cause::torso_motion;
  if (calibration >= zero_at) return Cause::joint_zeros;
  if (calibration >= rotation_at) return Cause::mount_rotation;
  if (calibration >= offset_at) return Cause::mount_offset;
  if (calibration >= distortion_at) return Cause::distortion;
  return calibration >= centre_at ? Cause::image_centre : Cause::focal_length;
}

}  // namespace

std::string_view name(Cause cause) {
  constexpr std::array<std::string_view, cause_count> names{
      "encoders",        "joint zeros",   "focal length",     "image centre",
      "distortion",      "lever arm",     "mount rotation",   "torso motion",
      "rolling shutter", "target pixels", "background pixels"};
  return names[static_cast<std::size_t>(cause)];
}

ErrorBudget target_budget(const Problem& problem, const State& state, Solver& solver) {
  Eigen::Vector3d by_target;
  for (int i = 0; i < 3; ++i) {
    by_target(i) = inverse_range_error(state.target, Eigen::Vector3d::Unit(i));
  }
  // How much the answer follows an unknown's prior, all in standard deviations.
  const Vector gain = solver.covariance().rightCols<3>().lazyProduct(by_target);

  ErrorBudget out;
  out.variance_per_m2.fill(0.0);
  const auto add = [&out](Cause cause, double variance_per_m2) {
    out.variance_per_m2[static_cast<std::size_t>(cause)] += variance_per_m2;
  };
  for (int i = 0; i < problem.robot_unknowns(); ++i) {
    add(cause_of(problem, i), gain(i) * gain(i));
  }
  for (std::size_t k = 0; k < problem.looks; ++k) {
    if (!contains(problem.target_kept, k)) continue;
    const Eigen::Vector2d by_pixel = solver.target_row(k).lazyProduct(gain);
    add(Cause::target_pixels, by_pixel.squaredNorm());
  }
  // The features were eliminated: their part is what is left.
  const double so_far =
      std::accumulate(out.variance_per_m2.begin(), out.variance_per_m2.end(), 0.0);
  add(Cause::background_pixels, std::max(0.0, by_target.dot(gain.tail<3>()) - so_far));
  return out;
}

}  // namespace gazed::triangulation::all_looks
