// A lamp mirrored in an object looks like an object on it. It must not become the target: it glides
// over the surface as the camera moves, as if it lay half a ball's radius behind the surface.
//
// The mirrored light adds to the surface's own colour and has the lamp's colour, which is nearly
// white (Shafer, Using color to separate reflection components, 1985). Its edge tells it from a
// bright object on a table: a highlight fades as the surface turns.
#pragma once

#include <Eigen/Core>

namespace gazed::tracking {

class HighlightJudge {
 public:
  /// How far from an outline colours are sampled on either side, in cells: next to it, and where
  /// its blur has ended. The first cell inside is the outline's own.
  static constexpr int near_cells = 1, far_cells = 4;

  /// Colours, r, g, b, on both sides of a place on the outline.
  struct Across {
    Eigen::Vector3f far_inside, near_inside, near_outside, far_outside;
  };
  void add(const Across& across);

  /// Judges everything added so far; false if nothing was.
  [[nodiscard]] bool is_highlight() const;

 private:
  Eigen::Vector3f inside_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f near_ = Eigen::Vector3f::Zero(), far_ = Eigen::Vector3f::Zero();
  float count_ = 0.0F;
};

}  // namespace gazed::tracking
