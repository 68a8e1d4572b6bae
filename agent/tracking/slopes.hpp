// Whether the fitted slopes of a surface are plausible.
//
// If something nearer covers part of an object, the visible rest still fits well when the patch is
// squeezed to its width, as if the surface were steep. A real surface has the same slopes in every
// look; a cover's effect changes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

class BelievedSlopes {
 public:
  /// Starts a new target.
  void clear() { *this = {}; }

  /// True if the slopes resemble those of an accepted look; remembers them. In the first look all
  /// but steep slopes are accepted; steep ones need two looks that agree.
  [[nodiscard]] bool believe(const PatchWarp& warp, const PatchMotion& motion);

 private:
  static constexpr std::size_t looks_kept = 16;

  std::array<Eigen::Vector2d, looks_kept> believed_;
  std::size_t count_ = 0;
  std::optional<Eigen::Vector2d> steep_;
};

}  // namespace gazed::tracking
