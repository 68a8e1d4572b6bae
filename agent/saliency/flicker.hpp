// The flicker channel: what has changed since the frame before, while the head stood still (Itti,
// Dhavale and Pighin, "Realistic avatar eye and head animation using a neurobiological model of
// visual attention", SPIE 5200, 2003, section 3).
//
//   |intensity - intensity before| at level 3 -> reduced to level 4 -> promoted -> a share of S
//
// Promoted is what covers little of the frame: by 255 (1 - mean/M)^2 / M, M the map's maximum. That
// is N with the mean of the whole map instead of the local maxima's, since a thing that moves
// leaves two maxima, where it was and where it is, which N takes for rivals and puts down. A light
// that goes on, or a longer exposure, changes all alike and comes to nothing.
//
// With a head that moves everything changes, and the channel says nothing. Level 3, one sample for
// 8 x 8 pixels, is a quarter of the time and of the memory of level 2: what moves by less than its
// own size differs there as well, and the map's samples are twice as wide again.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

inline constexpr int flicker_level = 3;

class Flicker {
 public:
  /// `share` of S, [0, 1]. Changes that stay below `noise_floor`, in units of the intensity plane,
  /// have no say.
  Flicker(double share, std::int32_t noise_floor, int frame_width, int frame_height);

  /// Keeps `intensity`, level 3 of this frame. When `still`, and after a first frame, S becomes
  /// (1 - share) S + share F, F the promoted map; else it stays as it is.
  void add_to(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity, bool still);

 private:
  [[nodiscard]] ConstPlane reduced_change(const ConstPlane& intensity);

  std::int32_t share_;  // Q14
  std::int32_t noise_floor_;
  bool primed_ = false;
  OwnedPlane<std::int16_t> before_;    // level 3 of the frame before
  std::vector<std::uint16_t> column_;  // three rows of level 3, weighted, and a sample at each end
  OwnedPlane<std::int16_t> change_;    // level 4
};

}  // namespace gazed::saliency
