#include "agent/saliency/pyramid.hpp"

namespace gazed::saliency {

namespace {

using namespace lanes;

std::size_t samples_of_all_levels(int frame_width, int frame_height) {
  std::size_t total = 0;
  for (int k = first_stored_level; k <= last_level; ++k)
    total += padded_size(length_at_level(frame_width, k), length_at_level(frame_height, k));
  return total;
}

/// The two output samples that reach over the ends of the row.
void decimate_ends(const std::int16_t* in, int width, std::int32_t* out) {
  const int last = halved(width) - 1;
  if (width < 3) {
    const auto at = [&](int k) { return std::int32_t{in[reflect_101(k, width)]}; };
    out[0] = 6 * at(0) + 8 * at(1) + 2 * at(2);
    return;
  }
  const std::int16_t* end = in + 2 * last;
  out[0] = 6 * in[0] + 8 * in[1] + 2 * in[2];
  out[last] = width % 2 == 0 ? end[-2] + 4 * end[-1] + 7 * end[0] + 4 * end[1]
                             : 2 * end[-2] + 8 * end[-1] + 6 * end[0];
}

}  // namespace

void decimate_row(const std::int16_t* in, int width, std::int32_t* out) {
  const I16x8 centre = alternating(6, 4), before = alternating(1, 4), after = alternating(1, 0);
  const int width_out = halved(width);
  along_row<lane_count / 2>(width_out, [=](int i) {
    const std::int16_t* at = in + 2 * i;
    store(out + i, pair_sums(load(at), centre) + pair_sums(load_unaligned(at - 2), before) +
                       pair_sums(load_unaligned(at + 2), after));
  });
  decimate_ends(in, width, out);
}

void decimate_columns(const FiveRows<std::int32_t>& rows, int width, std::int16_t* out) {
  constexpr int gain_bits = 2 * binomial_gain_log2;
  const I32x4 half = splat_sum(1 << (gain_bits - 1));
  const auto [a, b, c, d, e] = rows;
  for (int x = 0; x < width; x += lane_count) {
    const auto four = [=](int i) {
      return shifted_right<gain_bits>(
          filtered(load(a + i), load(b + i), load(c + i), load(d + i), load(e + i)) + half);
    };
    store(out + x, packed(four(x), four(x + lane_count / 2)));
  }
}

Pyramid::Pyramid(int frame_width, int frame_height)
    : samples_(samples_of_all_levels(frame_width, frame_height)) {
  std::int16_t* next = samples_.data();
  for (int k = first_stored_level; k <= last_level; ++k) {
    const int width = length_at_level(frame_width, k), height = length_at_level(frame_height, k);
    levels_[index(k)] = {next, width, height, padded_to_lanes(width)};
    next += padded_size(width, height);
    if (k > first_stored_level) rings_.emplace_back(width, length_at_level(frame_height, k - 1));
  }
}

void Pyramid::build() {
  for (int k = first_stored_level; k < last_level; ++k) {
    const Plane from = level(k);
    const Plane to = level(k + 1);
    RowRing<std::int32_t>& ring = rings_[index(k)];
    int row = 0;
    for (int y = 0; y < from.height; ++y) {
      decimate_row(from.row(y), from.width, ring.next_row());
      ring.advance([&](const FiveRows<std::int32_t>& rows) {
        decimate_columns(rows, to.width, to.row(row++));
      });
    }
  }
}

}  // namespace gazed::saliency
