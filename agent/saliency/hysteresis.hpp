// Hysteresis of the winner. Noise makes now one and now the other of two nearly equal peaks the
// larger; with hysteresis the place that won before wins until a rival is clearly higher.
#pragma once

#include <cstdint>

#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

inline constexpr int margin_fraction_bits = 16;

/// The peak that the previous winner has become: the largest of the 9 samples at `previous_px`, or
/// the summit that the way up from there leads to. So a target is followed as long as it moves by
/// less than its own size from one frame to the next. It wins unless the map's largest sample
/// exceeds it by more than `margin`, a share of it in Q16; a rival wins also when the previous
/// place is outside the frame. Integers throughout.
[[nodiscard]] Winner find_winner(const SaliencyPlane& map, const geometry::Pixel& previous_px,
                                 std::int32_t margin);

}  // namespace gazed::saliency
