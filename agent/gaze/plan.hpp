// Who chooses where to look next.
#pragma once

#include <cstdint>

namespace gazed::gaze {

/// The report's step rule, or after its first move the planner.
enum class Plan : std::uint8_t { report, parallax };

}  // namespace gazed::gaze
