// The object at a place in a frame: an area of one colour, or an area that differs from its
// surroundings.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/tracking/candidates.hpp"
#include "agent/tracking/chamfer.hpp"
#include "agent/tracking/colour_cells.hpp"
#include "agent/tracking/own_colour.hpp"

namespace gazed::tracking {

/// A mask of the object, in square cells of a window around a given place.
class ObjectMask {
 public:
  static constexpr int cells = ColourCells::side;  // per side

  /// Searches windows of 24, 48, 96 and 192 px to each side, as far as they are smaller than the
  /// frame, for connected areas near `salient` that
  /// do not reach the window's rim. There are two kinds: areas of one colour, whose surroundings
  /// may be colourful, and areas that differ from the rim, which may be colourful themselves. Of
  /// nested areas the smaller wins (a ball on a table is the ball), unless it is a mark on the
  /// larger one (a ring printed on a disc, a mirrored lamp). The object may touch the frame's
  /// border. Returns false if no window has one.
  bool segment(const base::ImageView& image, const geometry::Pixel& salient);

  /// After segment(): takes the mark on `other`, which may be another thing in front of it. Returns
  /// false if it has none, or if that is a mirrored lamp.
  bool take_mark_on(const ObjectMask& other, const base::ImageView& image,
                    const geometry::Pixel& salient);

  /// Takes the square of this half size, at most 192 px, around `centre` as the object, clipped to
  /// the frame.
  void take_square(const base::ImageView& image, const geometry::Pixel& centre, int half_size_px);

  /// Moments of its area inside the frame.
  struct Moments {
    geometry::Pixel centroid_px = geometry::Pixel::Zero();
    Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
    double area_px2 = 0.0;
  };
  [[nodiscard]] Moments moments() const;

  /// A place on the object: its centroid if that is well inside, otherwise its deepest interior
  /// point.
  [[nodiscard]] geometry::Pixel interior_point() const;

  /// How far a pixel lies outside the object, px, accurate to a cell; 0 inside, large outside the
  /// window.
  [[nodiscard]] float distance_px(int x, int y) const {
    const int column = (x - origin_x_) >> cell_shift_, row = (y - origin_y_) >> cell_shift_;
    if (column < 0 || row < 0 || column >= cells || row >= cells) return far_px;
    const auto units = outside_[static_cast<std::size_t>(row * cells + column)];
    return static_cast<float>(units << cell_shift_) * (1.0F / 3.0F);
  }

  /// Half the size of the smallest square around `centre` that holds the object, px.
  [[nodiscard]] double half_size_px(const geometry::Pixel& centre) const;

  /// Calls visit(centre, outward) for every cell on the object's outline inside the frame, with the
  /// cell's centre and the unit vector that points away from the object there.
  template <class Visit>
  void for_outline(const Visit& visit) const {
    for_outline_cells([&](int column, int row, const Eigen::Vector2d& outward) {
      visit(centre_px(column, row), outward);
    });
  }

  /// The number of cells on the outline.
  [[nodiscard]] std::size_t outline_cells() const {
    std::size_t count = 0;
    for_outline([&](const geometry::Pixel&, const Eigen::Vector2d&) { ++count; });
    return count;
  }

  /// Side of a cell, px. The outline is no more accurate than this.
  [[nodiscard]] int cell_px() const { return 1 << cell_shift_; }

 private:
  static constexpr std::size_t cell_count = cells * cells;
  static constexpr float far_px = 1e4F;
  [[nodiscard]] static constexpr std::size_t index_of(int column, int row) {
    return static_cast<std::size_t>(row * cells + column);
  }

  template <class Visit>
  void for_outline_cells(const Visit& visit) const {
    for (int row = 2; row + 2 < cells; ++row) {
      for (int column = 2; column + 2 < cells; ++column) {
        const Eigen::Vector2d outward = outward_at(column, row);
        if (!outward.isZero()) visit(column, row, outward);
      }
    }
  }
  void place_window(const geometry::Pixel& centre, int cell_shift);
  void find_areas_of_one_colour(const geometry::Pixel& salient);
  void find_area_unlike_rim(const geometry::Pixel& salient);
  void add(Candidate& candidate, const geometry::Pixel& salient);
  void mark(const Candidate& candidate, const base::ImageView& image,
            const geometry::Pixel& salient, Holes filled);
  [[nodiscard]] bool is_highlight() const;
  bool grow_unlike_rim(const geometry::Pixel& salient);
  bool measure_contrast();
  bool grow_from(std::size_t seed, float threshold);
  void measure_distances();
  [[nodiscard]] Eigen::AlignedBox2f box_px(int left, int top, int right, int bottom) const;
  [[nodiscard]] Eigen::Vector2d outward_at(int column, int row) const;
  [[nodiscard]] bool in_frame(const base::ImageView& image, int column, int row) const;
  [[nodiscard]] geometry::Pixel centre_px(int column, int row) const;

  int cell_shift_ = 0;               // a cell has 2^cell_shift_ pixels a side
  int origin_x_ = 0, origin_y_ = 0;  // the first cell's first pixel
  float contrast_floor_ = 0.0F;      // colour distance that occurs within the window's rim
  float contrast_seen_ = 0.0F;       // colour distance between the seed and the rim's median colour
  int area_cells_ = 0;
  Candidates candidates_;
  ColourFlood flood_;
  ColourCells cells_;
  std::array<float, cell_count> contrast_;  // colour distance to the rim's median colour
  std::array<bool, cell_count> object_;
  CellDistances outside_;  // chamfer distance to the object, three units per cell
  CellDistances inside_;   // chamfer distance to what is not the object
  std::array<std::uint16_t, cell_count> stack_;
  std::array<float, 8 * cells> rim_;  // scratch
};

}  // namespace gazed::tracking
