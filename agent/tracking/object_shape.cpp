// Geometry of a segmented object: where it is, how large, and where its outline runs.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "agent/tracking/chamfer.hpp"
#include "agent/tracking/object.hpp"

namespace gazed::tracking {

namespace {

constexpr std::int16_t unreachable = std::numeric_limits<std::int16_t>::max() / 2;

}  // namespace

void ObjectMask::measure_distances() {
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const std::size_t i = index_of(column, row);
      outside_[i] = object_[i] ? std::int16_t{0} : unreachable;
      inside_[i] = object_[i] ? unreachable : std::int16_t{0};
    }
  }
  measure_chamfer_distance(outside_);
  measure_chamfer_distance(inside_);
}

// Gradient of the distance from the outline, over two cells to each side; zero for cells that are
// not on the outline.
Eigen::Vector2d ObjectMask::outward_at(int column, int row) const {
  constexpr std::int16_t one_cell = 3;
  const std::size_t here = index_of(column, row);
  if (!object_[here] || inside_[here] != one_cell || !cells_.in_frame[here]) {
    return Eigen::Vector2d::Zero();
  }
  const auto outside = [&](std::size_t cell) { return outside_[cell] - inside_[cell]; };
  Eigen::Vector2d outward = Eigen::Vector2d::Zero();
  for (int k = -2; k <= 2; ++k) {
    outward.x() += outside(index_of(column + 2, row + k)) - outside(index_of(column - 2, row + k));
    outward.y() += outside(index_of(column + k, row + 2)) - outside(index_of(column + k, row - 2));
  }
  return outward.squaredNorm() > 0.0 ? Eigen::Vector2d(outward.normalized()) : outward;
}

ObjectMask::Moments ObjectMask::moments() const {
  geometry::Pixel sum = geometry::Pixel::Zero();
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  int area = 0;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (!object_[i]) continue;
    const geometry::Pixel at = centre_px(static_cast<int>(i) % cells, static_cast<int>(i) / cells);
    sum += at;
    products += at * at.transpose();
    ++area;
  }
  if (area == 0) return {};
  const geometry::Pixel centroid = sum / area;
  // Add the variance of a square cell's own area.
  const double of_cell_px2 = cell_px() * cell_px() / 12.0;
  return {
      centroid,
      products / area - centroid * centroid.transpose() + of_cell_px2 * Eigen::Matrix2d::Identity(),
      static_cast<double>(area * cell_px() * cell_px())};
}

geometry::Pixel ObjectMask::interior_point() const {
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (object_[i] && inside_[i] > inside_[deepest]) deepest = i;
  }
  const geometry::Pixel centroid = moments().centroid_px;
  const auto column = static_cast<int>(std::floor((centroid.x() - origin_x_ + 0.5) / cell_px()));
  const auto row = static_cast<int>(std::floor((centroid.y() - origin_y_ + 0.5) / cell_px()));
  if (2 * inside_[index_of(column, row)] >= inside_[deepest]) return centroid;
  return centre_px(static_cast<int>(deepest) % cells, static_cast<int>(deepest) / cells);
}

double ObjectMask::half_size_px(const geometry::Pixel& centre) const {
  double half_size = 0.0;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (!object_[i]) continue;
    const geometry::Pixel at = centre_px(static_cast<int>(i) % cells, static_cast<int>(i) / cells);
    half_size = std::max(half_size, (at - centre).lpNorm<Eigen::Infinity>() + 0.5 * cell_px());
  }
  return half_size;
}

}  // namespace gazed::tracking
