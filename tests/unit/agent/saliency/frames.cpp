#include "tests/unit/agent/saliency/frames.hpp"

#include <algorithm>
#include <random>

namespace gazed::saliency::frames {

namespace {

std::uint8_t byte_of(int value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

// 24 items on a jittered 6x4 grid of a 640x480 frame; the item `odd` has its own colour.
Canvas display(const Colour& ground, const Colour& item, const Colour& odd_item, int odd,
               std::uint64_t seed) {
  Canvas canvas(640, 480, ground);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 24; ++i) {
    const int x = 53 + i % 6 * 107 + static_cast<int>(random() % 31) - 15;
    const int y = 60 + i / 6 * 120 + static_cast<int>(random() % 31) - 15;
    canvas.disc(x, y, 14, i == odd ? odd_item : item);
  }
  return canvas;
}

}  // namespace

Canvas::Canvas(int width_px, int height_px, const Colour& colour)
    : width_px_(width_px), height_px_(height_px) {
  bytes_.resize(std::size_t{3} * static_cast<std::size_t>(width_px) *
                static_cast<std::size_t>(height_px));
  rectangle(0, 0, width_px, height_px, colour);
}

std::uint8_t* Canvas::pixel(int x, int y) {
  return bytes_.data() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * width_px_ + x);
}

Canvas& Canvas::rectangle(int x, int y, int width_px, int height_px, const Colour& colour) {
  for (int v = std::max(y, 0); v < std::min(y + height_px, height_px_); ++v)
    for (int u = std::max(x, 0); u < std::min(x + width_px, width_px_); ++u)
      std::copy(colour.begin(), colour.end(), pixel(u, v));
  return *this;
}

Canvas& Canvas::disc(int x, int y, int radius_px, const Colour& colour) {
  for (int v = std::max(y - radius_px, 0); v <= std::min(y + radius_px, height_px_ - 1); ++v)
    for (int u = std::max(x - radius_px, 0); u <= std::min(x + radius_px, width_px_ - 1); ++u)
      if ((u - x) * (u - x) + (v - y) * (v - y) <= radius_px * radius_px)
        std::copy(colour.begin(), colour.end(), pixel(u, v));
  return *this;
}

Canvas& Canvas::noise(int amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto range = static_cast<std::uint32_t>(2 * amplitude + 1);
  for (std::uint8_t& byte : bytes_) {
    const std::uint64_t bits = random();
    int sum = 0;
    for (int k = 0; k < 4; ++k)
      // 32 bits: a remainder of 64 is a library's call on i686.
      sum += static_cast<int>(static_cast<std::uint32_t>(bits >> (16 * k) & 0xffff) % range) -
             amplitude;
    byte = byte_of(byte + sum);
  }
  return *this;
}

Canvas& Canvas::vignette(int percent) {
  const std::int64_t cx = width_px_ / 2, cy = height_px_ / 2, far = cx * cx + cy * cy;
  for (int y = 0; y < height_px_; ++y) {
    for (int x = 0; x < width_px_; ++x) {
      const std::int64_t d = (x - cx) * (x - cx) + (y - cy) * (y - cy);
      const std::int64_t share = 100 * far - percent * d;
      for (int k = 0; k < 3; ++k)
        pixel(x, y)[k] = byte_of(static_cast<int>(pixel(x, y)[k] * share / (100 * far)));
    }
  }
  return *this;
}

Canvas& Canvas::shade_to_the_right(int percent) {
  for (int y = 0; y < height_px_; ++y)
    for (int x = 0; x < width_px_; ++x)
      for (int k = 0; k < 3; ++k)
        pixel(x, y)[k] = byte_of(pixel(x, y)[k] * (100 * (width_px_ - 1) - percent * x) /
                                 (100 * (width_px_ - 1)));
  return *this;
}

base::ImageView Canvas::view() const {
  return {bytes_.data(), width_px_, height_px_, 3 * width_px_, base::PixelFormat::rgb24};
}

std::vector<std::uint8_t> yuyv_of(const base::ImageView& rgb) {
  // BT.601-7: y = 16 + 219 (0.299 r + 0.587 g + 0.114 b)/255, u and v likewise with 224; in Q16.
  std::vector<std::uint8_t> out;
  for (int y = 0; y < rgb.height_px; ++y) {
    const std::uint8_t* p = rgb.row(y);
    for (int x = 0; x < rgb.width_px; ++x, p += 3) {
      const int half = 1 << 15;
      out.push_back(byte_of(16 + ((16829 * p[0] + 33039 * p[1] + 6416 * p[2] + half) >> 16)));
      const std::uint8_t* even = p - (x % 2 == 0 ? 0 : 3);
      out.push_back(
          x % 2 == 0
              ? byte_of(128 + ((-9714 * even[0] - 19070 * even[1] + 28784 * even[2] + half) >> 16))
              : byte_of(128 + ((28784 * even[0] - 24103 * even[1] - 4681 * even[2] + half) >> 16)));
    }
  }
  return out;
}

base::ImageView yuyv_view(const std::vector<std::uint8_t>& bytes, int width_px, int height_px) {
  return {bytes.data(), width_px, height_px, 2 * width_px, base::PixelFormat::yuyv};
}

std::vector<NamedFrame> drawn_frames() {
  std::vector<NamedFrame> all;
  all.push_back({"red disc on a noisy wall",
                 Canvas(640, 480, {205, 205, 195}).disc(180, 330, 30, {200, 30, 30}).noise(2, 1)});
  all.push_back({"two discs on a shaded wall", Canvas(640, 480, {220, 215, 205})
                                                   .disc(450, 120, 20, {40, 70, 190})
                                                   .disc(150, 300, 45, {210, 180, 40})
                                                   .vignette(40)
                                                   .noise(1, 2)});
  all.push_back({"blocks of colour", Canvas(640, 480, {90, 120, 60})
                                         .rectangle(40, 50, 160, 90, {180, 170, 160})
                                         .rectangle(300, 200, 60, 220, {30, 40, 120})
                                         .rectangle(420, 20, 150, 150, {150, 60, 50})
                                         .noise(5, 3)});
  all.push_back({"pop-out in hue", display(grey, {60, 140, 70}, {190, 70, 60}, 9, 4).noise(1, 5)});
  all.push_back(
      {"pop-out in luminance", display(grey, {100, 100, 100}, {220, 220, 220}, 16, 6).noise(1, 7)});
  all.push_back({"small frame, odd sizes",
                 Canvas(163, 127, {200, 200, 200}).disc(60, 70, 10, {180, 40, 30}).noise(2, 8)});
  return all;
}

std::vector<NamedFrame> near_grey_displays() {
  std::vector<NamedFrame> all;
  all.push_back({"grey items, 6 levels apart",
                 display(grey, {134, 134, 134}, {140, 140, 140}, 7, 9).noise(1, 10)});
  all.push_back(
      {"a touch of red", display(grey, {136, 134, 134}, {150, 132, 132}, 14, 11).noise(1, 12)});
  all.push_back({"a touch of blue",
                 display({122, 124, 126}, {128, 128, 128}, {120, 122, 140}, 3, 13).noise(2, 14)});
  all.push_back(
      {"dark on darker", display({40, 40, 40}, {48, 48, 48}, {60, 58, 52}, 20, 15).noise(1, 16)});
  return all;
}

}  // namespace gazed::saliency::frames
