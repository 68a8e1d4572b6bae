// Filters along the rows, from level 0 to level 2, without ever putting samples back in order.
//
// A row is stored as its phases: phase p of four holds the samples of columns 4m + p, phase p of
// two those of columns 2m + p. Output sample m depends on samples m - 1, m and m + 1 of each phase,
// so eight neighbouring outputs come from eight neighbouring samples of each phase.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "agent/saliency/columns.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/row_ring.hpp"

namespace gazed::saliency {

/// Columns of level 0 that make eight samples of level 2; kernels process a row in such blocks.
inline constexpr int block_columns = 4 * lane_count;

[[nodiscard]] constexpr int blocks_of(int columns) {
  return (columns + block_columns - 1) / block_columns;
}

/// Samples of one phase of four, padded to whole blocks.
[[nodiscard]] constexpr int phase_length(int columns) {
  return blocks_of(columns) * lane_count;
}

/// One row of one plane, as two or four phases.
template <int count>
class PhaseRow {
 public:
  /// For a row of `columns` samples; each phase is padded to `length` samples.
  PhaseRow(int columns, int length)
      : stride_(length + lane_count), samples_(static_cast<std::size_t>(count * stride_)) {
    const std::array outside{-2, -1, columns, columns + 1};
    std::transform(outside.begin(), outside.end(), ends_.begin(), [&](int column) {
      return End{offset_of(column), offset_of(reflect_101(column, columns))};
    });
  }

  [[nodiscard]] std::int16_t* phase(int p) { return samples_.data() + p * stride_; }
  [[nodiscard]] const std::int16_t* phase(int p) const { return samples_.data() + p * stride_; }

  /// Fills in the two columns before and after the row with their reflections.
  void reflect_ends() {
    for (const End& end : ends_) samples_.data()[end.outside] = samples_.data()[end.inside];
  }

 private:
  struct End {
    int outside;  // offsets in samples_
    int inside;
  };

  [[nodiscard]] int offset_of(int column) const {
    constexpr int count_log2 = std::bit_width(static_cast<unsigned>(count)) - 1;
    return (column & (count - 1)) * stride_ + (column >> count_log2);
  }

  int stride_;
  AlignedSamples<std::int16_t> samples_;
  std::array<End, 4> ends_{};
};

/// Filters and decimates a row of level 0, with reflected ends, to level 1, and removes the gain.
template <typename Sample>
void halve(const PhaseRow<4>& row, int length, PhaseRow<2>& out) {
  using namespace lanes;
  const std::int16_t *p0 = row.phase(0), *p1 = row.phase(1), *p2 = row.phase(2), *p3 = row.phase(3);
  std::int16_t *even = out.phase(0), *odd = out.phase(1);
  along_row(length, [=](int m) {
    const I16x8 c0 = load(p0 + m), c1 = load(p1 + m), c2 = load(p2 + m), c3 = load(p3 + m);
    store(even + m, rounded<Sample, binomial_gain_log2>(filtered(
                        load_unaligned(p2 + m - 1), load_unaligned(p3 + m - 1), c0, c1, c2)));
    store(odd + m, rounded<Sample, binomial_gain_log2>(
                       filtered(c0, c1, c2, c3, load_unaligned(p0 + m + 1))));
  });
}

/// Filters and decimates a row of level 1, with reflected ends, to level 2. Three bits of the gain
/// are kept as fraction.
template <typename Sample>
void halve(const PhaseRow<2>& row, int length, std::int16_t* out) {
  using namespace lanes;
  const std::int16_t *even = row.phase(0), *odd = row.phase(1);
#pragma GCC unroll 2
  for (int m = 0; m < length; m += lane_count)
    store(out + m, rounded<Sample, 1>(filtered(load_unaligned(even + m - 1),
                                               load_unaligned(odd + m - 1), load(even + m),
                                               load(odd + m), load_unaligned(even + m + 1))));
}

}  // namespace gazed::saliency
