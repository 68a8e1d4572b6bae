#include "agent/geometry/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gazed::geometry {

namespace {

// HeadYaw and HeadPitch of the NAO's URDF (119.5, -38.5 and 29.5 degrees); the joint page rounds
// them to 2.0857, -0.6720 and 0.5149.
constexpr double joint_yaw_max_rad = 2.08567;
constexpr AngleRange joint_pitch_rad{-0.671952, 0.514872};

struct Row {
  double yaw_rad;
  AngleRange pitch;
};

// Aldebaran documentation 2.5, "Joints", anti-collision limitation of the head, the same in
// B-Human's headLimits.cfg: limits at +-yaw, linear between the rows.
constexpr std::array<Row, 7> rows{{{0.0, {-0.671951, 0.515047}},
                                   {0.486074, {-0.671951, 0.422021}},
                                   {0.756077, {-0.548033, 0.370010}},
                                   {0.903033, {-0.479965, 0.330041}},
                                   {1.089958, {-0.430049, 0.300022}},
                                   {1.526988, {-0.330041, 0.200015}},
                                   {2.086017, {-0.449073, 0.330041}}}};

constexpr auto break_yaws = [] {
  std::array<double, 2 * rows.size() - 1> yaws{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    yaws[rows.size() - 1 - i] = -rows[i].yaw_rad;
    yaws[rows.size() - 1 + i] = rows[i].yaw_rad;
  }
  return yaws;
}();

AngleRange table_pitch_range(double yaw_rad) {
  const double yaw = std::abs(yaw_rad);
  if (!(yaw < rows.back().yaw_rad)) return rows.back().pitch;
  const Row* after =
      std::upper_bound(rows.begin(), rows.end(), yaw,
                       [](double value, const Row& row) { return value < row.yaw_rad; });
  const Row* before = after - 1;
  const double part = (yaw - before->yaw_rad) / (after->yaw_rad - before->yaw_rad);
  return {std::lerp(before->pitch.min_rad, after->pitch.min_rad, part),
          std::lerp(before->pitch.max_rad, after->pitch.max_rad, part)};
}

}  // namespace

HeadLimits::HeadLimits(double margin_rad) : margin_rad_(margin_rad) {
  if (!(margin_rad >= 0.0 && margin_rad <= max_margin_rad)) {
    throw std::invalid_argument("head limits: margin is " + std::to_string(margin_rad) +
                                " rad, allowed is 0 to " + std::to_string(max_margin_rad));
  }
}

AngleRange HeadLimits::yaw_range() const {
  return {-joint_yaw_max_rad + margin_rad_, joint_yaw_max_rad - margin_rad_};
}

AngleRange HeadLimits::pitch_range(double yaw_rad) const {
  const AngleRange table = table_pitch_range(yaw_rad);
  return {std::max(table.min_rad, joint_pitch_rad.min_rad) + margin_rad_,
          std::min(table.max_rad, joint_pitch_rad.max_rad) - margin_rad_};
}

bool HeadLimits::contains(HeadAngles angles) const {
  return yaw_range().contains(angles.yaw_rad) &&
         pitch_range(angles.yaw_rad).contains(angles.pitch_rad);
}

bool HeadLimits::contains_segment(HeadAngles from, HeadAngles to) const {
  constexpr double rounding_rad = 1e-12;
  if (!contains(from) || !contains(to)) return false;
  const auto [left, right] = std::minmax(from.yaw_rad, to.yaw_rad);
  for (const double yaw : break_yaws) {
    if (yaw <= left || yaw >= right) continue;
    const double part = (yaw - from.yaw_rad) / (to.yaw_rad - from.yaw_rad);
    const double pitch = from.pitch_rad + part * (to.pitch_rad - from.pitch_rad);
    const AngleRange range = pitch_range(yaw);
    if (pitch < range.min_rad - rounding_rad || pitch > range.max_rad + rounding_rad) return false;
  }
  return true;
}

std::span<const double> HeadLimits::break_yaws_rad() {
  return break_yaws;
}

HeadAngles HeadLimits::clamp(HeadAngles angles) const {
  const AngleRange yaw = yaw_range();
  const double yaw_rad = std::clamp(angles.yaw_rad, yaw.min_rad, yaw.max_rad);
  const AngleRange pitch = pitch_range(yaw_rad);
  return {yaw_rad, std::clamp(angles.pitch_rad, pitch.min_rad, pitch.max_rad)};
}

}  // namespace gazed::geometry
