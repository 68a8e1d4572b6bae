// Images as the camera gives them.
//
// An `ImageView` borrows pixels, an `Image` owns them. Rows may be padded: `row_stride` bytes lie
// between the starts of two rows. Pixel (0,0) is the centre of the top left pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gazed::base {

enum class PixelFormat : std::uint8_t {
  grey,   // 1 byte a pixel
  rgb24,  // 3 bytes a pixel: r, g, b
  yuyv,   // 2 bytes a pixel: y0 u y1 v for each pair of pixels, BT.601 limited range (V4L2 "YUYV")
};

[[nodiscard]] constexpr int bytes_per_pixel(PixelFormat format) {
  return format == PixelFormat::grey ? 1 : format == PixelFormat::yuyv ? 2 : 3;
}

struct ImageView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  int row_stride = 0;  // bytes
  PixelFormat format = PixelFormat::rgb24;

  [[nodiscard]] bool empty() const { return data == nullptr; }
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return data + static_cast<std::ptrdiff_t>(row_stride) * y;
  }
};

/// Pixels that the object owns, rows unpadded.
class Image {
 public:
  Image() = default;
  Image(int width_px, int height_px, PixelFormat format);

  /// Makes room for an image without touching it: pages that none ever fills stay the kernel's.
  void reserve(int width_px, int height_px, PixelFormat format);
  [[nodiscard]] ImageView view() const;
  [[nodiscard]] std::span<std::uint8_t> pixels() { return pixels_; }
  [[nodiscard]] std::uint8_t* row(int y);

  /// Copies `source`, changing size and format to its own; allocates only when it needs more bytes
  /// than ever before.
  void assign(const ImageView& source);

 private:
  std::vector<std::uint8_t> pixels_;
  int width_px_ = 0;
  int height_px_ = 0;
  PixelFormat format_ = PixelFormat::rgb24;
};

/// Luma of one pixel, 0 to 255: the grey value, the camera's y, or (77 r + 150 g + 29 b) / 256
/// (BT.601 in Q8).
[[nodiscard]] int luma(const ImageView& image, int x, int y);

}  // namespace gazed::base
