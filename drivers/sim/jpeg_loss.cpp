#include "drivers/sim/jpeg_loss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazed::sim {

namespace {

// ITU-T T.81, annex K, tables K.1 and K.2.
constexpr JpegLoss::Steps standard_luma{
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};
constexpr JpegLoss::Steps standard_chroma{
    17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99, 24, 26, 56, 99, 99, 99,
    99, 99, 47, 66, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
    99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99};

constexpr int cosine_bits = 13, product_bits = 2 * cosine_bits;
constexpr std::int32_t middle = 128;

JpegLoss::Steps scaled(const JpegLoss::Steps& standard, int quality) {
  const int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  JpegLoss::Steps steps;
  std::transform(standard.begin(), standard.end(), steps.begin(), [&](std::int32_t step) {
    return std::clamp((step * percent + 50) / 100, 1, 255);
  });
  return steps;
}

std::int64_t rounded_quotient(std::int64_t value, std::int64_t divisor) {
  const std::int64_t half = divisor / 2;
  return value >= 0 ? (value + half) / divisor : -((half - value) / divisor);
}

}  // namespace

JpegLoss::JpegLoss(int quality)
    : luma_(scaled(standard_luma, quality)), chroma_(scaled(standard_chroma, quality)) {
  for (int frequency = 0; frequency < block_size; ++frequency)
    for (int place = 0; place < block_size; ++place) {
      const double norm = frequency == 0 ? std::sqrt(0.125) : 0.5;
      const double angle = (2 * place + 1) * frequency * std::numbers::pi / 16.0;
      cosines_q13_[static_cast<std::size_t>(frequency * block_size + place)] =
          static_cast<std::int32_t>(std::lround(norm * std::cos(angle) * (1 << cosine_bits)));
    }
}

void JpegLoss::degrade(Block& block, const Steps& steps) const {
  // Sums of eight products: 32 bits hold those of the samples, 64 the rest.
  std::array<std::int64_t, block_samples> along_rows{}, spectrum{};
  const auto cosine = [&](std::size_t frequency, std::size_t place) -> std::int64_t {
    return cosines_q13_[frequency * block_size + place];
  };
  constexpr std::size_t size = block_size;
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t f = 0; f < size; ++f)
      for (std::size_t x = 0; x < size; ++x)
        along_rows[y * size + f] += cosine(f, x) * (block[y * size + x] - middle);
  for (std::size_t g = 0; g < size; ++g)
    for (std::size_t f = 0; f < size; ++f) {
      std::int64_t sum = 0;
      for (std::size_t y = 0; y < size; ++y) sum += cosine(g, y) * along_rows[y * size + f];
      const std::int64_t step = steps[g * size + f];
      spectrum[g * size + f] = step * rounded_quotient(sum, step << product_bits);
    }
  along_rows.fill(0);
  for (std::size_t g = 0; g < size; ++g)
    for (std::size_t f = 0; f < size; ++f) {
      if (spectrum[g * size + f] == 0) continue;
      for (std::size_t x = 0; x < size; ++x)
        along_rows[g * size + x] += cosine(f, x) * spectrum[g * size + f];
    }
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t x = 0; x < size; ++x) {
      std::int64_t sum = 0;
      for (std::size_t g = 0; g < size; ++g) sum += cosine(g, y) * along_rows[g * size + x];
      const auto sample = static_cast<std::int32_t>(
          (sum + (std::int64_t{1} << (product_bits - 1))) >> product_bits);
      block[y * size + x] = std::clamp(sample + middle, 0, 255);
    }
}

void JpegLoss::degrade_plane(base::Image& image, int first, int stride, int columns,
                             const Steps& steps) const {
  const int rows = image.view().height_px;
  Block block;
  for (int top = 0; top < rows; top += block_size)
    for (int left = 0; left < columns; left += block_size) {
      // A block that is not whole goes on with the picture's last row and column.
      for (int i = 0; i < static_cast<int>(block_samples); ++i) {
        const int y = std::min(top + i / block_size, rows - 1);
        const int x = std::min(left + i % block_size, columns - 1);
        block[static_cast<std::size_t>(i)] = image.row(y)[first + stride * x];
      }
      degrade(block, steps);
      for (int i = 0; i < static_cast<int>(block_samples); ++i) {
        const int y = top + i / block_size, x = left + i % block_size;
        if (y < rows && x < columns)
          image.row(y)[first + stride * x] =
              static_cast<std::uint8_t>(block[static_cast<std::size_t>(i)]);
      }
    }
}

void JpegLoss::degrade(base::Image& yuyv) const {
  const int width = yuyv.view().width_px;
  degrade_plane(yuyv, 0, 2, width, luma_);
  degrade_plane(yuyv, 1, 4, width / 2, chroma_);
  degrade_plane(yuyv, 3, 4, width / 2, chroma_);
}

}  // namespace gazed::sim
