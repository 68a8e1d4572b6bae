// The flicker channel: what changed since the previous frame while the head stood still (Itti,
// Dhavale and Pighin, "Realistic avatar eye and head animation using a neurobiological model of
// visual attention", SPIE 5200, 2003, section 3).
//
// |intensity - previous intensity| at level 3 -> reduced to level 4 -> promoted -> a share of S
//
// Changes that cover little of the frame are promoted by 255 (1 - mean/M)^2 / M, where M is the
// map's maximum. This is N with the mean of the whole map instead of that of its local maxima: a
// moving object leaves two maxima, its old and its new place, and N would suppress them as rivals.
// When a light goes on or the exposure changes, everything changes alike and nothing is promoted.
//
// While the head moves everything changes, so the channel is off. Level 3, one sample per 8 x 8
// pixels, needs a quarter of the time and memory of level 2: an object that moves by less than its
// own size still differs there, and the map is twice as coarse anyway.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

inline constexpr int flicker_level = 3;

class Flicker {
 public:
  /// `share` of S, [0, 1]. Changes below `noise_floor`, in units of the intensity plane, are
  /// ignored.
  Flicker(double share, std::int32_t noise_floor, int frame_width, int frame_height);

  /// Stores `intensity`, level 3 of this frame. If `still`, and not the first frame, S becomes (1 -
  /// share) S + share F, F being the promoted map; otherwise S is unchanged.
  void add_to(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity, bool still);

 private:
  [[nodiscard]] ConstPlane reduced_change(const ConstPlane& intensity);

  std::int32_t share_;  // Q14
  std::int32_t noise_floor_;
  bool primed_ = false;
  OwnedPlane<std::int16_t> before_;    // level 3 of the previous frame
  std::vector<std::uint16_t> column_;  // three rows of level 3, weighted, and a sample at each end
  OwnedPlane<std::int16_t> change_;    // level 4
};

}  // namespace gazed::saliency
