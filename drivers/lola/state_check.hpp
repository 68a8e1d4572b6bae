// Whether a state of the robot is one in which its joints may be told anything.
#pragma once

#include <string>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

/// Why these cannot be the values of a NAO's joints and torso: not finite, beyond what the widest
/// joint or the head can do, or a head as cold or hot as no motor is. Empty when they are.
[[nodiscard]] std::string implausible(const LolaState& state);

/// How far the torso leans from upright, 0 to pi.
[[nodiscard]] double torso_tilt_rad(const LolaState& state);

/// Which joint has moved or been given another stiffness since `before`; empty when none has.
[[nodiscard]] std::string changed_since(const LolaState& before, const LolaState& state);

/// Which joint that is to be held stiff is far from where it is to be held, or was made softer
/// meanwhile; empty when none is.
/// The head's two are not looked at.
[[nodiscard]] std::string out_of_place(const LolaState& state, const LolaOrder& held);

}  // namespace gazed::lola
