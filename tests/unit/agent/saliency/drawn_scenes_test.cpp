// The winner is on the object's own pixels, in scenes that each have something else to look at.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::drawn_scenes_test {
namespace {

using frames::Canvas;
using frames::Colour;

/// What is behind the object and beside it, and the object alone.
struct Scene {
  std::string name;
  Canvas background;
  std::function<void(Canvas&)> draw_object;
};

void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.name;
}

Canvas tiles(const Colour& ground, const Colour& joints) {
  Canvas canvas(640, 480, ground);
  for (int y = 70; y < 480; y += 90) canvas.rectangle(0, y, 640, 3, joints);
  for (int x = 50; x < 640; x += 120) canvas.rectangle(x, 0, 3, 480, joints);
  return canvas;
}

/// Blades and worn patches.
Canvas turf() {
  Canvas canvas(640, 480, {60, 120, 50});
  for (int i = 0; i < 900; ++i) {
    const int x = i * 7919 % 640, y = i * 104'729 % 480;
    canvas.rectangle(x, y, 3, 9, i % 2 == 0 ? Colour{75, 140, 60} : Colour{48, 100, 42});
  }
  return canvas.disc(150, 120, 40, {78, 112, 58}).disc(520, 380, 55, {52, 100, 45});
}

Canvas& long_shadow(Canvas& canvas, int x, int y, const Colour& colour) {
  for (int i = 0; i < 90; i += 6) canvas.disc(x + i, y + i / 5, 22 - i / 8, colour);
  return canvas;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  const auto add = [&](const char* name, const Canvas& background, auto object) {
    all.push_back({name, background, object});
  };

  Canvas pavement = tiles({185, 183, 180}, {150, 148, 145});
  long_shadow(pavement, 330, 285, {40, 40, 42});
  add("a red ball and its long shadow on tiles", pavement, [](Canvas& c) {
    c.disc(300, 260, 30, {190, 40, 35});
  });

  Canvas wall(640, 480, {205, 200, 190});
  add("a small red cup and a large pale picture",
      Canvas(wall)
          .rectangle(60, 60, 220, 160, {150, 175, 205})
          .rectangle(80, 80, 180, 120, {165, 190, 200}),
      [](Canvas& c) {
        c.rectangle(450, 300, 44, 56, {200, 45, 40});
      });

  add("a blue ball with a highlight, and the lamp's on the wall",
      Canvas(640, 480, {120, 118, 115}).vignette(30).disc(500, 110, 34, {215, 214, 210}),
      [](Canvas& c) {
        c.disc(250, 290, 46, {40, 70, 190}).disc(236, 274, 9, {230, 235, 250});
      });

  add("an orange ball on turf with worn patches", turf(), [](Canvas& c) {
    c.disc(360, 250, 20, {230, 120, 30});
  });

  Canvas sky = Canvas(640, 480, {110, 160, 225}).shade_to_the_right(20);
  for (const auto& [x, y, r] : {std::array{120, 110, 40}, {165, 100, 50}, {215, 115, 38}})
    sky.disc(x, y, r, {225, 230, 238});
  add("a red balloon and a white cloud", sky, [](Canvas& c) {
    c.disc(430, 250, 40, {205, 30, 40}).disc(430, 275, 28, {205, 30, 40});
  });

  Canvas board(640, 480, {225, 225, 220});
  for (int i = 0; i < 5; ++i) board.rectangle(60 + 110 * i, 60 + 17 * i, 80, 4, {70, 70, 75});
  add("a red screwdriver and notes on a board", board, [](Canvas& c) {
    c.rectangle(250, 300, 130, 22, {200, 35, 35}).rectangle(380, 307, 90, 8, {150, 152, 156});
  });

  add("a yellow cup on a dark table, whole in the frame",
      Canvas(wall).rectangle(70, 180, 500, 230, {95, 70, 55}), [](Canvas& c) {
        c.rectangle(310, 230, 50, 60, {215, 185, 50});
      });

  add("a green bottle, and a window that is overexposed",
      Canvas(640, 480, {130, 126, 120}).rectangle(420, 0, 220, 230, {255, 255, 255}),
      [](Canvas& c) {
        c.rectangle(200, 210, 40, 120, {40, 130, 60});
      });

  add("a printed box of the wall's own grey, and a shelf that the border cuts",
      Canvas(640, 480, {150, 150, 148}).rectangle(0, 60, 190, 40, {105, 95, 85}), [](Canvas& c) {
        for (int y = 240; y < 310; y += 5)
          for (int x = 380; x < 450; x += 5)
            c.rectangle(x, y, 5, 5,
                        (x + y) % 10 == 0 ? Colour{178, 178, 176} : Colour{122, 122, 120});
      });

  add("a white ball with black spots on turf, and a line",
      turf().rectangle(0, 60, 640, 16, {225, 228, 220}), [](Canvas& c) {
        c.disc(330, 270, 34, {235, 235, 235});
        for (const auto& [x, y] : {std::array{318, 258}, {346, 262}, {330, 288}})
          c.disc(x, y, 9, {25, 25, 25});
      });
  return all;
}

class DrawnScenes : public testing::TestWithParam<Scene> {};

INSTANTIATE_TEST_SUITE_P(All, DrawnScenes, testing::ValuesIn(scenes()));

// Where a pixel differs from the background before there is noise, it is the object's.
TEST_P(DrawnScenes, TheWinnerIsOnTheObject) {
  Canvas background = GetParam().background, canvas = background;
  GetParam().draw_object(canvas);
  Canvas drawn = canvas;
  Saliency saliency(SaliencySettings{}, 640, 480);
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::trials(4, 1)); ++seed) {
    const SaliencyResult seen = saliency.examine(Canvas(canvas).noise(2, seed).view());
    const auto x = static_cast<int>(std::lround(seen.peak_px.x()));
    const auto y = static_cast<int>(std::lround(seen.peak_px.y()));
    const std::uint8_t *with = drawn.pixel(x, y), *without = background.pixel(x, y);
    EXPECT_FALSE(std::equal(with, with + 3, without)) << seen.peak_px.transpose();
  }
}

}  // namespace
}  // namespace gazed::saliency::drawn_scenes_test
