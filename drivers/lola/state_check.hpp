// Whether a state of the robot is one in which its joints may be told anything.
#pragma once

#include <string>

#include "drivers/lola/body.hpp"

namespace gazed {

/// Why these are no values of a NAO's joints and torso: not finite, or beyond what the widest joint
/// can do. Empty when they are.
[[nodiscard]] std::string implausible(const LolaState& state);

/// How far the torso leans from upright, 0 to pi.
[[nodiscard]] double torso_tilt_rad(const LolaState& state);

/// Which joint that is to be held stiff is far from where it is to be held; empty when none is.
/// The head's two are not looked at.
[[nodiscard]] std::string out_of_place(const LolaState& state, const LolaOrder& held);

}  // namespace gazed
