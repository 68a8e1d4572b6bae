#include "drivers/sim/texture.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/sim/random.hpp"

namespace gazed {

namespace {

constexpr int tile_size = 512;
constexpr int blob_size = 16;                     // samples between the nodes of Pattern::noise
constexpr int largest_blob_size = tile_size / 4;  // of Pattern::natural
// Of Pattern::leaves, in samples. A leaf covers pi 2 r0^2 ln(r1/r0) / (1 - (r0/r1)^2) = 104 samples
// on average: so many cover the tile 8 times, and leave one sample in 3000 bare.
constexpr double smallest_leaf = 2.0, largest_leaf = 128.0;
constexpr int leaf_count = 20'000;
constexpr float tile_sigma = 8.0F * MipMap::sample_scale;  // samples for one standard deviation

/// Adds value noise: random numbers on a periodic lattice, `cell` samples apart, joined smoothly.
void add_octave(std::vector<float>& tile, int cell, RandomStream& random) {
  const int nodes = tile_size / cell;
  std::vector<float> lattice(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes));
  for (float& value : lattice) value = static_cast<float>(random.symmetric());
  std::vector<float> fade(static_cast<std::size_t>(cell));
  for (int i = 0; i < cell; ++i) {
    const float t = (static_cast<float>(i) + 0.5F) / static_cast<float>(cell);
    fade[static_cast<std::size_t>(i)] = t * t * (3.0F - 2.0F * t);
  }
  const auto node = [&](int x, int y) {
    return lattice[static_cast<std::size_t>((y % nodes) * nodes + x % nodes)];
  };
  auto sample = tile.begin();
  for (int y = 0; y < tile_size; ++y) {
    const int ny = y / cell;
    const float fy = fade[static_cast<std::size_t>(y % cell)];
    for (int nx = 0; nx < nodes; ++nx) {
      const float left = node(nx, ny), step = node(nx + 1, ny) - left;
      const float left_below = node(nx, ny + 1), step_below = node(nx + 1, ny + 1) - left_below;
      for (const float fx : fade) {
        const float top = left + fx * step;
        const float bottom = left_below + fx * step_below;
        *sample++ += top + fy * (bottom - top);
      }
    }
  }
}

/// Dead leaves: discs that hide each other, their radii distributed as 1 / radius^3, which makes
/// the picture look the same at every scale.
void add_leaves(std::vector<float>& tile, RandomStream& random) {
  for (int leaf = 0; leaf < leaf_count; ++leaf) {
    // Inverse of the distribution function, 1/r^2 uniform between both ends.
    constexpr double most = 1.0 / (smallest_leaf * smallest_leaf);
    constexpr double least = 1.0 / (largest_leaf * largest_leaf);
    const double radius = 1.0 / std::sqrt(most - random.uniform() * (most - least));
    const double centre_x = tile_size * random.uniform(), centre_y = tile_size * random.uniform();
    const auto grey = static_cast<float>(random.symmetric());
    const auto first_row = static_cast<int>(std::ceil(centre_y - radius));
    for (int y = first_row; y <= centre_y + radius; ++y) {
      const double half_width =
          std::sqrt(std::max(0.0, radius * radius - (y - centre_y) * (y - centre_y)));
      const auto first = static_cast<int>(std::ceil(centre_x - half_width));
      for (int x = first; x <= centre_x + half_width; ++x)
        tile[static_cast<std::size_t>((y & (tile_size - 1)) * tile_size + (x & (tile_size - 1)))] =
            grey;
    }
  }
}

/// The integral of a square wave of period 2 that is +1 on [0, 1) and -1 on [1, 2).
float triangle(float x) {
  return 1.0F - std::abs(x - 2.0F * std::floor(x * 0.5F) - 1.0F);
}

/// The mean of that wave over [x - width/2, x + width/2].
float filtered_square_wave(float x, float width) {
  const float w = std::max(width, 1e-3F);
  return (triangle(x + 0.5F * w) - triangle(x - 0.5F * w)) / w;
}

}  // namespace

MipMap::MipMap(int width, int height, int channels, bool wraps, std::vector<std::int16_t> samples)
    : channels_(channels), wraps_(wraps) {
  levels_.push_back({width, height, std::move(samples)});
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(half(levels_.back()));
}

