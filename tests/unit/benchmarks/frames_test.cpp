// The frames that benchmarks draw or read.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <set>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "tests/benchmarks/popout.hpp"
#include "tests/benchmarks/ppm.hpp"
#include "tests/benchmarks/room_frame.hpp"

namespace gazed::benchmarks::frames_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// FNV-1a, 64 bit (Fowler, Noll, Vo).
std::uint64_t hash_of(const base::ImageView& rgb) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (int y = 0; y < rgb.height_px; ++y)
    for (int i = 0; i < 3 * rgb.width_px; ++i) hash = (hash ^ rgb.row(y)[i]) * 0x100000001b3U;
  return hash;
}

// The numbers are what this code gave on x86-64; the other targets must give the same.
TEST(RoomFrame, IsTheSameOnEveryTarget) {
  EXPECT_EQ(hash_of(room_frame(640, 480).view()), 0xdadc035ea80424e6U);
  EXPECT_EQ(hash_of(room_frame(321, 243).view()), 0x62650607619eb682U);
}

TEST(PopOut, IsTheSameOnEveryTarget) {
  std::uint64_t all = 0;
  for (const Oddity oddity : oddities)
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      all = all * 31 + hash_of(popout_display(oddity, seed).canvas.view());
  EXPECT_EQ(all, 0x307d362d194aedc4U);
}

saliency::frames::Colour colour_at(PopOut& display, const geometry::Pixel& at_px) {
  const std::uint8_t* p =
      display.canvas.pixel(static_cast<int>(at_px.x()), static_cast<int>(at_px.y()));
  return {p[0], p[1], p[2]};
}

TEST(PopOut, OneItemHasAColourOfItsOwn) {
  for (const Oddity oddity : oddities) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      PopOut display = popout_display(oddity, seed);
      const saliency::frames::Colour odd = colour_at(display, display.odd_px);
      std::set<saliency::frames::Colour> colours;
      int odd_pixels = 0;
      for (int y = 0; y < 480; ++y) {
        for (int x = 0; x < 640; ++x) {
          const saliency::frames::Colour colour = colour_at(display, geometry::Pixel(x, y));
          colours.insert(colour);
          if (colour == odd) ++odd_pixels;
          if (colour == odd) {
            EXPECT_LE((geometry::Pixel(x, y) - display.odd_px).norm(), 14.0);
          }
        }
      }
      EXPECT_EQ(odd_pixels, 613);  // a disc of radius 14
      EXPECT_EQ(colours.size(), oddity == Oddity::hue_among_mixed ? 5U : 3U);
    }
  }
}

TEST(PopOut, FoundWithinFortyPixels) {
  const PopOut display = popout_display(Oddity::hue, 1);
  EXPECT_TRUE(is_found(display, display.odd_px + geometry::Pixel(0, 40)));
  EXPECT_FALSE(is_found(display, display.odd_px + geometry::Pixel(30, 30)));
}

class Ppm : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder);
    file = folder / "frame.ppm";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  base::Image read(const std::string& bytes) const {
    std::ofstream(file, std::ios::binary) << bytes;
    return read_ppm(file);
  }
  void expect_refused(const std::string& bytes, const std::string& found) const {
    EXPECT_THAT([&] { read(bytes); }, ThrowsMessage<std::runtime_error>(
                                          AllOf(HasSubstr(file.string()), HasSubstr(found))));
  }

  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("gazed_ppm_" + std::to_string(::getpid()));
  std::filesystem::path file;
};

TEST_F(Ppm, PixelsAreReadInOrder) {
  const base::Image image = read(
      "P6 # a comment\n2 1\n255\n"
      "abcdef");
  EXPECT_EQ(image.view().width_px, 2);
  EXPECT_EQ(image.view().height_px, 1);
  EXPECT_EQ(std::string(image.view().data, image.view().data + 6), "abcdef");
}

TEST_F(Ppm, RefusalsNameTheFileAndWhatWasFound) {
  expect_refused("", "an empty file");
  expect_refused("\x89PNG\r\n", "'.P' found");
  expect_refused("P5 2 1 255\nab", "'P5' found");
  expect_refused("P6 2\n", "no width, height and greatest value");
  expect_refused("P6 0 1 255\n", "size 0x1 found");
  expect_refused("P6 2 99999 255\n", "size 2x99999 found");
  expect_refused("P6 2 1 65535\n", "greatest value 65535 found");
  expect_refused("P6 2 1 255\nabcd", "4 of 6 bytes of pixels found");
  std::filesystem::remove(file);
  EXPECT_THAT([&] { static_cast<void>(read_ppm(file)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("No such file")));
  EXPECT_THAT([&] { static_cast<void>(read_ppm(folder)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a folder found")));
}

}  // namespace
}  // namespace gazed::benchmarks::frames_test
