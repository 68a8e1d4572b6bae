#include "agent/tracking/rim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gazed::tracking {

namespace {

// Step along the profile across the outline.
constexpr double profile_step_px = 0.5;
constexpr int profile_max = 65;  // 2 (3 + 1.6 * 8) px
constexpr double profile_reach_px = 3.0;
// A mask's outline is accurate to this many cells.
constexpr double profile_reach_cells = 1.5;
// The plane's value must change by at least this much across an edge.
constexpr double edge_contrast_min = 8.0;
// Half width of an edge in units of its blur: farther out is only background, farther in only
// object.
constexpr double edge_half_width = 3.0;
// Distance, in samples, between background places; noise of nearer ones is correlated.
constexpr double behind_step = 2.0;
// The minimum is the plane's own smoothing and the pixels' size; anything wider than three times
// that is not an edge.
constexpr double blur_min_px = 0.9, blur_max_px = 3.0;

double standard_normal_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

void Rim::find(const ObjectMask& object, const PlaneLevel& plane) {
  count_ = 0;
  const std::size_t cells = object.outline_cells();
  const std::size_t stride = (cells + points_max - 1) / points_max;
  std::size_t number = 0;
  object.for_outline([&](const geometry::Pixel& centre, const Eigen::Vector2d& outward) {
    if (number++ % stride != 0) return;
    add(centre, outward, profile_reach_px + profile_reach_cells * object.cell_px(), plane);
  });
  if (count_ == 0) return;
  const auto middle = blurs_px_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
  std::nth_element(blurs_px_.begin(), middle,
                   blurs_px_.begin() + static_cast<std::ptrdiff_t>(count_));
  spacing_px_ = static_cast<double>(stride) * object.cell_px();
  blur_px_ = std::clamp(*middle, blur_min_px, blur_max_px);
}

bool Rim::add(const geometry::Pixel& centre, const Eigen::Vector2d& outward, double reach_px,
              const PlaneLevel& plane) {
  std::array<double, profile_max> values;
  const int half = std::min(static_cast<int>(reach_px / profile_step_px), (profile_max - 1) / 2);
  for (int i = -half; i <= half; ++i) {
    const Eigen::Vector2d at = plane.to_samples(centre + i * profile_step_px * outward);
    if (!plane.readable(at)) return false;
    values[static_cast<std::size_t>(i + half)] = static_cast<double>(plane.read(at).value);
  }
  const auto slope = [&](int i) {
    return (values[static_cast<std::size_t>(i + 1)] - values[static_cast<std::size_t>(i - 1)]) /
           (2.0 * profile_step_px);
  };
  int steepest = 1;
  for (int i = 2; i < 2 * half; ++i) {
    if (std::abs(slope(i)) > std::abs(slope(steepest))) steepest = i;
  }
  if (steepest <= 1 || steepest >= 2 * half - 1) return false;
  // Vertex of the parabola through three slopes.
  const double before = std::abs(slope(steepest - 1)), at = std::abs(slope(steepest)),
               after = std::abs(slope(steepest + 1));
  const double bend = before - 2.0 * at + after;
  const double vertex = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  // Follow the value to either side while it goes on in the same direction.
  const auto end = [&](int direction) {
    int i = steepest;
    while (i > 1 && i < 2 * half - 1 && slope(i) * slope(steepest) > 0.05 * at * at) i += direction;
    return values[static_cast<std::size_t>(i)];
  };
  const double contrast = std::abs(end(1) - end(-1));
  if (contrast < edge_contrast_min || count_ == points_max) return false;
  points_[count_] = {
      centre + (steepest - half + std::clamp(vertex, -1.0, 1.0)) * profile_step_px * outward,
      outward};
  // The peak density of a normal distribution is 1 / (sqrt(2 pi) sigma).
  blurs_px_[count_] = contrast / (at * std::sqrt(2.0 * std::numbers::pi));
  ++count_;
  return true;
}

std::optional<Rim::Place> Rim::place(const geometry::Pixel& pixel, int step_px) const {
  const double blur_px = blur_on_level_px(step_px);
  double nearest2 = std::numeric_limits<double>::max();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double distance2 = (points_[i].edge - pixel).squaredNorm();
    if (distance2 >= nearest2) continue;
    nearest2 = distance2;
    nearest = i;
  }
  const double reach_px = 2.0 * edge_half_width * blur_px + spacing_px_;
  if (nearest2 > reach_px * reach_px) return std::nullopt;
  const RimPoint& point = points_[nearest];
  const double outside_px = (pixel - point.edge).dot(point.outward);
  return Place{static_cast<std::uint16_t>(nearest), standard_normal_below(outside_px / blur_px)};
}

geometry::Pixel Rim::behind(const RimPoint& point, int place, int step_px) const {
  constexpr int middle = (places_behind - 1) / 2;
  const double along_px = behind_step * step_px * (place - middle);
  return point.edge + edge_half_width * blur_on_level_px(step_px) * point.outward +
         along_px * Eigen::Vector2d(-point.outward.y(), point.outward.x());
}

// Each reduction smooths by [1 4 6 4 1]/16, a variance of one squared sample; reading adds a third
// of one.
double Rim::blur_on_level_px(int step_px) const {
  double variance = blur_px_ * blur_px_;
  for (int step = 1; step < step_px; step *= 2) variance += 2.0 * step * step;
  return std::sqrt(variance);
}

}  // namespace gazed::tracking
