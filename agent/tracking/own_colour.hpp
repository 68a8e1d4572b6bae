// The connected area of one colour around a place, grown as far as its outline holds.
//
// A rising flood takes cells in the order of the lowest level that connects them to the seed. A
// level is a difference of colour: either from the seed, with brightness counting little, or from
// one cell to the next, since shading is smooth and an outline is a step. The flooded area grows
// like a staircase: it rests while the flood climbs an outline, and jumps when the flood spills
// over. The widest step, measured by the ratio of the levels at its ends, is the area with the
// clearest outline (maximally stable regions, Matas et al., BMVC 2002). Area is measured by the
// hull in eight directions, so drowning a printed mark late is not taken for a spill; nor is
// finding the area's own colour again behind a mark.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "agent/tracking/colour_cells.hpp"

namespace gazed::tracking {

/// A colour difference in which shading counts little: under varying light an object's colours lie
/// on the line from black to its brightest colour.
class ColourDistance {
 public:
  explicit ColourDistance(const Eigen::Vector3f& colour);
  [[nodiscard]] float to(const Eigen::Vector3f& other) const {
    const Eigen::Vector3f off = other - colour_;
    const float along = off.dot(along_);
    return std::sqrt(std::max(0.0F, off.squaredNorm() - along * along));
  }

 private:
  Eigen::Vector3f colour_;
  Eigen::Vector3f along_;  // direction of the line, scaled by how much of a difference it hides
};

/// What the flood found from one seed.
struct ColourArea {
  std::uint16_t seed = 0;
  float level = 0.0F;      // of the flood, half way up the outline
  float contrast = 0.0F;   // level at which it spills
  float clearness = 0.0F;  // log of the ratio of the levels between which the area rests
  float hull_cells = 0.0F;
  int cells = 0;
  int left = 0, right = 0, top = 0, bottom = 0;  // bounding box in cells, inclusive
};

/// Which holes of an area belong to it. A hole in the colour of the surroundings shows the
/// background, unless a mirrored lamp makes it.
enum class Holes : std::uint8_t { of_other_colours, all };

class ColourFlood {
 public:
  static constexpr int levels = 128;
  static constexpr float level_step = 2.0F;  // of colour difference

  /// The clearest area around the seed that does not reach the window's rim inside the frame.
  [[nodiscard]] std::optional<ColourArea> area_around(const ColourCells& cells, std::size_t seed);

  /// Also marks the area's holes in `object`.
  void fill_holes(const ColourCells& cells, Holes filled,
                  std::array<bool, ColourCells::count>& object);
  /// Marks the area in `object`, including its holes.
  void mark(const ColourCells& cells, const ColourArea& area, Holes filled,
            std::array<bool, ColourCells::count>& object);

 private:
  struct Stage {  // the flood's area at one level
    int cells = 0;
    float hull_cells = 0.0F;
    float own_hull_cells = 0.0F;  // only counting cells of the seed's own colour
    int left = 0, right = 0, top = 0, bottom = 0;
  };
  struct Entry {
    std::uint16_t cell;
    std::int16_t next;
  };

  int rise(const ColourCells& cells, std::size_t seed, int highest_level, float own_difference);
  void look_behind_marks(const ColourCells& cells, ColourArea& area);

  std::array<Stage, levels> stages_;
  std::array<std::int16_t, levels> first_;  // start of each level's list
  std::array<Entry, 4 * ColourCells::count + 1> entries_;
  std::array<std::uint8_t, ColourCells::count> level_of_;  // level at which a cell is reached
  std::array<bool, ColourCells::count> visited_;           // already drowned
  std::array<std::uint16_t, ColourCells::count> stack_;
};

}  // namespace gazed::tracking
