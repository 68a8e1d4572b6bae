// Whether a surface's slopes are believed.
//
// When something nearer covers a part of an object, what is left fits well too, squeezed to what is
// left of its width: as if the surface were steep. It has the same slopes in every look, and a
// cover has not.
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
  /// A new target.
  void clear() { *this = {}; }

  /// True for slopes like those of a look that was believed, and remembers them; of the first look
  /// for all but steep ones, which are believed when two looks have them.
  [[nodiscard]] bool believe(const PatchWarp& warp, const PatchMotion& motion);

 private:
  static constexpr std::size_t looks_kept = 16;

  std::array<Eigen::Vector2d, looks_kept> believed_;
  std::size_t count_ = 0;
  std::optional<Eigen::Vector2d> steep_;
};

}  // namespace gazed::tracking
