#include "drivers/sim/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "agent/base/random.hpp"

namespace gazed::sim {

namespace {

constexpr unsigned quantile_bits = 12;
constexpr std::size_t quantiles = 1U << quantile_bits;
constexpr std::size_t values_per_draw = 5;  // of noise: 60 of 64 bits
constexpr double kernel_reach = 3.0;        // sigmas
constexpr int fraction_bits = 16;           // of a grey level
// Far above white; with noise, at most 3.7 x 50 levels, the sum stays below 2^15.
constexpr std::int64_t brightest = std::int64_t{30000} << fraction_bits;
constexpr int weight_bits = 14;  // of the blur's weights: their sum, 2^14, is a number of 16 bits

std::vector<std::int16_t> gaussian_kernel(double sigma_px, int radius) {
  const auto height = [&](int i) {
    return i == 0 ? 1.0 : std::exp(-0.5 * i * i / (sigma_px * sigma_px));
  };
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += height(i);
  std::vector<std::int16_t> kernel;
  for (int i = -radius; i <= radius; ++i)
    kernel.push_back(static_cast<std::int16_t>(std::lround(height(i) / sum * (1 << weight_bits))));
  // What rounding took or gave goes to the middle: an even light stays as it is.
  const int rounded_sum = std::accumulate(kernel.begin(), kernel.end(), 0);
  kernel[static_cast<std::size_t>(radius)] +=
      static_cast<std::int16_t>((1 << weight_bits) - rounded_sum);
  return kernel;
}

/// Adds a row, weighted. 32 bits hold it: Q10.5 of 16 bits, and weights whose sum is 2^14.
void add_weighted(const Light* row, std::int16_t weight, std::span<std::int32_t> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * row[i];
}

/// Their mean, rounded: it has 16 bits like they.
Light mean_of(std::int32_t weighted_sum) {
  return static_cast<Light>((weighted_sum + (1 << (weight_bits - 1))) >> weight_bits);
}

/// Equally likely values of a normal distribution with mean 0, the largest 3.7 sigma; their
/// standard deviation is exactly `sigma`.
std::vector<std::int32_t> normal_quantiles(double sigma) {
  std::vector<double> upper;
  double z = 0.0, sum_of_squares = 0.0;
  for (std::size_t i = 0; i < quantiles / 2; ++i) {
    const double share = 0.5 - (static_cast<double>(i) + 0.5) / static_cast<double>(quantiles);
    for (int step = 0; step < 8; ++step) {  // Newton from the left on a concave function
      const double excess = 0.5 * std::erfc(z / std::numbers::sqrt2) - share;
      z += excess * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * z * z);
    }
    upper.push_back(z);
    sum_of_squares += z * z;
  }
  const double scale = sigma / std::sqrt(sum_of_squares / static_cast<double>(upper.size()));
  std::vector<std::int32_t> values;
  for (const double value : upper) {
    values.push_back(static_cast<std::int32_t>(std::lround(value * scale * (1 << fraction_bits))));
    values.push_back(-values.back());
  }
  return values;
}

std::uint8_t to_byte(std::int32_t q16) {
  return static_cast<std::uint8_t>(
      std::clamp((q16 + (1 << (fraction_bits - 1))) >> fraction_bits, 0, 255));
}

}  // namespace

Sensor::Sensor(int width_px, int height_px, const CameraBehaviour& behaviour, std::uint64_t seed)
    : width_px_(width_px),
      height_px_(height_px),
      format_(behaviour.format),
      exposure_q16_(exposure_factor(behaviour.exposure)),
      noise_state_(seed),
      image_(width_px, height_px, behaviour.format) {
  if (behaviour.blur_sigma_px > 0.0)
    radius_ = static_cast<int>(std::ceil(kernel_reach * behaviour.blur_sigma_px));
  kernel_ = gaussian_kernel(behaviour.blur_sigma_px, radius_);
  const std::size_t row_size = 3U * static_cast<std::size_t>(width_px);
  light_.resize(row_size * static_cast<std::size_t>(height_px));
  exposures_q16_.resize(static_cast<std::size_t>(height_px));
  exposed_.resize(row_size);
  bytes_.resize(row_size);
  if (behaviour.pixel_noise > 0.0) noise_ = normal_quantiles(behaviour.pixel_noise);
  if (behaviour.jpeg_quality > 0) jpeg_.emplace(behaviour.jpeg_quality);
}

void Sensor::add_row(std::span<const Light> rgb) {
  if (rows_in_ == height_px_) rows_in_ = 0;
  blur_along_row(rgb, row(rows_in_));
  ++rows_in_;
  if (rows_in_ > radius_) expose_row(rows_in_ - 1 - radius_, exposure_q16_);
}

base::ImageView Sensor::finish() {
  for (int y = std::max(rows_in_ - radius_, 0); y < rows_in_; ++y) expose_row(y, exposure_q16_);
  if (jpeg_) jpeg_->degrade(image_);
  return image_.view();
}

base::ImageView Sensor::finish_again() {
  for (int y = 0; y < height_px_; ++y) write_row(y);
  if (jpeg_) jpeg_->degrade(image_);
  return image_.view();
}

