#include "agent/base/image.hpp"

#include <algorithm>

namespace gazed::base {

namespace {

std::size_t byte_count(int width_px, int height_px, PixelFormat format) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
         static_cast<std::size_t>(bytes_per_pixel(format));
}

}  // namespace

Image::Image(int width_px, int height_px, PixelFormat format)
    : pixels_(byte_count(width_px, height_px, format)),
      width_px_(width_px),
      height_px_(height_px),
      format_(format) {}

void Image::reserve(int width_px, int height_px, PixelFormat format) {
  pixels_.reserve(byte_count(width_px, height_px, format));
}

ImageView Image::view() const {
  if (pixels_.empty()) return {};
  return {pixels_.data(), width_px_, height_px_, width_px_ * bytes_per_pixel(format_), format_};
}

std::uint8_t* Image::row(int y) {
  return pixels_.data() + byte_count(width_px_, 1, format_) * static_cast<std::size_t>(y);
}

void Image::assign(const ImageView& source) {
  width_px_ = source.width_px;
  height_px_ = source.height_px;
  format_ = source.format;
  pixels_.resize(byte_count(width_px_, height_px_, format_));
  const auto row_bytes = static_cast<std::ptrdiff_t>(byte_count(width_px_, 1, format_));
  for (int y = 0; y < height_px_; ++y) std::copy_n(source.row(y), row_bytes, row(y));
}

int luma(const ImageView& image, int x, int y) {
  const std::uint8_t* pixel = image.row(y) + x * bytes_per_pixel(image.format);
  if (image.format != PixelFormat::rgb24) return pixel[0];
  return (77 * pixel[0] + 150 * pixel[1] + 29 * pixel[2] + 128) >> 8;
}

}  // namespace gazed::base
