// How much each cause of error contributes to the variance of the answer's inverse range.
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

/// The causes are independent, so their variances add up to that of the inverse range. If the looks
/// themselves measure a cause (the background shows the head's true angles), only what they leave
/// of it counts.
struct ErrorBudget {
  std::array<double, cause_count> variance_per_m2;  // by Cause; NaN without an answer

  ErrorBudget() { variance_per_m2.fill(not_a_number); }
  [[nodiscard]] double of(Cause cause) const {
    return variance_per_m2[static_cast<std::size_t>(cause)];
  }
};

}  // namespace gazed::triangulation::all_looks
