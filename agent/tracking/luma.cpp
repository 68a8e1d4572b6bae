#include "agent/tracking/luma.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace gazed::tracking {

namespace {

// Divides a weighted sum of samples whose weights add up to 16. Samples are at most 4080, so the
// sum plus half the divisor fits in 16 bits; knowing that, the compiler packs twice as many into a
// vector.
std::uint16_t sixteenth(int sum) {
  const auto rounded = static_cast<std::uint16_t>(sum + 8);
  return static_cast<std::uint16_t>(rounded >> 4);
}

// Reads one row of luma, Q12.4.
void read_row(const base::ImageView& image, int y, std::uint16_t* out) {
  const std::uint8_t* row = image.row(y);
  const int width = image.width_px;
  switch (image.format) {
    case base::PixelFormat::grey:
      for (int x = 0; x < width; ++x) out[x] = static_cast<std::uint16_t>(row[x] << 4);
      return;
    case base::PixelFormat::yuyv:
      static_assert(std::endian::native == std::endian::little);  // y comes first
      for (int x = 0; x < width; ++x) {
        std::uint16_t y_and_chroma = 0;
        std::memcpy(&y_and_chroma, row + 2 * x, sizeof(y_and_chroma));
        out[x] = static_cast<std::uint16_t>((y_and_chroma & 0xFFU) << 4);
      }
      return;
    case base::PixelFormat::rgb24:
      for (int x = 0; x < width; ++x, row += 3) {
        out[x] = static_cast<std::uint16_t>((77U * row[0] + 150U * row[1] + 29U * row[2]) >> 4);
      }
      return;
  }
}

}  // namespace

void LumaLevel::resize(int new_width, int new_height, int new_step_px) {
  width = new_width;
  height = new_height;
  step_px = new_step_px;
  samples.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + padding, 0);
}

LumaPyramid::LumaPyramid(int width_px, int height_px) {
  int width = width_px, height = height_px, step = 1;
  for (LumaLevel& level : levels_) {
    level.resize(width, height, step);
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    step *= 2;
  }
  for (auto& row : rows_) row.resize(static_cast<std::size_t>(width_px));
  sums_.resize(static_cast<std::size_t>(width_px) + 4);
}

void LumaPyramid::build(const base::ImageView& image) {
  smooth(image);
  for (std::size_t i = 1; i < levels_.size(); ++i) reduce(levels_[i - 1], levels_[i]);
}

// [1 2 1]/4 in both directions: at most 16 times a sample, rounded once.
void LumaPyramid::smooth(const base::ImageView& image) {
  LumaLevel& full = levels_[0];
  const int width = full.width, last = full.height - 1;
  const auto row = [this](int y) { return rows_[static_cast<std::size_t>(y % 3)].data(); };
  read_row(image, 0, row(0));
  for (int y = 0; y <= last; ++y) {
    if (y < last) read_row(image, y + 1, row(y + 1));
    const std::uint16_t* above = row(std::max(y - 1, 0));
    const std::uint16_t* here = row(y);
    const std::uint16_t* below = row(std::min(y + 1, last));
    std::uint16_t* sums = sums_.data() + 1;
    for (int x = 0; x < width; ++x) {
      sums[x] = static_cast<std::uint16_t>(above[x] + 2 * here[x] + below[x]);
    }
    sums[-1] = sums[0];
    sums[width] = sums[width - 1];
    std::uint16_t* out = full.row(y);
    for (int x = 0; x < width; ++x) {
      out[x] = sixteenth(sums[x - 1] + 2 * sums[x] + sums[x + 1]);
    }
  }
}

void LumaPyramid::reduce(const LumaLevel& fine, LumaLevel& coarse) {
  std::uint16_t* sums = sums_.data() + 2;
  for (int y = 0; y < coarse.height; ++y) {
    const auto line = [&](int offset) {
      return fine.row(std::clamp(2 * y + offset, 0, fine.height - 1));
    };
    const std::uint16_t *a = line(-2), *b = line(-1), *c = line(0), *d = line(1), *e = line(2);
    for (int x = 0; x < fine.width; ++x) {
      sums[x] = sixteenth(a[x] + e[x] + 4 * (b[x] + d[x]) + 6 * c[x]);
    }
    sums[-2] = sums[-1] = sums[0];
    sums[fine.width] = sums[fine.width + 1] = sums[fine.width - 1];
    std::uint16_t* out = coarse.row(y);
    for (int x = 0; x < coarse.width; ++x) {
      const std::uint16_t* at = sums + 2 * x;
      out[x] = sixteenth(at[-2] + at[2] + 4 * (at[-1] + at[1]) + 6 * at[0]);
    }
  }
}

}  // namespace gazed::tracking
