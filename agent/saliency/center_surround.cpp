#include "agent/saliency/center_surround.hpp"

#include <algorithm>
#include <cstdlib>

#include "agent/saliency/fixed.hpp"

namespace gazed {

namespace {

// a + (b - a) fraction / 2^ratio_log2. |b - a| < 2^15, and the product is shifted at once.
constexpr std::int16_t between(std::int32_t a, std::int32_t b, std::int32_t fraction,
                               int ratio_log2) {
  return static_cast<std::int16_t>(a +
                                   (((b - a) * fraction + (1 << (ratio_log2 - 1))) >> ratio_log2));
}

void surround_row(const ConstPlane& surround, int ratio_log2, int y, std::span<std::int16_t> out) {
  const int above = y >> ratio_log2;
  const int below = std::min(above + 1, surround.height - 1);
  const std::int32_t fraction = y & ((1 << ratio_log2) - 1);
  for (int x = 0; x < surround.width; ++x)
    out[static_cast<std::size_t>(x)] =
        between(surround.row(above)[x], surround.row(below)[x], fraction, ratio_log2);
  out[static_cast<std::size_t>(surround.width)] = out[static_cast<std::size_t>(surround.width - 1)];
}

template <typename Compare>
void compare_row(const std::int16_t* centre, int width, const std::int16_t* surround,
                 int ratio_log2, std::int16_t* out, Compare compare) {
  const int ratio = 1 << ratio_log2;
  for (int start = 0; start < width; start += ratio, ++surround) {
    const int count = std::min(ratio, width - start);
    for (int k = 0; k < count; ++k)
      out[start + k] = static_cast<std::int16_t>(
          std::abs(compare(centre[start + k], between(surround[0], surround[1], k, ratio_log2))));
  }
}

constexpr int ramp_fraction_bits = 15;

std::int16_t attenuated(std::int16_t sample, std::int16_t factor) {
  return static_cast<std::int16_t>(rounding_shift<ramp_fraction_bits>(sample * factor));
}

}  // namespace

void center_surround_row(CentreSurround mode, const ConstPlane& centre, const ConstPlane& surround,
                         int ratio_log2, int y, std::span<std::int16_t> scratch,
                         std::int16_t* out) {
  surround_row(surround, ratio_log2, y, scratch);
  const std::int16_t* centre_row = centre.row(y);
  if (mode == CentreSurround::difference) {
    compare_row(centre_row, centre.width, scratch.data(), ratio_log2, out,
                [](int c, int s) { return c - s; });
  } else {
    compare_row(centre_row, centre.width, scratch.data(), ratio_log2, out,
                [](int c, int s) { return c + s; });
  }
}

BorderRamp::BorderRamp(int width, int height) : width_(width), height_(height) {
  const int length = std::min(std::max(width, height) / 20, std::min(width, height) / 2);
  for (int i = 0; i < length; ++i)
    factors_.push_back(static_cast<std::int16_t>(((i + 1) << ramp_fraction_bits) / (length + 1)));
}

void BorderRamp::apply(int y, std::int16_t* row) const {
  const int from_border = std::min(y, height_ - 1 - y);
  const int length = static_cast<int>(factors_.size());
  if (from_border < length) {
    const std::int16_t factor = factors_[static_cast<std::size_t>(from_border)];
    for (int x = 0; x < width_; ++x) row[x] = attenuated(row[x], factor);
  }
  for (int i = 0; i < length; ++i) {
    const std::int16_t factor = factors_[static_cast<std::size_t>(i)];
    row[i] = attenuated(row[i], factor);
    row[width_ - 1 - i] = attenuated(row[width_ - 1 - i], factor);
  }
}

}  // namespace gazed
