// Down the columns, from level 0 to level 2: whole rows of 16 bits, whatever their samples are.
#pragma once

#include <cstdint>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/row_ring.hpp"

namespace gazed::saliency {

/// A sum of the filter divided by 2^bits and rounded. `Sample`, std::int16_t or std::uint16_t, says
/// how its 16 bits are to be read.
template <typename Sample, int bits>
[[nodiscard]] lanes::I16x8 rounded(lanes::I16x8 sum) {
  const lanes::I16x8 with_half = sum + lanes::splat(1 << (bits - 1));
  if constexpr (static_cast<Sample>(-1) < 0) {
    return lanes::shifted_right<bits>(with_half);
  } else {
    return lanes::shifted_right_unsigned<bits>(with_half);
  }
}

/// Filters five rows to one. All padded; `samples` is a multiple of lane_count.
template <typename Sample>
void filter_columns(const FiveRows<std::int16_t>& rows, int samples, std::int16_t* out) {
  using lanes::load;
  const auto [a, b, c, d, e] = rows;
  along_row(samples, [=](int x) {
    store(out + x, rounded<Sample, binomial_gain_log2>(
                       filtered(load(a + x), load(b + x), load(c + x), load(d + x), load(e + x))));
  });
}

/// Decimates the columns of a frame of bytes while its rows go by, two at a time. Each byte is read
/// once: two rows of sums are kept instead of five of the frame.
class ByteColumns {
 public:
  explicit ByteColumns(int most_bytes_a_row);

  /// Takes two rows that follow each other, of `bytes` bytes. `out` becomes the filtered row that
  /// is centred on the row two above `first`, in Q4; it is padded to whole I16x8.
  void push(const std::uint8_t* first, const std::uint8_t* second, int bytes, std::int16_t* out);

 private:
  AlignedSamples<std::int16_t> unfinished_;  // of the output row centred on the last pair's first
  AlignedSamples<std::int16_t> begun_;       // of the one after it
};

}  // namespace gazed::saliency
