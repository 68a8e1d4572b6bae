#include "drivers/sim/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "agent/base/random.hpp"
#include "drivers/sim/interpolation.hpp"

namespace gazed::sim {

namespace {

constexpr int tile_size = 512;
constexpr int blob_size = 16;                     // samples between the nodes of Pattern::noise
constexpr int largest_blob_size = tile_size / 4;  // of Pattern::natural
// Of Pattern::leaves, in samples. A leaf covers pi 2 r0^2 ln(r1/r0) / (1 - (r0/r1)^2) = 104 samples
// on average: so many cover the tile 8 times, and leave one sample in 3000 bare.
constexpr double smallest_leaf = 2.0, largest_leaf = 128.0;
constexpr int leaf_count = 20'000;
constexpr double tile_sigma = 8.0 * MipMap::sample_scale;  // samples for one standard deviation

/// Between -1 and 1, in Q16.
std::int32_t noise_level(base::Random& random) {
  return static_cast<std::int32_t>(random.bits() >> 47U) - (1 << 16);
}

/// Adds value noise: random numbers on a periodic lattice, `cell` samples apart, joined smoothly.
/// One octave is -1 to 1 in Q16; all eight together have 20 bits.
void add_octave(std::vector<std::int32_t>& tile, int cell, base::Random& random) {
  const int nodes = tile_size / cell;
  std::vector<std::int32_t> lattice(static_cast<std::size_t>(nodes) *
                                    static_cast<std::size_t>(nodes));
  for (std::int32_t& value : lattice) value = noise_level(random);
  std::vector<std::int32_t> fade;
  for (int i = 0; i < cell; ++i) {
    const double t = (i + 0.5) / cell;
    fade.push_back(static_cast<std::int32_t>(t * t * (3.0 - 2.0 * t) * (1 << share_bits)));
  }
  const auto node = [&](int x, int y) {
    return lattice[static_cast<std::size_t>((y % nodes) * nodes + x % nodes)];
  };
  std::vector<std::int32_t> row(static_cast<std::size_t>(nodes) + 1);  // at the nodes' columns
  auto sample = tile.begin();
  for (int y = 0; y < tile_size; ++y) {
    const std::int32_t down = fade[static_cast<std::size_t>(y % cell)];
    for (int x = 0; x <= nodes; ++x) {
      const std::int32_t above = node(x, y / cell), below = node(x, y / cell + 1);
      row[static_cast<std::size_t>(x)] = between(above, below, down);
    }
    for (auto left = row.begin(); left + 1 != row.end(); ++left)
      for (const std::int32_t right : fade) *sample++ += between(left[0], left[1], right);
  }
}

/// Dead leaves: discs that hide each other, their radii distributed as 1 / radius^3, which makes
/// the picture look the same at every scale. With three channels half of a leaf's variance is its
/// brightness, which they share, the other half is each channel's own.
template <std::size_t channels>
void add_leaves(std::vector<std::int32_t>& tile, base::Random& random) {
  for (int leaf = 0; leaf < leaf_count; ++leaf) {
    // Inverse of the distribution function, 1/r^2 uniform between both ends.
    constexpr double most = 1.0 / (smallest_leaf * smallest_leaf);
    constexpr double least = 1.0 / (largest_leaf * largest_leaf);
    const double radius = 1.0 / std::sqrt(most - random.uniform() * (most - least));
    const double centre_x = tile_size * random.uniform(), centre_y = tile_size * random.uniform();
    std::array<std::int32_t, channels> level;
    level.fill(noise_level(random));
    if constexpr (channels > 1)
      for (std::int32_t& of_channel : level) of_channel += noise_level(random);
    const auto first_row = static_cast<int>(std::ceil(centre_y - radius));
    for (int y = first_row; y <= centre_y + radius; ++y) {
      const double half_width =
          std::sqrt(std::max(0.0, radius * radius - (y - centre_y) * (y - centre_y)));
      const auto first = static_cast<int>(std::ceil(centre_x - half_width));
      for (int x = first; x <= centre_x + half_width; ++x) {
        const int sample = (y & (tile_size - 1)) * tile_size + (x & (tile_size - 1));
        std::copy(level.begin(), level.end(),
                  tile.begin() + static_cast<std::ptrdiff_t>(channels) * sample);
      }
    }
  }
}

/// The integral of a square wave of period 2 that is +1 on [0, 1) and -1 on [1, 2), in Q16.
std::int32_t triangle(std::uint32_t x_q16) {
  constexpr std::int32_t cell = 1 << 16;
  return cell - std::abs(static_cast<std::int32_t>(x_q16 & (2 * cell - 1)) - cell);
}

/// Means of that wave over [x - width/2, x + width/2].
class FilteredSquareWave {
 public:
  explicit FilteredSquareWave(float width) {
    // A cell of over 1000 pixels has edges of 65 steps all the same.
    constexpr float least = 1e-3F, most = 1e4F;
    if (!(width > least)) width = least;  // nor a number
    if (width > most) width = most;
    half_width_q16_ = static_cast<std::uint32_t>(width * 0x1p15F);
    per_width_q16_ = static_cast<std::int64_t>(0x1p31 / half_width_q16_);
  }

