// The area of one colour around a place: what is connected to it, grown as far as its outline
// holds.
//
// Cells are taken in the order of the least level that connects them to the seed (a flood that
// rises). A level is a difference of colour, either to the seed, with little regard to brightness,
// or from one cell to the next: shading is smooth, an outline is a step. The flooded area is a
// staircase: it stands while the flood climbs an outline and jumps where it spills over. The widest
// step, counted as the ratio of the levels between which the area stands, is the area with the
// clearest outline (Matas et al., BMVC 2002: maximally stable areas). The area is measured by its
// hull in eight directions, so that a mark printed on an object, which the flood drowns late, is no
// spill; and where the flood finds its own colour again behind a mark, it has not spilt either.
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

/// A difference of colour in which shading counts little: a lit object's colour goes along the line
/// from black to its brightest.
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
  Eigen::Vector3f along_;  // the line's direction, as long as what it hides of a difference
};

/// What the flood from a seed found.
struct ColourArea {
  std::uint16_t seed = 0;
  float level = 0.0F;      // the flood's, half way up the outline
  float contrast = 0.0F;   // the level at which it spills
  float clearness = 0.0F;  // log of the ratio of levels between which the area stands
  float hull_cells = 0.0F;
  int cells = 0;
  int left = 0, right = 0, top = 0, bottom = 0;  // cells, all of them inside
};

/// Which holes of an area belong to it: through one that has the colour of the surroundings the
/// background is seen, or, where a lamp is mirrored, not.
enum class Holes : std::uint8_t { of_other_colours, all };

class ColourFlood {
 public:
  static constexpr int levels = 128;
  static constexpr float level_step = 2.0F;  // of colour difference

  /// The clearest area around the seed that does not reach the window's rim inside the frame.
  [[nodiscard]] std::optional<ColourArea> area_around(const ColourCells& cells, std::size_t seed);

  /// Marks an area's holes in `object`, too.
  void fill_holes(const ColourCells& cells, Holes filled,
                  std::array<bool, ColourCells::count>& object);
  /// Marks the area in `object`, with its holes.
  void mark(const ColourCells& cells, const ColourArea& area, Holes filled,
            std::array<bool, ColourCells::count>& object);

 private:
  struct Stage {  // the flood's area at a level
    int cells = 0;
    float hull_cells = 0.0F;
    float own_hull_cells = 0.0F;  // of what is of the seed's own colour
    int left = 0, right = 0, top = 0, bottom = 0;
  };
  struct Entry {
    std::uint16_t cell;
    std::int16_t next;
  };

  int rise(const ColourCells& cells, std::size_t seed, int highest_level, float own_difference);
  void look_behind_marks(const ColourCells& cells, ColourArea& area);

  std::array<Stage, levels> stages_;
  std::array<std::int16_t, levels> first_;  // of each level's list
  std::array<Entry, 4 * ColourCells::count + 1> entries_;
  std::array<std::uint8_t, ColourCells::count> level_of_;  // at which a cell is reached
  std::array<bool, ColourCells::count> visited_;           // drowned
  std::array<std::uint16_t, ColourCells::count> stack_;
};

}  // namespace gazed::tracking
