#include "tests/benchmarks/room_frame.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gazed::benchmarks {

namespace {

// The room is laid out in units: 640 x 480 of them, whatever the frame's size.
constexpr int room_width = 640, room_height = 480;
using Rgb = std::array<int, 3>;

struct Box {
  int left, top, right, bottom;
  Rgb colour;
  int grain;  // how strong its texture is, grey levels

  [[nodiscard]] bool holds(int x, int y) const {
    return x >= left && x < right && y >= top && y < bottom;
  }
};

// Later boxes lie in front of earlier ones.
constexpr std::array boxes = {
    Box{0, 0, 640, 330, {186, 180, 164}, 14},     // wall
    Box{0, 318, 640, 330, {120, 92, 66}, 10},     // skirting board
    Box{40, 60, 170, 318, {132, 98, 64}, 26},     // door
    Box{150, 190, 158, 204, {190, 180, 120}, 4},  // its handle
    Box{250, 70, 350, 180, {226, 224, 214}, 6},   // poster
    Box{260, 84, 340, 130, {70, 104, 150}, 40},   // its picture
    Box{262, 142, 336, 146, {60, 60, 60}, 0},     // and its lines of text
    Box{262, 154, 326, 158, {60, 60, 60}, 0},     //
    Box{430, 120, 600, 130, {104, 76, 52}, 16},   // shelf
    Box{446, 78, 462, 120, {116, 44, 40}, 10},    // books
    Box{463, 70, 482, 120, {52, 84, 60}, 10},     //
    Box{484, 82, 498, 120, {60, 62, 96}, 10},     //
    Box{500, 74, 516, 120, {150, 134, 92}, 10},   //
    Box{430, 290, 600, 302, {150, 120, 84}, 16},  // table
    Box{444, 302, 454, 420, {110, 84, 58}, 10},   // and its legs
    Box{576, 302, 586, 420, {110, 84, 58}, 10},   //
    Box{520, 246, 552, 290, {232, 206, 40}, 8},   // a yellow tin
};

struct Ball {
  int x, y, radius;
  Rgb colour;
};
constexpr Ball drawn_ball{290, 372, 30, {206, 36, 34}};

std::uint32_t hashed(int x, int y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1U +
                    static_cast<std::uint32_t>(y) * 0x85ebca77U + seed * 0xc2b2ae3dU;
  h = (h ^ h >> 15U) * 0x2c1b3c6dU;
  h = (h ^ h >> 12U) * 0x297a2d39U;
  return h ^ h >> 15U;
}

// Random lattice values, -128 to 127, interpolated bilinearly; x and y in 1/16 of a unit.
int value_noise(int x, int y, int cell_shift, std::uint32_t seed) {
  const int column = x >> cell_shift, row = y >> cell_shift, one = 1 << cell_shift;
  const int fx = x & (one - 1), fy = y & (one - 1);
  const auto lattice = [&](int dx, int dy) {
    return static_cast<int>(hashed(column + dx, row + dy, seed) & 255U) - 128;
  };
  const int top = lattice(0, 0) * (one - fx) + lattice(1, 0) * fx;
  const int bottom = lattice(0, 1) * (one - fx) + lattice(1, 1) * fx;
  return ((top >> 4) * (one - fy) + (bottom >> 4) * fy) / (one * one >> 4);
}

// Two octaves: cells of 8 and of 32 units.
int texture(int x16, int y16, std::uint32_t seed) {
  return (value_noise(x16, y16, 7, seed) + value_noise(x16, y16, 9, seed + 1U)) / 2;
}

void shade(Rgb& colour, int levels) {
  for (int& c : colour) c += levels;
}

Rgb floor_colour(int x, int y) {
  const bool dark = ((x - room_width / 2) * 330 / (y + 40) / 48 + y / 24) % 2 == 0;
  return dark ? Rgb{112, 108, 100} : Rgb{146, 140, 128};
}

Rgb room_colour(int x, int y, int x16, int y16) {
  Rgb colour = floor_colour(x, y);
  int grain = 20;
  std::uint32_t seed = 1;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].holds(x, y)) continue;
    colour = boxes[i].colour;
    grain = boxes[i].grain;
    seed = static_cast<std::uint32_t>(3 * i + 4);
  }
  const int dx = x - drawn_ball.x, dy = y - drawn_ball.y;
  if (dx * dx + dy * dy <= drawn_ball.radius * drawn_ball.radius) {
    colour = drawn_ball.colour;
    shade(colour, -(dx + 2 * dy));  // lit from the upper left
    grain = 6;
  }
  shade(colour, texture(x16, y16, seed) * grain / 64);
  return colour;
}

}  // namespace

base::Image room_frame(int width_px, int height_px) {
  base::Image image(width_px, height_px, base::PixelFormat::rgb24);
  for (int y = 0; y < height_px; ++y) {
    std::uint8_t* out = image.row(y);
    const int y16 = 16 * room_height * y / height_px;
    for (int x = 0; x < width_px; ++x) {
      const int x16 = 16 * room_width * x / width_px;
      Rgb colour = room_colour(x16 / 16, y16 / 16, x16, y16);
      shade(colour, 16 - x16 / 320);  // a window to the left
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t noise = hashed(x, y, 1000U + static_cast<std::uint32_t>(k));
        const int levels = static_cast<int>((noise & 3U) + (noise >> 2U & 3U)) - 3;
        *out++ = static_cast<std::uint8_t>(std::clamp(colour[k] + levels, 0, 255));
      }
    }
  }
  return image;
}

}  // namespace gazed::benchmarks
