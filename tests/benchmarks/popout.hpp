// Pop-out displays: 24 items, one of which is not like the others.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "agent/geometry/camera.hpp"

#include "tests/unit/agent/saliency/frames.hpp"

namespace gazed::benchmarks {

/// In what the odd item differs.
enum class Oddity : std::uint8_t {
  hue,              // coloured items; the odd one has the opposite hue
  luminance,        // grey items lighter or darker than the ground; the odd one three times as much
  both,             // the opposite hue, and lighter or darker than the others
  hue_among_mixed,  // items of three hues, seven or eight of each; the odd one has a fourth
};
inline constexpr std::array oddities{Oddity::hue, Oddity::luminance, Oddity::both,
                                     Oddity::hue_among_mixed};
[[nodiscard]] std::string_view name(Oddity oddity);

struct PopOut {
  saliency::frames::Canvas canvas;
  geometry::Pixel odd_px;  // centre of the odd item
};

/// 640x480 at grey 128; discs 28 px across on a jittered 6x4 grid. Colours, places and the odd one
/// follow from the seed alone, by integer arithmetic: the same bytes on every target.
[[nodiscard]] PopOut popout_display(Oddity oddity, std::uint64_t seed);

/// True when a winner counts as the odd item: within 40 px of its centre.
[[nodiscard]] bool is_found(const PopOut& display, const geometry::Pixel& winner_px);

}  // namespace gazed::benchmarks
