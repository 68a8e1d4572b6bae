// Predicts what one more look would be worth.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "agent/geometry/cholesky.hpp"
#include "agent/triangulation/all_looks/estimation.hpp"
#include "agent/triangulation/all_looks/torso_level.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Where a look without reading error or sweep would see a point; none if outside the image.
std::optional<geometry::Pixel> expected_pixel(const Robot& robot, std::size_t look,
                                              const geometry::InverseDepthPoint& point) {
  PointInLook seen;
  if (!robot.see_at_target_row(look, point, seen) || !robot.camera().contains(seen.pixel)) {
    return std::nullopt;
  }
  return seen.pixel;
}

}  // namespace

/// Adds a look that has not seen anything yet. Its unknowns stay at their prior.
void Estimation::make_room_for_a_look(geometry::HeadAngles next) {
  if (problem_.torso.may_move()) set_torso(torso_of_another_look(problem_), problem_, state_);
  const Vector before = state_.robot;
  const int calibration_before = problem_.calibration_at(), torso_before = problem_.torso_of(1);
  const std::size_t look = problem_.looks++;
  problem_.measured[look] = next;
  problem_.sweep[look] = {};
  problem_.sweep_sigma_rad[look] = problem_.sweep_sigma_rad[look - 1];
  state_.robot.setZero(problem_.robot_unknowns());
  state_.robot.head(calibration_before) = before.head(calibration_before);
  state_.robot.segment<calibration_count>(problem_.calibration_at()) =
      before.segment<calibration_count>(calibration_before);
  const Eigen::Index torso_unknowns_before = before.size() - torso_before;
  state_.robot.segment(problem_.torso_of(1), torso_unknowns_before) =
      before.tail(torso_unknowns_before);
  anchor_sweeps(state_.robot, problem_);
}

/// Adds features that only look 1 saw, which may come into view again. Their depths are unknown,
/// like those of the others.
void Estimation::add_features_unseen(std::span<const FeatureObservations> features) {
  std::array<bool, features_max> has{};
  double inverse_depths_per_m = 0.0;
  const std::size_t known = problem_.feature_count;
  for (std::size_t i = 0; i < known; ++i) {
    has[static_cast<std::size_t>(problem_.features[i].observed - features.data())] = true;
    inverse_depths_per_m += state_.features[i].inverse_depth_per_m;
  }
  if (known == 0) return;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto direction = geometry::normalise(problem_.rig.camera, features[i].pixel[0]);
    if (has[i] || !direction) continue;
    const std::size_t index = problem_.feature_count++;
    problem_.features[index] = {.observed = &features[i],
                                .sigma_px = problem_.features[0].sigma_px,
                                .seen = only_look(0),
                                .kept = only_look(0)};
    state_.features[index] = {*direction, inverse_depths_per_m / static_cast<double>(known)};
  }
}

double Estimation::expected_sigma_per_m(geometry::HeadAngles next,
                                        std::span<const FeatureObservations> features) {
  std::size_t last = problem_.looks - 1;  // the last look that saw the target
  while (last > 0 && !contains(problem_.target_kept, last)) --last;
  const std::size_t look = problem_.looks;
  make_room_for_a_look(next);
  const Robot robot(problem_, state_.robot);
  const auto target = expected_pixel(robot, look, state_.target);
  if (!target) return not_a_number;
  problem_.target[look] = problem_.target[last];
  problem_.target[look].pixel = *target;
  problem_.row_px[look] = target->y();
  problem_.target_kept |= only_look(look);

  add_features_unseen(features);
  std::array<FeatureObservations, features_max> observed;
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    Problem::Feature& feature = problem_.features[i];
    if (feature.kept == 0) continue;
    const auto pixel = expected_pixel(robot, look, state_.features[i]);
    if (!pixel) {
      if (feature.kept == only_look(0)) feature.kept = 0;
      continue;
    }
    observed[i] = *feature.observed;
    observed[i].pixel[look] = *pixel;
    feature.observed = &observed[i];
    feature.kept |= only_look(look);
  }
  if (!solver_.make_information()) return not_a_number;
  Vector by_unknowns = Vector::Zero(problem_.unknowns());
  for (int i = 0; i < 3; ++i) {
    by_unknowns(problem_.robot_unknowns() + i) =
        inverse_range_error(state_.target, Eigen::Vector3d::Unit(i));
  }
  Vector spread = by_unknowns;
  geometry::solve_factorised(solver_.factors(), spread);
  return std::sqrt(by_unknowns.dot(spread));
}

}  // namespace gazed::triangulation::all_looks
