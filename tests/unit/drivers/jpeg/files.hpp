// JPEG files of the kinds that cameras send, and of those that they do not.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <jpeglib.h>
#include <vector>

#include "agent/base/image.hpp"

namespace gazed::jpeg {

using Bytes = std::vector<std::uint8_t>;

/// Waves of colour that a JPEG of quality 95 hardly changes.
inline base::Image waves(int width_px, int height_px) {
  base::Image image(width_px, height_px, base::PixelFormat::rgb24);
  for (int y = 0; y < height_px; ++y) {
    std::uint8_t* at = image.row(y);
    for (int x = 0; x < width_px; ++x) {
      for (const double phase : {0.0, 1.0, 2.0})
        *at++ = static_cast<std::uint8_t>(128.0 + 90.0 * std::sin(0.05 * x + 0.08 * y + phase));
    }
  }
  return image;
}

/// How a file differs from what libjpeg writes by default.
struct Kind {
  bool progressive = false;
  bool arithmetic = false;
  int colours = 3;  // 1: of the first one; 4: CMYK, the last one 0
  unsigned restart_rows = 0;
};

inline Bytes file_of(const base::Image& image, const Kind& kind = {}) {
  const base::ImageView view = image.view();
  jpeg_error_mgr errors{};
  jpeg_compress_struct info{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* out = nullptr;
  unsigned long bytes = 0;
  jpeg_mem_dest(&info, &out, &bytes);
  info.image_width = static_cast<JDIMENSION>(view.width_px);
  info.image_height = static_cast<JDIMENSION>(view.height_px);
  info.input_components = kind.colours;
  info.in_color_space = kind.colours == 1 ? JCS_GRAYSCALE : kind.colours == 4 ? JCS_CMYK : JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  if (kind.progressive) jpeg_simple_progression(&info);
  if (kind.arithmetic) info.arith_code = TRUE;
  info.restart_in_rows = static_cast<int>(kind.restart_rows);
  jpeg_start_compress(&info, TRUE);
  Bytes row;
  while (info.next_scanline < info.image_height) {
    const std::uint8_t* pixels = view.row(static_cast<int>(info.next_scanline));
    row.clear();
    for (int x = 0; x < view.width_px; ++x) {
      for (int c = 0; c < kind.colours; ++c)
        row.push_back(c < 3 ? pixels[3 * x + c] : std::uint8_t{0});
    }
    JSAMPROW scanline = row.data();
    jpeg_write_scanlines(&info, &scanline, 1);
  }
  jpeg_finish_compress(&info);
  Bytes file(out, out + bytes);
  jpeg_destroy_compress(&info);
  std::free(out);
  return file;
}

/// The file without its segments of that marker (ITU-T T.81, table B.1), which stand before the
/// scan.
inline Bytes without_segments(const Bytes& file, std::uint8_t marker) {
  constexpr std::uint8_t start_of_scan = 0xDA;
  Bytes rest(file.begin(), file.begin() + 2);
  std::size_t at = 2;
  while (file.at(at + 1) != start_of_scan) {
    const std::size_t end = at + 2 + (std::size_t{file.at(at + 2)} << 8U) + file.at(at + 3);
    if (file.at(at + 1) != marker)
      rest.insert(rest.end(), file.begin() + static_cast<std::ptrdiff_t>(at),
                  file.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
  rest.insert(rest.end(), file.begin() + static_cast<std::ptrdiff_t>(at), file.end());
  return rest;
}

}  // namespace gazed::jpeg
