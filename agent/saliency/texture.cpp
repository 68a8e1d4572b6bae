#include "agent/saliency/texture.hpp"

#include <algorithm>
#include <limits>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

// Two differences of neighbours, before they are divided by 4.
static_assert(2 * 255 * samples_per_grey_level <= std::numeric_limits<std::int16_t>::max());

void change_row(const std::int16_t* above, const std::int16_t* centre, const std::int16_t* below,
                int width, std::int16_t* out) {
  const I16x8 quarter = splat(1 << 13);  // Q15
  along_row(width, [=](int x) {
    const I16x8 at = load(centre + x);
    const I16x8 across =
        (at - load_unaligned(centre + x - 1)) + (at - load_unaligned(centre + x + 1));
    const I16x8 down = (at - load(above + x)) + (at - load(below + x));
    store(out + x, magnitude(times_q15(across, quarter) + times_q15(down, quarter)));
  });
}

}  // namespace

Texture::Texture(int frame_width, int frame_height)
    : centre_(padded_size(length_at_level(frame_width, 2), 1)),
      change_(padded_size(length_at_level(frame_width, 2), 1)),
      ring_(length_at_level(frame_width, 3), length_at_level(frame_height, 2)),
      level3_(length_at_level(frame_width, 3), length_at_level(frame_height, 3)) {}

ConstPlane Texture::of(const Pyramid& intensity) {
  const ConstPlane fine = intensity.level(2);
  const Plane level3 = level3_.view();
  int row = 0;
  for (int y = 0; y < fine.height; ++y) {
    std::int16_t* centre = centre_.data();
    std::copy_n(fine.row(y), fine.width, centre);
    centre[-1] = centre[0];
    centre[fine.width] = centre[fine.width - 1];
    change_row(fine.row(std::max(y - 1, 0)), centre, fine.row(std::min(y + 1, fine.height - 1)),
               fine.width, change_.data());
    decimate_row(change_.data(), fine.width, ring_.next_row());
    ring_.advance([&](const FiveRows<std::int32_t>& rows) {
      decimate_columns(rows, level3.width, level3.row(row++));
    });
  }
  return level3;
}

}  // namespace gazed::saliency
