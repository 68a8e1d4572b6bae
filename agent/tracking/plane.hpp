// One grey plane of a frame's region, with reduced copies, read between its samples.
//
// A colour frame is projected on one direction of its colour space: one plane costs a third of
// three, and the direction in which the patch has most gradient carries most of what registration
// needs. Values are read through the cubic B-spline of the samples without the interpolating
// prefilter (Unser, IEEE Signal Processing Magazine 16(6), 1999): a smoothing with a variance of a
// third of a squared sample, twice continuously differentiable, with almost nothing left at the
// sampling frequency. Bilinear reading would pull sub-pixel answers towards whole and half pixels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"

namespace gazed::tracking {

/// A box of whole pixels; `x_end` and `y_end` are exclusive.
struct PixelBox {
  int x_begin = 0, y_begin = 0, x_end = 0, y_end = 0;

  [[nodiscard]] int width() const { return x_end - x_begin; }
  [[nodiscard]] int height() const { return y_end - y_begin; }
};

/// Colour of one pixel as the camera delivers it: r, g, b; or y, u, v; or grey, 0, 0. In YUYV both
/// pixels of a pair have the same chroma.
[[nodiscard]] Eigen::Vector3f colour_at(const base::ImageView& image, int x, int y);

/// Value of a plane at one place, and its slopes per sample spacing.
struct PlaneSample {
  float value = 0.0F;
  float dx = 0.0F;
  float dy = 0.0F;
};

/// The samples of one reduction: (column, row) is centred on pixel origin + step (column, row).
struct PlaneLevel {
  int step_px = 1;
  int width = 0;
  int height = 0;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();
  std::vector<float> samples;

  [[nodiscard]] const float* row(int y) const {
    return samples.data() + static_cast<std::ptrdiff_t>(width) * y;
  }
  [[nodiscard]] Eigen::Vector2d to_samples(const geometry::Pixel& pixel) const {
    return (pixel - origin_px) / step_px;
  }
  [[nodiscard]] geometry::Pixel to_pixel(const Eigen::Vector2d& at) const {
    return origin_px + step_px * at;
  }
  /// True if read() has all the samples it needs.
  [[nodiscard]] bool readable(const Eigen::Vector2d& at) const {
    return at.x() >= 1.0 && at.y() >= 1.0 && at.x() < width - 2 && at.y() < height - 2;
  }
  [[nodiscard]] PlaneSample read(const Eigen::Vector2d& at) const;
};

/// A region's plane and its copies reduced by 2, 4, ...; reuses its memory.
class PlanePyramid {
 public:
  static constexpr int max_levels = 5;

  /// Allocates level 0 for frames up to this size.
  void reserve_full(int frame_width_px, int frame_height_px);
  /// Allocates the other levels for regions up to this size.
  void reserve_reduced(int width_px, int height_px);
  /// Exchanges level 0, with its memory, for that of another pyramid.
  void swap_full(PlanePyramid& other) noexcept { std::swap(levels_[0], other.levels_[0]); }

  /// Projects `region` of the frame on `axis` and reduces it `levels` - 1 times by the binomial
  /// filter [1 4 6 4 1]/16. The region is widened to the grid of the coarsest level. It may extend
  /// beyond the frame: the coarsest level covers all of it with repeated border pixels, as a search
  /// needs; the others end a little outside the frame.
  void build(const base::ImageView& image, const Eigen::Vector3f& axis, PixelBox region,
             int levels);

  [[nodiscard]] int levels() const { return level_count_; }
  [[nodiscard]] const PlaneLevel& level(int index) const {
    return levels_[static_cast<std::size_t>(index)];
  }

 private:
  void project(const base::ImageView& image, const Eigen::Vector3f& axis, const PixelBox& box);
  void smooth(PlaneLevel& level);
  void reduce(const PlaneLevel& fine, PlaneLevel& coarse);

  std::array<PlaneLevel, max_levels> levels_;
  std::vector<float> row_, above_;
  int level_count_ = 0;
};

/// Weights of the four samples around a place, given its fraction in [0, 1) past the second.
[[nodiscard]] constexpr std::array<float, 4> cubic_weights(float f) {
  const float g = 1.0F - f;
  return {g * g * g / 6.0F, (4.0F - 3.0F * f * f * (1.0F + g)) / 6.0F,
          (4.0F - 3.0F * g * g * (1.0F + f)) / 6.0F, f * f * f / 6.0F};
}

inline PlaneSample PlaneLevel::read(const Eigen::Vector2d& at) const {
  const double column = std::floor(at.x()), line = std::floor(at.y());
  const auto fx = static_cast<float>(at.x() - column), fy = static_cast<float>(at.y() - line);
  const auto slopes = [](float f) {
    const float g = 1.0F - f;
    return std::array<float, 4>{-0.5F * g * g, f * (1.5F * f - 2.0F), g * (2.0F - 1.5F * g),
                                0.5F * f * f};
  };
  const auto wx = cubic_weights(fx), wy = cubic_weights(fy), sx = slopes(fx), sy = slopes(fy);
  const float* samples_at = row(static_cast<int>(line) - 1) + static_cast<int>(column) - 1;
  PlaneSample sample;
  for (std::size_t i = 0; i < 4; ++i, samples_at += width) {
    const float value = wx[0] * samples_at[0] + wx[1] * samples_at[1] + wx[2] * samples_at[2] +
                        wx[3] * samples_at[3];
    const float slope = sx[0] * samples_at[0] + sx[1] * samples_at[1] + sx[2] * samples_at[2] +
                        sx[3] * samples_at[3];
    sample.value += wy[i] * value;
    sample.dx += wy[i] * slope;
    sample.dy += sy[i] * value;
  }
  return sample;
}

}  // namespace gazed::tracking