MipMap::Level MipMap::half(const Level& level) const {
  Level smaller{(level.width + 1) / 2, (level.height + 1) / 2, {}};
  smaller.samples.reserve(static_cast<std::size_t>(smaller.width) *
                          static_cast<std::size_t>(smaller.height) *
                          static_cast<std::size_t>(channels_));
  const auto at = [&](int x, int y, int channel) -> int {
    x = std::min(x, level.width - 1);
    y = std::min(y, level.height - 1);
    return level.samples[static_cast<std::size_t>((y * level.width + x) * channels_ + channel)];
  };
  for (int y = 0; y < smaller.height; ++y)
    for (int x = 0; x < smaller.width; ++x)
      for (int c = 0; c < channels_; ++c) {
        const int sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) + at(2 * x, 2 * y + 1, c) +
                        at(2 * x + 1, 2 * y + 1, c);
        smaller.samples.push_back(static_cast<std::int16_t>((sum + 2) >> 2));
      }
  return smaller;
}

template <int channels>
void MipMap::add_bilinear(const Level& level, float x, float y, float weight, float* values) const {
  const float x_floor = std::floor(x), y_floor = std::floor(y);
  const float fx = x - x_floor, fy = y - y_floor;
  int x0 = static_cast<int>(x_floor), y0 = static_cast<int>(y_floor);
  int x1 = x0 + 1, y1 = y0 + 1;
  if (wraps_) {
    x0 &= level.width - 1;
    x1 &= level.width - 1;
    y0 &= level.height - 1;
    y1 &= level.height - 1;
  } else {
    x0 = std::clamp(x0, 0, level.width - 1);
    x1 = std::clamp(x1, 0, level.width - 1);
    y0 = std::clamp(y0, 0, level.height - 1);
    y1 = std::clamp(y1, 0, level.height - 1);
  }
  const std::int16_t* row0 = level.samples.data() + y0 * level.width * channels;
  const std::int16_t* row1 = level.samples.data() + y1 * level.width * channels;
  for (int c = 0; c < channels; ++c) {
    const auto s00 = static_cast<float>(row0[x0 * channels + c]);
    const auto s10 = static_cast<float>(row0[x1 * channels + c]);
    const auto s01 = static_cast<float>(row1[x0 * channels + c]);
    const auto s11 = static_cast<float>(row1[x1 * channels + c]);
    const float top = s00 + fx * (s10 - s00), bottom = s01 + fx * (s11 - s01);
    values[c] += weight * (top + fy * (bottom - top));
  }
}

template <int channels>
void MipMap::sample_channels(float x, float y, float footprint, float* values) const {
  for (int c = 0; c < channels; ++c) values[c] = 0.0F;
  // Sample i of level n is the mean of samples 2^n i to 2^n (i + 1) - 1 of level 0.
  const auto at_level = [&](int n, float weight) {
    const float scale = 1.0F / static_cast<float>(1 << n);
    add_bilinear<channels>(levels_[static_cast<std::size_t>(n)], x * scale - 0.5F, y * scale - 0.5F,
                           weight / sample_scale, values);
  };
  if (!(footprint > 1.0F)) {
    at_level(0, 1.0F);
    return;
  }
  const float lod = std::min(std::log2(footprint), static_cast<float>(levels_.size() - 1));
  const int fine = static_cast<int>(lod);
  const float blend = lod - static_cast<float>(fine);
  at_level(fine, 1.0F - blend);
  if (blend > 0.0F) at_level(fine + 1, blend);
}

void MipMap::sample(float x, float y, float footprint, float* values) const {
  if (channels_ == 1)
    sample_channels<1>(x, y, footprint, values);
  else
    sample_channels<3>(x, y, footprint, values);
}

bool is_tiled(Pattern pattern) {
  return pattern == Pattern::noise || pattern == Pattern::natural || pattern == Pattern::leaves;
}

