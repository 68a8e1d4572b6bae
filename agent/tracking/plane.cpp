#include "agent/tracking/plane.hpp"

#include <algorithm>
#include <cstdint>

namespace gazed::tracking {

namespace {

// The largest multiple of `step` not above `value`, and the smallest not below.
int floor_to(int value, int step) {
  const int remainder = value % step;
  return value - (remainder < 0 ? remainder + step : remainder);
}
int ceil_to(int value, int step) {
  return floor_to(value + step - 1, step);
}

std::size_t area(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

PixelBox on_grid(const PixelBox& box, int step) {
  return {floor_to(box.x_begin, step), floor_to(box.y_begin, step), ceil_to(box.x_end, step),
          ceil_to(box.y_end, step)};
}

// The intersection of two boxes. If they are disjoint, the part of `other` nearest to `box`, at
// least one pixel wide.
PixelBox common(const PixelBox& box, const PixelBox& other) {
  PixelBox both;
  both.x_begin = std::clamp(box.x_begin, other.x_begin, other.x_end - 1);
  both.y_begin = std::clamp(box.y_begin, other.y_begin, other.y_end - 1);
  both.x_end = std::clamp(box.x_end, both.x_begin + 1, other.x_end);
  both.y_end = std::clamp(box.y_end, both.y_begin + 1, other.y_end);
  return both;
}

// Outside the frame the border pixels are repeated, so from two steps out a reduction's samples
// repeat too (its filter and those of the finer levels reach less far). The last two samples next
// to the end of the projected part are wrong, because their filter saw that end.
constexpr int spoilt_by_end = 2;
constexpr int beyond_frame_steps = 3 + spoilt_by_end;

// Widens the coarsest level from the projected part to the whole region.
void widen(PlaneLevel& level, const PixelBox& seen, const PixelBox& region) {
  const auto added = [&](int px) { return px / level.step_px; };
  const int left = added(seen.x_begin - region.x_begin), right = added(region.x_end - seen.x_end);
  const int top = added(seen.y_begin - region.y_begin), bottom = added(region.y_end - seen.y_end);
  if (left + right + top + bottom == 0) return;
  const int width = level.width + left + right, height = level.height + top + bottom;
  level.samples.resize(area(width, height));
  float* samples = level.samples.data();
  const int spoilt_columns = std::min(spoilt_by_end, (level.width - 1) / 2);
  const int spoilt_rows = std::min(spoilt_by_end, (level.height - 1) / 2);
  // Goes from the last row backwards, so that no sample is overwritten before it is moved.
  for (int y = level.height - 1; y >= 0; --y) {
    const float* from = samples + static_cast<std::ptrdiff_t>(level.width) * y;
    float* row = samples + static_cast<std::ptrdiff_t>(width) * (y + top);
    std::copy_backward(from, from + level.width, row + left + level.width);
    if (left > 0) std::fill(row, row + left + spoilt_columns, row[left + spoilt_columns]);
    if (right > 0) {
      float* end = row + left + level.width - spoilt_columns;
      std::fill(end, row + width, end[-1]);
    }
  }
  const auto repeat = [&](int row, int from, int to) {
    const float* values = samples + static_cast<std::ptrdiff_t>(width) * row;
    for (int y = from; y < to; ++y) {
      std::copy(values, values + width, samples + static_cast<std::ptrdiff_t>(width) * y);
    }
  };
  if (top > 0) repeat(top + spoilt_rows, 0, top + spoilt_rows);
  if (bottom > 0) {
    const int end = top + level.height - spoilt_rows;
    repeat(end - 1, end, height);
  }
  level.width = width;
  level.height = height;
  level.origin_px -= Eigen::Vector2d(left, top) * level.step_px;
}

// Projects row `y` of the frame, columns [x_begin, x_begin + count), all inside the frame.
void project_row(const base::ImageView& image, const Eigen::Vector3f& axis, int y, int x_begin,
                 int count, float* out) {
  const float a = axis[0], b = axis[1], c = axis[2];
  const std::uint8_t* row = image.row(y);
  switch (image.format) {
    case base::PixelFormat::grey:
      for (int i = 0; i < count; ++i) out[i] = a * static_cast<float>(row[x_begin + i]);
      return;
    case base::PixelFormat::rgb24:
      row += 3 * x_begin;
      for (int i = 0; i < count; ++i, row += 3) {
        out[i] = a * static_cast<float>(row[0]) + b * static_cast<float>(row[1]) +
                 c * static_cast<float>(row[2]);
      }
      return;
    case base::PixelFormat::yuyv:
      // A pair's chroma lies half way between its two pixels, so each pixel takes three quarters of
      // its own pair's and one quarter of the nearer neighbour's.
      for (int i = 0; i < count; ++i) {
        const int x = x_begin + i, pair = x / 2, last = image.width_px / 2 - 1;
        const int own = std::min(pair, last);
        const int other = std::clamp(x % 2 == 0 ? pair - 1 : pair + 1, 0, last);
        const auto chroma = [&](int offset) {
          return 0.75F * static_cast<float>(row[4 * own + offset]) +
                 0.25F * static_cast<float>(row[4 * other + offset]);
        };
        out[i] = a * static_cast<float>(row[2 * x]) + b * chroma(1) + c * chroma(3);
      }
      return;
  }
}

}  // namespace

Eigen::Vector3f colour_at(const base::ImageView& image, int x, int y) {
  const std::uint8_t* row = image.row(y);
  switch (image.format) {
    case base::PixelFormat::grey:
      return {static_cast<float>(row[x]), 0.0F, 0.0F};
    case base::PixelFormat::rgb24:
      return {static_cast<float>(row[3 * x]), static_cast<float>(row[3 * x + 1]),
              static_cast<float>(row[3 * x + 2])};
    case base::PixelFormat::yuyv: {
      const int pair = std::min(x / 2, image.width_px / 2 - 1);
      return {static_cast<float>(row[2 * x]), static_cast<float>(row[4 * pair + 1]),
              static_cast<float>(row[4 * pair + 3])};
    }
  }
  return Eigen::Vector3f::Zero();
}

void PlanePyramid::reserve_full(int frame_width_px, int frame_height_px) {
  const int beyond = 2 * (beyond_frame_steps + 1) << (max_levels - 1);
  levels_[0].samples.reserve(area(frame_width_px + beyond, frame_height_px + beyond));
}

void PlanePyramid::reserve_reduced(int width_px, int height_px) {
  const int grid = 1 << (max_levels - 1);
  const int width = width_px + 2 * grid, height = height_px + 2 * grid;
  row_.reserve(static_cast<std::size_t>(width));
  above_.reserve(static_cast<std::size_t>(width));
  // Any of them may be the coarsest.
  for (int i = 1; i < max_levels; ++i) {
    levels_[static_cast<std::size_t>(i)].samples.reserve(area((width >> i) + 1, (height >> i) + 1));
  }
}

void PlanePyramid::build(const base::ImageView& image, const Eigen::Vector3f& axis, PixelBox region,
                         int levels) {
  level_count_ = levels;
  const int grid = 1 << (levels - 1), beyond = beyond_frame_steps * grid;
  region = on_grid(region, grid);
  const PixelBox seen = on_grid(
      common({-beyond, -beyond, image.width_px + beyond, image.height_px + beyond}, region), grid);
  project(image, axis, seen);
  smooth(levels_[0]);
  for (std::size_t i = 1; i < static_cast<std::size_t>(levels); ++i) {
    reduce(levels_[i - 1], levels_[i]);
  }
  widen(levels_[static_cast<std::size_t>(levels - 1)], seen, region);
}

// Projects the part of level 0 in `box`, repeating the frame's border pixels beyond it.
void PlanePyramid::project(const base::ImageView& image, const Eigen::Vector3f& axis,
                           const PixelBox& box) {
  PlaneLevel& full = levels_[0];
  full.step_px = 1;
  full.width = box.width();
  full.height = box.height();
  full.origin_px = {box.x_begin, box.y_begin};
  full.samples.resize(area(full.width, full.height));

  // The part of the row inside the frame, and how often its end pixels are repeated.
  const int first = std::clamp(box.x_begin, 0, image.width_px - 1);
  const int last = std::clamp(box.x_end - 1, first, image.width_px - 1);
  const int left = std::clamp(first - box.x_begin, 0, full.width - 1);
  const int count = std::min(last - first + 1, full.width - left);
  float* out = full.samples.data();
  for (int y = box.y_begin; y < box.y_end; ++y, out += full.width) {
    project_row(image, axis, std::clamp(y, 0, image.height_px - 1), first, count, out + left);
    std::fill(out, out + left, out[left]);
    std::fill(out + left + count, out + full.width, out[left + count - 1]);
  }
}

// [1 2 1]/4 in both directions, in place; the region's border samples are not changed.
void PlanePyramid::smooth(PlaneLevel& level) {
  const int width = level.width;
  row_.resize(static_cast<std::size_t>(width));
  above_.assign(level.row(0), level.row(0) + width);
  for (int y = 1; y + 1 < level.height; ++y) {
    float* here = level.samples.data() + static_cast<std::ptrdiff_t>(width) * y;
    const float *above = above_.data(), *below = here + width;
    float* sum = row_.data();
    for (int x = 0; x < width; ++x) sum[x] = above[x] + 2.0F * here[x] + below[x];
    std::copy(here, here + width, above_.begin());
    for (int x = 1; x + 1 < width; ++x) {
      here[x] = (sum[x - 1] + 2.0F * sum[x] + sum[x + 1]) * (1.0F / 16.0F);
    }
  }
}

void PlanePyramid::reduce(const PlaneLevel& fine, PlaneLevel& coarse) {
  coarse.step_px = 2 * fine.step_px;
  coarse.width = (fine.width + 1) / 2;
  coarse.height = (fine.height + 1) / 2;
  coarse.origin_px = fine.origin_px;
  coarse.samples.resize(area(coarse.width, coarse.height));
  row_.resize(static_cast<std::size_t>(fine.width));
  float* out = coarse.samples.data();
  for (int y = 0; y < coarse.height; ++y, out += coarse.width) {
    const auto line = [&](int offset) {
      return fine.row(std::clamp(2 * y + offset, 0, fine.height - 1));
    };
    const float *r0 = line(-2), *r1 = line(-1), *r2 = line(0), *r3 = line(1), *r4 = line(2);
    float* row = row_.data();
    for (int x = 0; x < fine.width; ++x) {
      row[x] = (r0[x] + r4[x] + 4.0F * (r1[x] + r3[x]) + 6.0F * r2[x]) * (1.0F / 256.0F);
    }
    const auto at = [&](int x) { return row[std::clamp(x, 0, fine.width - 1)]; };
    const auto filtered = [&](int x, auto&& get) {
      return get(x - 2) + get(x + 2) + 4.0F * (get(x - 1) + get(x + 1)) + 6.0F * get(x);
    };
    const int interior_end = (fine.width - 3) / 2;  // 2 x + 2 <= width - 1
    for (int x = 1; x <= interior_end; ++x) {
      out[x] = filtered(2 * x, [row](int i) { return row[i]; });
    }
    out[0] = filtered(0, at);
    for (int x = std::max(1, interior_end + 1); x < coarse.width; ++x) out[x] = filtered(2 * x, at);
  }
}

}  // namespace gazed::tracking
