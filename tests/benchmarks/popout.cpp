#include "tests/benchmarks/popout.hpp"

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace gazed::benchmarks {

namespace {

using saliency::frames::Colour;

constexpr int ground = 128, columns = 6, items = 4 * columns, radius_px = 14;

// Hues are 96ths of a turn, from red over yellow.
constexpr int turn = 96, sector = turn / 6;
constexpr int opposite = turn / 2, quarter = turn / 4;
constexpr int value = 205, light_value = 230, dark_value = 125;
// Contrast to the ground of grey items, and of the odd one among them: grey levels.
constexpr int contrast = 30, odd_contrast = 90;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  /// 0 to count - 1.
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

  bool coin() { return below(2) == 1; }

  template <class T>
  void shuffle(std::vector<T>& values) {
    for (int i = static_cast<int>(values.size()) - 1; i > 0; --i)
      std::swap(values[static_cast<std::size_t>(i)],
                values[static_cast<std::size_t>(below(i + 1))]);
  }

 private:
  std::mt19937_64 random_;
};

Colour grey(int level) {
  const auto byte = static_cast<std::uint8_t>(level);
  return {byte, byte, byte};
}

/// HSV with a saturation of 0.8.
Colour coloured(int hue, int hsv_value) {
  const int highest = hsv_value, lowest = hsv_value / 5;
  const int along = hue % sector, rise = (highest - lowest) * along / sector;
  const int rising = lowest + rise, falling = highest - rise;
  const std::array<std::array<int, 3>, 6> sectors{{{highest, rising, lowest},
                                                   {falling, highest, lowest},
                                                   {lowest, highest, rising},
                                                   {lowest, falling, highest},
                                                   {rising, lowest, highest},
                                                   {highest, lowest, falling}}};
  const std::array<int, 3>& rgb = sectors[static_cast<std::size_t>(hue % turn / sector)];
  return {static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]),
          static_cast<std::uint8_t>(rgb[2])};
}

/// The odd item's colour, then the others'.
std::vector<Colour> draw_colours(Oddity oddity, Draw& draw) {
  const int hue = draw.below(turn);
  const bool light = draw.coin();  // the odd item is the lighter one, where that matters
  const auto all = [](const Colour& odd, const Colour& others) {
    std::vector<Colour> colours(items, others);
    colours[0] = odd;
    return colours;
  };
  switch (oddity) {
    case Oddity::hue:
      return all(coloured(hue + opposite, value), coloured(hue, value));
    case Oddity::luminance: {
      const int sign = light ? 1 : -1;
      return all(grey(ground + sign * odd_contrast), grey(ground + sign * contrast));
    }
    case Oddity::both:
      return all(coloured(hue + opposite, light ? light_value : dark_value),
                 coloured(hue, light ? dark_value : light_value));
    case Oddity::hue_among_mixed:
      break;
  }
  std::vector<Colour> mixed;
  for (int i = 0; i < items; ++i)
    mixed.push_back(coloured(hue + (i == 0 ? 0 : quarter * (1 + i % 3)), value));
  return mixed;
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

  PopOut display{saliency::frames::Canvas(640, 480, grey(ground)), geometry::Pixel::Zero()};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const int x = 53 + places[i] % columns * 107 + draw.below(31) - 15;
    const int y = 60 + places[i] / columns * 120 + draw.below(31) - 15;
    display.canvas.disc(x, y, radius_px, colours[i]);
    if (i == 0) display.odd_px = geometry::Pixel(x, y);
  }
  return display;
}

bool is_found(const PopOut& display, const geometry::Pixel& winner_px) {
  constexpr double reach_px = 40.0;
  return (winner_px - display.odd_px).norm() <= reach_px;
}

}  // namespace gazed::benchmarks
