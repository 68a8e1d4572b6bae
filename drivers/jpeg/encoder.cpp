#include "drivers/jpeg/encoder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

#include "drivers/jpeg/compression.hpp"

namespace gazed::jpeg {

namespace {

using Table = std::array<std::uint8_t, 256>;

/// From the limited range of BT.601 (luma 16 to 235, chroma 16 to 240) to JFIF's full one.
constexpr Table full_range(int zero, int steps) {
  Table table{};
  for (int i = 0; i < 256; ++i) {
    const int middle = zero == 16 ? 0 : 128;
    const int scaled = (i - zero) * 255;
    const int rounded = (scaled + (scaled < 0 ? -steps : steps) / 2) / steps;
    table[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::clamp(rounded + middle, 0, 255));
  }
  return table;
}
constexpr Table full_luma = full_range(16, 219), full_chroma = full_range(128, 224);

void to_full_range(const std::uint8_t* yuyv, std::span<std::uint8_t> row) {
  const std::size_t pixels = row.size() / 3;
  for (std::size_t x = 0; x < pixels; ++x) {
    const std::uint8_t* pair = yuyv + 4 * (x / 2);
    row[3 * x] = full_luma[pair[2 * (x % 2)]];
    row[3 * x + 1] = full_chroma[pair[1]];
    row[3 * x + 2] = (x | 1U) < pixels ? full_chroma[pair[3]] : 128;  // half a pair has no v
  }
}

class Compression {
 public:
  explicit Compression(const base::ImageView& image) : image_(image) {
    info_.err = errors_.install();
  }
  ~Compression() {
    jpeg_destroy_compress(&info_);
    if (out_ != own_) std::free(out_);  // libjpeg's, in place of a buffer that was too small
  }
  Compression(const Compression&) = delete;
  Compression& operator=(const Compression&) = delete;

  /// `file`: room for what is written; more is taken where it does not suffice. `row`: room for a
  /// row of y u v.
  [[nodiscard]] bool run(int quality, std::span<std::uint8_t> file, std::span<std::uint8_t> row) {
    out_ = own_ = file.data();
    bytes_ = static_cast<unsigned long>(file.size());
    if (setjmp(errors_.jump) != 0) return false;
    jpeg_create_compress(&info_);
    jpeg_mem_dest(&info_, &out_, &bytes_);
    describe(quality);
    jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      const std::uint8_t* pixels = image_.row(static_cast<int>(info_.next_scanline));
      if (image_.format == base::PixelFormat::yuyv) {
        to_full_range(pixels, row);
        pixels = row.data();
      }
      auto* scanline = const_cast<JSAMPROW>(pixels);  // libjpeg only reads it
      jpeg_write_scanlines(&info_, &scanline, 1);
    }
    jpeg_finish_compress(&info_);
    return true;
  }

  [[nodiscard]] std::span<const std::uint8_t> file() const { return {out_, bytes_}; }

 private:
  void describe(int quality) {
    info_.image_width = static_cast<JDIMENSION>(image_.width_px);
    info_.image_height = static_cast<JDIMENSION>(image_.height_px);
    const bool is_grey = image_.format == base::PixelFormat::grey;
    const bool is_yuyv = image_.format == base::PixelFormat::yuyv;
    info_.input_components = is_grey ? 1 : 3;
    info_.in_color_space = is_grey ? JCS_GRAYSCALE : is_yuyv ? JCS_YCbCr : JCS_RGB;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    if (is_yuyv) info_.comp_info[0].v_samp_factor = 1;  // 2 by default, with h_samp_factor 2
  }

  const base::ImageView& image_;
  Errors errors_;
  jpeg_compress_struct info_{};
  std::uint8_t* own_ = nullptr;
  std::uint8_t* out_ = nullptr;
  unsigned long bytes_ = 0;
};

}  // namespace

std::span<const std::uint8_t> Encoder::encode(const base::ImageView& image) {
  // A quarter of the pixels of an RGB image is much for a JPEG; what is larger makes the room
  // larger for the next one.
  const auto pixels =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  constexpr std::size_t tables = 4096;
  if (file_.size() < pixels + tables) file_.resize(pixels + tables);
  row_.resize(3 * static_cast<std::size_t>(image.width_px));
  Compression compression(image);
  if (!compression.run(quality_, file_, row_)) return {};
  const auto written = compression.file();
  if (written.data() != file_.data()) file_.assign(written.begin(), written.end());
  return std::span<const std::uint8_t>(file_).first(written.size());
}

}  // namespace gazed::jpeg