  /// -1 to 1 in Q14. The rise is up to the width, so that the product is up to 2^32.
  [[nodiscard]] std::int32_t at(std::int32_t x_q16) const {
    const auto x = static_cast<std::uint32_t>(x_q16);
    const std::int64_t rise = triangle(x + half_width_q16_) - triangle(x - half_width_q16_);
    return static_cast<std::int32_t>((rise * per_width_q16_) >> 18);
  }

 private:
  std::uint32_t half_width_q16_;
  std::int64_t per_width_q16_;
};

}  // namespace

bool is_tiled(Pattern pattern) {
  return pattern == Pattern::noise || pattern == Pattern::natural || pattern == Pattern::leaves ||
         pattern == Pattern::collage;
}

std::shared_ptr<const MipMap> make_noise_tile(Pattern pattern, std::uint32_t seed) {
  base::Random random(seed, static_cast<std::uint64_t>(pattern));
  const int channels = pattern == Pattern::collage ? 3 : 1;
  std::vector<std::int32_t> tile(static_cast<std::size_t>(channels) * tile_size * tile_size);
  if (pattern == Pattern::noise) {
    add_octave(tile, blob_size, random);
  } else if (pattern == Pattern::leaves) {
    add_leaves<1>(tile, random);
  } else if (pattern == Pattern::collage) {
    add_leaves<3>(tile, random);
  } else {
    for (int cell = largest_blob_size; cell >= 1; cell /= 2) add_octave(tile, cell, random);
  }
  std::int64_t sum = 0, sum_of_squares = 0;
  for (const std::int64_t value : tile) {
    sum += value;
    sum_of_squares += value * value;  // 3 x 2^18 values of 20 bits: 60 bits
  }
  const double count = static_cast<double>(tile.size()), mean = static_cast<double>(sum) / count;
  const double sigma = std::sqrt(static_cast<double>(sum_of_squares) / count - mean * mean);
  const auto scale_q32 = static_cast<std::int64_t>(tile_sigma / sigma * 0x1p32);
  const std::int64_t mean_sample = std::llround(mean);
  std::vector<std::int16_t> samples;
  samples.reserve(tile.size());
  for (const std::int64_t value : tile)
    samples.push_back(static_cast<std::int16_t>(
        ((value - mean_sample) * scale_q32 + (std::int64_t{1} << 31)) >> 32));
  return std::make_shared<const MipMap>(tile_size, tile_size, channels, true, std::move(samples));
}

TextureSampler::TextureSampler(const Texture& texture, double half_width_m, double half_height_m,
                               std::shared_ptr<const MipMap> noise_tile)
    : pattern_(texture.pattern), map_(std::move(noise_tile)) {
  for (std::size_t c = 0; c < 3; ++c) {
    colour_[c] = light_of(texture.colour[c]);
    colour_2_[c] = light_of(texture.colour_2[c]);
  }
  if (pattern_ == Pattern::image) {
    map_ = texture.image;
    per_m_x_ = map_->width() / (2.0 * half_width_m);
    per_m_y_ = map_->height() / (2.0 * half_height_m);
    offset_x_ = 0.5 * map_->width();
    offset_y_ = 0.5 * map_->height();
  } else if (pattern_ == Pattern::checker) {
    per_m_x_ = per_m_y_ = 1.0 / texture.cell_m;
  } else {
    per_m_x_ = per_m_y_ = tile_size / texture.tile_m;
    constexpr double light_of_value =
        (1 << light_fraction_bits) * MipMap::sample_scale / (tile_sigma * MipMap::value_scale);
    contrast_q12_ = std::llround(texture.contrast * light_of_value * 0x1p12);
  }
  gradient_u_ = texture.gradient[0] / half_width_m;
  gradient_v_ = texture.gradient[1] / half_height_m;
  vignette_u_ = 0.5 * texture.vignette / (half_width_m * half_width_m);
  vignette_v_ = 0.5 * texture.vignette / (half_height_m * half_height_m);
  light_ = texture.light;
  shaded_ = gradient_u_ != 0.0 || gradient_v_ != 0.0 || vignette_u_ != 0.0 || light_ != 1.0;
}

std::array<Light, 3> TextureSampler::sample(const SurfacePoint& point, float footprint_m) const {
  std::array<Light, 3> rgb;
  sample(point, point, point, footprint_m, rgb);
  return rgb;
}

void TextureSampler::sample(const SurfacePoint& first, const SurfacePoint& middle,
                            const SurfacePoint& last, float footprint_m,
                            std::span<Light> rgb) const {
  const int end = static_cast<int>(rgb.size() / 3) - 1;
  const auto course = [&](double at_first, double at_middle, double at_last) {
    return Course(at_first, at_middle, at_last, end);
  };
  const auto x = [&](const SurfacePoint& point) { return point.u_m * per_m_x_ + offset_x_; };
  const auto y = [&](const SurfacePoint& point) { return point.v_m * per_m_y_ + offset_y_; };
  const Course course_x = course(x(first), x(middle), x(last));
  const Course course_y = course(y(first), y(middle), y(last));
  switch (pattern_) {
    case Pattern::solid:
      for (std::size_t i = 0; i < rgb.size(); i += 3)
        std::copy(colour_.begin(), colour_.end(), &rgb[i]);
      break;
    case Pattern::checker:
      paint_checker(course_x, course_y, footprint_m, rgb);
      break;
    case Pattern::noise:
    case Pattern::natural:
    case Pattern::leaves:
    case Pattern::collage:
    case Pattern::image:
      paint_map(course_x, course_y, footprint_m, rgb);
      break;
  }
  if (!shaded_) return;
  Course light = course(light_at(first), light_at(middle), light_at(last));
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const std::int64_t light_q16 = std::max(light.next(), 0);
    for (std::size_t c = 0; c < 3; ++c) rgb[i + c] = rounded_light(rgb[i + c] * light_q16, 16);
  }
}

