// A lamp mirrored in an object looks like an object on it, and is none: it glides over the surface
// as the camera moves, as if it lay half a ball's radius behind the surface.
//
// A surface's own colour and the mirrored light add up, and the light has the lamp's colour, which
// is nearly white (Shafer, Using color to separate reflection components, 1985). What lies on a
// table is told from that by its edge: a highlight has none, it fades as the surface turns.
#pragma once

#include <Eigen/Core>

namespace gazed::tracking {

class HighlightJudge {
 public:
  /// How far from an outline colours are asked for, to either side: at it, and where its blur has
  /// ended; in cells, of which the first inside is the outline's own.
  static constexpr int near_cells = 1, far_cells = 4;

  /// Colours, r, g, b, on both sides of a place of the outline.
  struct Across {
    Eigen::Vector3f far_inside, near_inside, near_outside, far_outside;
  };
  void add(const Across& across);

  /// Of what was added; false of nothing.
  [[nodiscard]] bool is_highlight() const;

 private:
  Eigen::Vector3f inside_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f near_ = Eigen::Vector3f::Zero(), far_ = Eigen::Vector3f::Zero();
  float count_ = 0.0F;
};

}  // namespace gazed::tracking
