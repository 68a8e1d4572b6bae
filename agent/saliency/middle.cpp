#include "agent/saliency/middle.hpp"

#include <algorithm>

#include "agent/saliency/low_pass.hpp"

namespace gazed::saliency {

namespace {

// Passes of the pyramid's filter. Climbing from the winner in the blurred map puts it on the object
// in 79 % of 86 pictures of ECSSD, 77 % with one blur, 73 % without. Up to three blurs do not
// change pop-out displays, where the middle of one item is not the middle of all.
constexpr int winner_blurs = 2;

// The blur reflects at the border, which would draw nearby summits to it.
void clear_border(const PlaneView<std::int32_t>& map) {
  std::fill_n(map.row(0), map.width, 0);
  std::fill_n(map.row(map.height - 1), map.width, 0);
  for (int y = 0; y < map.height; ++y) map.row(y)[0] = map.row(y)[map.width - 1] = 0;
}

}  // namespace

geometry::Pixel middle_of_object(const SaliencyPlane& map, const Winner& winner,
                                 const PlaneView<std::int32_t>& smooth,
                                 const PlaneView<std::int32_t>& scratch) {
  std::copy_n(map.data, padded_size(map.width, map.height), smooth.data);
  for (int i = 0; i < winner_blurs; ++i) low_pass(smooth, scratch);
  clear_border(smooth);
  return summit_above(smooth, winner.x, winner.y).pixel;
}

}  // namespace gazed::saliency
