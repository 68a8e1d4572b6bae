#include "tests/benchmarks/popout.hpp"

#include <algorithm>
#include <random>
#include <vector>

namespace gazed::benchmarks {

namespace {

using frames::Colour;

constexpr int ground = 128, columns = 6, rows = 4, items = columns * rows, radius_px = 14;

// Chroma of twelve hues, 30 degrees apart in the plane of Cb and Cr, as what they add to r, g and b
// at unchanged luminance (BT.601: 1.402 cr, -0.344 cb - 0.714 cr, 1.772 cb). Radius 48: every hue
// of every luminance below fits into 8 bit.
constexpr std::array<std::array<int, 3>, 12> hues{{{0, -17, 85},
                                                   {34, -31, 74},
                                                   {58, -38, 43},
                                                   {67, -34, 0},
                                                   {58, -21, -43},
                                                   {34, -3, -74},
                                                   {0, 17, -85},
                                                   {-34, 31, -74},
                                                   {-58, 38, -43},
                                                   {-67, 34, 0},
                                                   {-58, 21, 43},
                                                   {-34, 3, 74}}};
constexpr std::array luminances{96, 104, 112, 144, 152, 160};  // to either side of the ground

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  /// 0 to count - 1.
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

  int luminance() { return luminances[static_cast<std::size_t>(below(luminances.size()))]; }

  /// On the other side of the ground.
  int luminance_opposite_to(int other) {
    const int index = below(luminances.size() / 2) + (other < ground ? 3 : 0);
    return luminances[static_cast<std::size_t>(index)];
  }

  template <class T>
  void shuffle(std::vector<T>& values) {
    for (int i = static_cast<int>(values.size()) - 1; i > 0; --i)
      std::swap(values[static_cast<std::size_t>(i)],
                values[static_cast<std::size_t>(below(i + 1))]);
  }

 private:
  std::mt19937_64 random_;
};

Colour grey(int luminance) {
  const auto level = static_cast<std::uint8_t>(luminance);
  return {level, level, level};
}

Colour coloured(int hue, int luminance) {
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(luminance + hues[static_cast<std::size_t>(hue % 12)][k]);
  return colour;
}

/// The odd item's colour, then the others'.
std::vector<Colour> draw_colours(Oddity oddity, Draw& draw) {
  const int hue = draw.below(12), luminance = draw.luminance();
  std::vector<Colour> colours(items);
  switch (oddity) {
    case Oddity::hue:
      std::fill(colours.begin(), colours.end(), coloured(hue, luminance));
      colours[0] = coloured(hue + 4 + draw.below(5), luminance);  // 120 to 240 degrees away
      break;
    case Oddity::luminance:
      std::fill(colours.begin(), colours.end(), grey(luminance));
      colours[0] = grey(draw.luminance_opposite_to(luminance));
      break;
    case Oddity::both:
      std::fill(colours.begin(), colours.end(), coloured(hue, luminance));
      colours[0] = coloured(hue + 4 + draw.below(5), draw.luminance_opposite_to(luminance));
      break;
    case Oddity::hue_among_mixed:  // four hues, 90 degrees apart
      for (int i = 0; i < items; ++i)
        colours[static_cast<std::size_t>(i)] = coloured(hue + 3 * (1 + i % 3), luminance);
      colours[0] = coloured(hue, luminance);
      break;
  }
  return colours;
}

}  // namespace

std::string_view name(Oddity oddity) {
  constexpr std::array<std::string_view, 4> names{"hue", "luminance", "both",
                                                  "hue among mixed hues"};
  return names[static_cast<std::size_t>(oddity)];
}

PopOut popout_display(Oddity oddity, std::uint64_t seed) {
  // mt19937_64 begins alike for seeds that are alike; the factor is that of SplitMix64.
  Draw draw((4 * seed + static_cast<std::uint64_t>(oddity) + 1) * 0x9e3779b97f4a7c15U);
  const std::vector<Colour> colours = draw_colours(oddity, draw);
  std::vector<int> places;
  for (int i = 0; i < items; ++i) places.push_back(i);
  draw.shuffle(places);

  PopOut display{frames::Canvas(640, 480, grey(ground)), Pixel::Zero()};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const int x = 53 + places[i] % columns * 107 + draw.below(31) - 15;
    const int y = 60 + places[i] / columns * 120 + draw.below(31) - 15;
    display.canvas.disc(x, y, radius_px, colours[i]);
    if (i == 0) display.odd_px = Pixel(x, y);
  }
  return display;
}

bool is_found(const PopOut& display, const Pixel& winner_px) {
  constexpr double reach_px = 40.0;
  return (winner_px - display.odd_px).norm() <= reach_px;
}

}  // namespace gazed::benchmarks