double TextureSampler::light_at(const SurfacePoint& point) const {
  return light_ * (1.0 + gradient_u_ * point.u_m + gradient_v_ * point.v_m -
                   vignette_u_ * point.u_m * point.u_m - vignette_v_ * point.v_m * point.v_m);
}

void TextureSampler::paint_checker(Course x, Course y, float footprint_m,
                                   std::span<Light> rgb) const {
  const FilteredSquareWave wave(footprint_m * static_cast<float>(per_m_x_));
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const std::int32_t along_x = wave.at(x.next()), along_y = wave.at(y.next());
    const std::int64_t second_q15 = (1 << 14) - ((along_x * along_y) >> 14);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t first_q15 = (1 << 15) - second_q15;
      rgb[i + c] = rounded_light(colour_[c] * first_q15 + colour_2_[c] * second_q15, 15);
    }
  }
}

void TextureSampler::paint_map(Course x, Course y, float footprint_m, std::span<Light> rgb) const {
  std::array<std::int32_t, 3 * longest_run_px> room;
  const std::size_t pixels = rgb.size() / 3;
  const auto channels = static_cast<std::size_t>(map_->channels());
  const std::span values = std::span(room).first(pixels * channels);
  map_->sample(x, y, footprint_m * static_cast<float>(std::max(per_m_x_, per_m_y_)), values);
  if (pattern_ == Pattern::image) {
    constexpr int extra_bits = 3;  // of Q9.8
    std::transform(values.begin(), values.end(), rgb.begin(),
                   [](std::int32_t value) { return rounded_light(value, extra_bits); });
    return;
  }
  // Values of 18 bits times a contrast of 14: that of 128 levels is 2^13.
  const std::size_t next_channel = channels / 3;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t more = values[channels * i + next_channel * c] * contrast_q12_;
      rgb[3 * i + c] = rounded_light((std::int64_t{colour_[c]} << 12) + more, 12);
    }
}

}  // namespace gazed::sim
