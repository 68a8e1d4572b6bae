#include "agent/saliency/pyramid.hpp"

namespace gazed {

Pyramid::Pyramid(int frame_width, int frame_height) {
  std::size_t total = 0;
  for (int k = first_stored_level; k <= last_level; ++k) {
    Plane& plane = levels_[index(k)];
    plane.width = length_at_level(frame_width, k);
    plane.height = length_at_level(frame_height, k);
    total += plane.size();
    if (k > first_stored_level) rings_.emplace_back(plane.width, levels_[index(k - 1)].height);
  }
  samples_.resize(total);
  std::int16_t* next = samples_.data();
  for (Plane& plane : levels_) {
    plane.data = next;
    next += plane.size();
  }
}

void Pyramid::build() {
  for (int k = first_stored_level; k < last_level; ++k) {
    const Plane from = level(k);
    const Plane to = level(k + 1);
    RowRing<std::int32_t>& ring = rings_[index(k)];
    int row = 0;
    for (int y = 0; y < from.height; ++y) {
      decimate_row<0>(from.row(y), from.width, ring.next_row());
      ring.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns<2 * binomial_gain_log2>(rows, to.width, to.row(row++));
      });
    }
  }
}

}  // namespace gazed