std::shared_ptr<const MipMap> make_noise_tile(Pattern pattern, std::uint32_t seed) {
  RandomStream random(seed, static_cast<std::uint64_t>(pattern));
  std::vector<float> tile(static_cast<std::size_t>(tile_size) * tile_size);
  if (pattern == Pattern::noise) {
    add_octave(tile, blob_size, random);
  } else if (pattern == Pattern::leaves) {
    add_leaves(tile, random);
  } else {
    for (int cell = largest_blob_size; cell >= 1; cell /= 2) add_octave(tile, cell, random);
  }
  double sum = 0.0, sum_of_squares = 0.0;
  for (const float value : tile) {
    sum += value;
    sum_of_squares += static_cast<double>(value) * value;
  }
  const double count = static_cast<double>(tile.size()), mean = sum / count;
  const double scale = tile_sigma / std::sqrt(sum_of_squares / count - mean * mean);
  std::vector<std::int16_t> samples;
  samples.reserve(tile.size());
  for (const float value : tile)
    samples.push_back(static_cast<std::int16_t>(std::lround((value - mean) * scale)));
  return std::make_shared<const MipMap>(tile_size, tile_size, 1, true, std::move(samples));
}

TextureSampler::TextureSampler(const Texture& texture, double half_width_m, double half_height_m,
                               std::shared_ptr<const MipMap> noise_tile)
    : pattern_(texture.pattern), map_(std::move(noise_tile)) {
  for (std::size_t c = 0; c < 3; ++c) {
    colour_[c] = static_cast<float>(texture.colour[c]);
    colour_2_[c] = static_cast<float>(texture.colour_2[c]);
  }
  if (pattern_ == Pattern::image) {
    map_ = texture.image;
    per_m_x_ = static_cast<float>(map_->width() / (2.0 * half_width_m));
    per_m_y_ = static_cast<float>(map_->height() / (2.0 * half_height_m));
    offset_x_ = 0.5F * static_cast<float>(map_->width());
    offset_y_ = 0.5F * static_cast<float>(map_->height());
  } else if (pattern_ == Pattern::checker) {
    per_m_x_ = per_m_y_ = static_cast<float>(1.0 / texture.cell_m);
  } else {
    per_m_x_ = per_m_y_ = static_cast<float>(tile_size / texture.tile_m);
    contrast_ = static_cast<float>(texture.contrast) * MipMap::sample_scale / tile_sigma;
  }
  gradient_u_ = static_cast<float>(texture.gradient[0] / half_width_m);
  gradient_v_ = static_cast<float>(texture.gradient[1] / half_height_m);
  vignette_u_ = static_cast<float>(0.5 * texture.vignette / (half_width_m * half_width_m));
  vignette_v_ = static_cast<float>(0.5 * texture.vignette / (half_height_m * half_height_m));
  shaded_ = gradient_u_ != 0.0F || gradient_v_ != 0.0F || vignette_u_ != 0.0F;
}

std::array<float, 3> TextureSampler::sample(float u_m, float v_m, float footprint_m) const {
  std::array<float, 3> rgb = colour_;
  const float x = u_m * per_m_x_ + offset_x_, y = v_m * per_m_y_ + offset_y_;
  switch (pattern_) {
    case Pattern::solid:
      break;
    case Pattern::checker: {
      const float width = footprint_m * per_m_x_;
      const float mix =
          0.5F - 0.5F * filtered_square_wave(x, width) * filtered_square_wave(y, width);
      for (std::size_t c = 0; c < 3; ++c) rgb[c] += mix * (colour_2_[c] - rgb[c]);
      break;
    }
    case Pattern::noise:
    case Pattern::natural:
    case Pattern::leaves: {
      float value = 0.0F;
      map_->sample(x, y, footprint_m * per_m_x_, &value);
      for (float& channel : rgb) channel += contrast_ * value;
      break;
    }
    case Pattern::image:
      map_->sample(x, y, footprint_m * std::max(per_m_x_, per_m_y_), rgb.data());
      break;
  }
  if (shaded_) {
    const float light = 1.0F + gradient_u_ * u_m + gradient_v_ * v_m - vignette_u_ * u_m * u_m -
                        vignette_v_ * v_m * v_m;
    for (float& channel : rgb) channel *= std::max(light, 0.0F);
  }
  return rgb;
}

}  // namespace gazed