base::ImageView Sensor::finish_nothing() {
  const std::size_t draws_per_row = (exposed_.size() + values_per_draw - 1) / values_per_draw;
  if (!noise_.empty())
    base::skip_split_mix(noise_state_, draws_per_row * static_cast<std::size_t>(height_px_));
  return image_.view();
}

void Sensor::expose_row(int y, std::int64_t exposure_q16) {
  exposures_q16_[static_cast<std::size_t>(y)] = exposure_q16;
  write_row(y);
}

std::span<Light> Sensor::row(int y) {
  return std::span(light_).subspan(static_cast<std::size_t>(y) * exposed_.size(), exposed_.size());
}

void Sensor::blur_along_row(std::span<const Light> rgb, std::span<Light> blurred) {
  if (radius_ == 0) {
    std::copy(rgb.begin(), rgb.end(), blurred.begin());
    return;
  }
  const auto size = static_cast<std::ptrdiff_t>(rgb.size());
  const std::ptrdiff_t reach = std::min<std::ptrdiff_t>(3 * radius_, size);
  const auto clamped = [&](std::ptrdiff_t i) {  // the border pixel goes on for ever
    std::int32_t sum = 0;
    for (int k = -radius_; k <= radius_; ++k) {
      std::ptrdiff_t at = i + std::ptrdiff_t{3} * k;
      if (at < 0) at = i % 3;
      if (at >= size) at = size - 3 + i % 3;
      sum += kernel_[static_cast<std::size_t>(k + radius_)] * rgb[static_cast<std::size_t>(at)];
    }
    blurred[static_cast<std::size_t>(i)] = mean_of(sum);
  };
  for (std::ptrdiff_t i = 0; i < reach; ++i) clamped(i);
  for (std::ptrdiff_t i = std::max(size - reach, reach); i < size; ++i) clamped(i);
  if (size <= 2 * reach) return;
  const auto inner =
      blurred.subspan(static_cast<std::size_t>(reach), static_cast<std::size_t>(size - 2 * reach));
  const std::span<std::int32_t> sums = std::span(exposed_).first(inner.size());
  std::fill(sums.begin(), sums.end(), 0);
  for (std::size_t k = 0; k < kernel_.size(); ++k)
    add_weighted(rgb.data() + 3 * k, kernel_[k], sums);
  std::transform(sums.begin(), sums.end(), inner.begin(), mean_of);
}

void Sensor::write_row(int y) {
  std::ranges::fill(exposed_, 0);
  for (int k = -radius_; k <= radius_; ++k) {
    add_weighted(row(std::clamp(y + k, 0, height_px_ - 1)).data(),
                 kernel_[static_cast<std::size_t>(k + radius_)], exposed_);
  }
  // 30 bits times the exposure's, up to 33.
  const std::int64_t exposure_q16 = exposures_q16_[static_cast<std::size_t>(y)];
  std::ranges::transform(exposed_, exposed_.begin(), [exposure_q16](std::int32_t sum) {
    constexpr int extra_bits = light_fraction_bits + weight_bits;
    return static_cast<std::int32_t>(
        std::clamp((sum * exposure_q16) >> extra_bits, -brightest, brightest));
  });
  if (format_ == base::PixelFormat::yuyv) {
    write_bytes(bytes_.data());
    write_yuyv(image_.row(y));
  } else {
    write_bytes(image_.row(y));
  }
}

void Sensor::write_bytes(std::uint8_t* out) {
  if (noise_.empty()) {
    std::transform(exposed_.begin(), exposed_.end(), out,
                   [](std::int32_t q16) { return to_byte(q16); });
    return;
  }
  for (std::size_t i = 0; i < exposed_.size();) {
    std::uint64_t bits = base::split_mix(noise_state_);
    const std::size_t end = std::min(i + values_per_draw, exposed_.size());
    for (; i < end; ++i, bits >>= quantile_bits)
      out[i] = to_byte(exposed_[i] + noise_[bits & (quantiles - 1)]);
  }
}

/// ITU-R BT.601, limited range; the two pixels of a pair share the mean of their chroma.
void Sensor::write_yuyv(std::uint8_t* out) const {
  constexpr auto q16 = [](double weight) {
    return static_cast<std::int32_t>(weight * 0x1p16 + (weight < 0.0 ? -0.5 : 0.5));
  };
  for (std::size_t x = 0; x + 1 < static_cast<std::size_t>(width_px_); x += 2, out += 4) {
    const std::uint8_t* a = bytes_.data() + 3 * x;
    const std::uint8_t* b = a + 3;
    const auto y = [&](const std::uint8_t* p) {
      return to_byte(q16(16.0) + q16(0.256788) * p[0] + q16(0.504129) * p[1] +
                     q16(0.097906) * p[2]);
    };
    const int r = a[0] + b[0], g = a[1] + b[1], blue = a[2] + b[2];
    const auto chroma = [&](double of_r, double of_g, double of_b) {
      return to_byte(q16(128.0) + q16(0.5 * of_r) * r + q16(0.5 * of_g) * g +
                     q16(0.5 * of_b) * blue);
    };
    out[0] = y(a);
    out[1] = chroma(-0.148223, -0.290993, 0.439216);
    out[2] = y(b);
    out[3] = chroma(0.439216, -0.367788, -0.071427);
  }
}

}  // namespace gazed::sim
