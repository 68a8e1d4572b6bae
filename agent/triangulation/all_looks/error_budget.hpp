// What each cause of error costs: how much of the variance of the answer's inverse range is its.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

enum class Cause : std::uint8_t {
  encoders,
  joint_zeros,
  focal_length,
  image_centre,
  distortion,
  mount_offset,
  mount_rotation,
  torso_motion,
  rolling_shutter,
  target_pixels,
  background_pixels,
};
inline constexpr std::size_t cause_count = 11;

/// "encoders", "joint zeros", ...
[[nodiscard]] std::string_view name(Cause cause);

/// Of independent causes: the variances add up to that of the inverse range. A cause that the looks
/// themselves tell of (the background shows the head's true angles) costs what is left of it.
struct ErrorBudget {
  std::array<double, cause_count> variance_per_m2;  // by Cause; NaN where there is no answer

  ErrorBudget() { variance_per_m2.fill(not_a_number); }
  [[nodiscard]] double of(Cause cause) const {
    return variance_per_m2[static_cast<std::size_t>(cause)];
  }
};

}  // namespace gazed::triangulation::all_looks
