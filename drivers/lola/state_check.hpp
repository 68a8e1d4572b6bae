// Checks whether a robot's state allows orders to be sent to its joints.
#pragma once

#include <string>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

/// Why these cannot be the values of a NAO: not finite, beyond the range of the widest joint or of
/// the head, or an impossible temperature of the head's motors. Empty if plausible.
[[nodiscard]] std::string implausible(const LolaState& state);

/// Angle between the torso and upright, 0 to pi.
[[nodiscard]] double torso_tilt_rad(const LolaState& state);

/// The joint that has moved or changed its stiffness since `before`; empty if none has.
[[nodiscard]] std::string changed_since(const LolaState& before, const LolaState& state);

/// A joint that should be held stiff but is far from its place or was made softer; empty if there
/// is none. The head's joints are not checked.
[[nodiscard]] std::string out_of_place(const LolaState& state, const LolaOrder& held);

}  // namespace gazed::lola
