// Where a track looks next.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "agent/cycle/track.hpp"
#include "agent/gaze/step_rule.hpp"

namespace gazed::cycle {

namespace {

// The planner's next look must see the target wherever it may be, within this many sigmas of its
// likeliest place. If no look can, the likeliest place decides.
constexpr double planned_sigmas = 2.0;

}  // namespace

std::optional<gaze::PlannedTarget> Track::planned_target() const {
  const auto direction = geometry::normalise(rig_.camera, first().pixel);
  const double sigma_per_m = estimate_.inverse_range_sigma_per_m;
  if (!direction || !std::isfinite(estimate_.inverse_range_per_m) || !std::isfinite(sigma_per_m)) {
    return std::nullopt;
  }
  const double range_over_depth = direction->homogeneous().norm();
  const auto inverse_depth = [&](double sigmas) {
    const double inverse_range_per_m = estimate_.inverse_range_per_m + sigmas * sigma_per_m;
    return range_over_depth * std::clamp(inverse_range_per_m,
                                         1.0 / settings_.registration.range_max_m,
                                         1.0 / settings_.registration.range_min_m);
  };
  return gaze::PlannedTarget{.direction_1 = *direction,
                             .inverse_depth_per_m = inverse_depth(0.0),
                             .inverse_depth_min_per_m = inverse_depth(-planned_sigmas),
                             .inverse_depth_max_per_m = inverse_depth(planned_sigmas),
                             .half_size_px = registration_.half_size_px()};
}

/// None where the planner has none that is longer by the margin on both axes.
std::optional<geometry::HeadAngles> Track::most_informative_look(
    geometry::HeadAngles current) const {
  auto target = planned_target();
  if (!target) return std::nullopt;
  const gaze::PlannedHead robot{rig_, limits_, gaze::minimum_step_rad + move_margin_rad_};
  std::array<geometry::HeadAngles, triangulation::looks_max> heads;
  std::transform(looks_.begin(), looks_.end(), heads.begin(),
                 [](const triangulation::all_looks::Look& look) { return look.head; });
  const std::span<const geometry::HeadAngles> so_far = std::span(heads).first(looks_count_);
  if (const auto look = gaze::most_informative_look(robot, so_far, current, *target)) return look;
  target->inverse_depth_min_per_m = target->inverse_depth_max_per_m = target->inverse_depth_per_m;
  return gaze::most_informative_look(robot, so_far, current, *target);
}

geometry::HeadAngles Track::next_look(geometry::HeadAngles current) const {
  if (planned_ && planned_->from == current) return planned_->to;
  if (settings_.plan == gaze::Plan::parallax && views_taken_ >= 2) {
    if (const auto look = most_informative_look(current)) return *look;
  }
  const geometry::Pixel seen = last_.pixel.allFinite() ? last_.pixel : expected_pixel(current);
  return gaze::with_margin(limits_, current, gaze::next_look(rig_.camera, limits_, current, seen),
                           move_margin_rad_);
}

// Where the target should be seen with the head at `current`: at its range, or far away while that
// is unknown.
geometry::Pixel Track::expected_pixel(geometry::HeadAngles current) const {
  const auto direction = geometry::normalise(rig_.camera, first().pixel);
  if (!direction) return first().pixel;
  const double inverse_range_per_m = estimate_.inverse_range_per_m > 0.0
                                         ? estimate_.inverse_range_per_m
                                         : 1.0 / settings_.registration.range_max_m;
  const Eigen::Vector3d in_cam1_m = direction->homogeneous().normalized() / inverse_range_per_m;
  const geometry::Pose pose = geometry::cam2_from_cam1(rig_.head, first().head, current);
  return geometry::project(rig_.camera, pose * in_cam1_m).value_or(first().pixel);
}

std::optional<geometry::HeadAngles> Track::on_the_way_to(geometry::HeadAngles look,
                                                         geometry::HeadAngles current,
                                                         double overshoot_rad) const {
  if (settings_.plan == gaze::Plan::report) return std::nullopt;
  return gaze::approach_point(limits_, current, look, first_move_, overshoot_rad);
}

}  // namespace gazed::cycle
