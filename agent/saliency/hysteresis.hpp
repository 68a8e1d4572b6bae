// Hysteresis of the winner. Noise makes one or the other of two nearly equal peaks the larger; with
// hysteresis the previous winner stays until a rival is clearly higher.
#pragma once

#include <cstdint>

#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

inline constexpr int margin_fraction_bits = 16;

/// Follows the previous winner to its current peak: the largest of the 9 samples at `previous_px`,
/// or the summit uphill from there, so a target is followed as long as it moves by less than its
/// own size per frame. It wins unless the map's largest sample exceeds it by more than `margin`, a
/// share of it in Q16. A rival also wins if the previous place is outside the frame. Uses integers
/// only.
[[nodiscard]] Winner find_winner(const SaliencyPlane& map, const geometry::Pixel& previous_px,
                                 std::int32_t margin);

}  // namespace gazed::saliency
