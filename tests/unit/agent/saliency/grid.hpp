// Small planes and maps, drawn sample by sample.
#pragma once

#include <algorithm>
#include <limits>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

template <typename Sample>
class Grid {
 public:
  /// The padding of the rows has the largest value there is: it must not count anywhere.
  Grid(int width, int height, Sample value = 0) : owned_(width, height) {
    fill(owned_.view(), std::numeric_limits<Sample>::max());
    for (int y = 0; y < height; ++y) std::fill_n(owned_.view().row(y), width, value);
  }
  Sample& at(int x, int y) { return owned_.view().row(y)[x]; }
  [[nodiscard]] PlaneView<Sample> plane() { return owned_.view(); }

 private:
  OwnedPlane<Sample> owned_;
};

}  // namespace gazed::saliency
