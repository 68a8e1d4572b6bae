// Frames drawn by integer arithmetic, so that they are the same bytes on every target.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "agent/base/image.hpp"

namespace gazed::saliency::frames {

using Colour = std::array<std::uint8_t, 3>;  // r, g, b

inline constexpr Colour red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, yellow{255, 255, 0},
    black{0, 0, 0}, white{255, 255, 255}, grey{128, 128, 128};

/// An rgb24 frame that starts out in one colour.
class Canvas {
 public:
  Canvas(int width_px, int height_px, const Colour& colour);

  Canvas& disc(int x, int y, int radius_px, const Colour& colour);
  Canvas& rectangle(int x, int y, int width_px, int height_px, const Colour& colour);
  /// Adds to each byte the sum of 4 independent uniform numbers in [-amplitude, amplitude]:
  /// standard deviation sqrt(4/3 amplitude (amplitude + 1)), 1.6 for 1 and
  /// 2.8 for 2.
  Canvas& noise(int amplitude, std::uint64_t seed);
  /// Every byte falls off with the distance from the centre, to 1 - percent/100 in the corners.
  Canvas& vignette(int percent);
  /// Every byte falls off from left to right, to 1 - percent/100 at the right border.
  Canvas& shade_to_the_right(int percent);

  [[nodiscard]] base::ImageView view() const;
  [[nodiscard]] std::uint8_t* pixel(int x, int y);

 private:
  int width_px_;
  int height_px_;
  std::vector<std::uint8_t> bytes_;
};

/// The same picture as YUYV, BT.601 limited range; chroma is that of the even pixel. Even width.
[[nodiscard]] std::vector<std::uint8_t> yuyv_of(const base::ImageView& rgb);
[[nodiscard]] base::ImageView yuyv_view(const std::vector<std::uint8_t>& bytes, int width_px,
                                        int height_px);

struct NamedFrame {
  std::string name;
  Canvas canvas;
};

/// What the saliency stage is compared with its reference on: objects, edges, displays, noise.
[[nodiscard]] std::vector<NamedFrame> drawn_frames();

/// Displays of grey items that differ by a few grey levels, one of them with a touch of colour.
[[nodiscard]] std::vector<NamedFrame> near_grey_displays();

}  // namespace gazed::saliency::frames
