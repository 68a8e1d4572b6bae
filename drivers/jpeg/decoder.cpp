#include "drivers/jpeg/decoder.hpp"

#include "agent/base/text.hpp"
#include "drivers/jpeg/compression.hpp"

namespace gazed::jpeg {

namespace {

class Decompression {
 public:
  Decompression() { info_.err = errors_.install(); }
  ~Decompression() { jpeg_destroy_decompress(&info_); }
  Decompression(const Decompression&) = delete;
  Decompression& operator=(const Decompression&) = delete;

  /// False: see words().
  [[nodiscard]] bool read_header(std::span<const std::uint8_t> bytes) {
    if (setjmp(errors_.jump) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, bytes.data(), static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&info_, TRUE);
    return true;
  }

  /// After read_header(). `image` has the size and format of the frame.
  [[nodiscard]] bool read_pixels(base::Image& image) {
    if (setjmp(errors_.jump) != 0) return false;
    info_.out_color_space = info_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW row = image.row(static_cast<int>(info_.output_scanline));
      jpeg_read_scanlines(&info_, &row, 1);
    }
    jpeg_finish_decompress(&info_);
    return true;
  }

  /// Why what the header says is not read; empty when it is.
  [[nodiscard]] std::string refusal(int width_px, int height_px) const {
    const auto width = static_cast<int>(info_.image_width);
    const auto height = static_cast<int>(info_.image_height);
    if (width != width_px || height != height_px)
      return base::text("a JPEG of %dx%d pixels where the frame has %dx%d", width, height, width_px,
                        height_px);
    if (info_.num_components != 1 && info_.num_components != 3)
      return base::text("a JPEG of %d colours; 1 (grey) or 3 can be read", info_.num_components);
    if (info_.progressive_mode != 0 ||
        jpeg_has_multiple_scans(const_cast<j_decompress_ptr>(&info_)))
      return "a JPEG of several scans (progressive); one scan, as cameras send, can be read";
    if (info_.arith_code != 0) return "a JPEG of arithmetic coding; Huffman coding can be read";
    return {};
  }

  [[nodiscard]] bool is_grey() const { return info_.num_components == 1; }
  [[nodiscard]] std::string words() const { return errors_.words.data(); }

 private:
  Errors errors_;
  jpeg_decompress_struct info_{};
};

}  // namespace

std::string decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                   base::Image& image) {
  if (bytes.empty()) return "a JPEG of no bytes";
  Decompression jpeg;
  if (!jpeg.read_header(bytes)) return "no JPEG that can be read: " + jpeg.words();
  if (std::string refusal = jpeg.refusal(width_px, height_px); !refusal.empty()) return refusal;
  const auto format = jpeg.is_grey() ? base::PixelFormat::grey : base::PixelFormat::rgb24;
  const base::ImageView before = image.view();
  if (before.width_px != width_px || before.height_px != height_px || before.format != format)
    image = base::Image(width_px, height_px, format);
  if (!jpeg.read_pixels(image)) return "a damaged JPEG: " + jpeg.words();
  return {};
}

}  // namespace gazed::jpeg
