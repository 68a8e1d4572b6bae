#include "agent/saliency/center_surround.hpp"

#include <algorithm>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int fraction_bits = 15;  // Q15, as times_q15 takes it

// a + (b - a) k/2^ratio_log2: |b - a| < 2^15.
I16x8 between(I16x8 a, I16x8 step, I16x8 fraction) {
  return a + times_q15(step, fraction);
}

std::int16_t fraction_of(int k, int ratio_log2) {
  return static_cast<std::int16_t>(k << (fraction_bits - ratio_log2));
}

template <CentreSurround mode>
void compare_row(const std::int16_t* centre, int width, const std::int16_t* above,
                 const std::int16_t* step, I16x8 fraction, std::int16_t* out) {
  along_row(width, [=](int x) {
    const I16x8 surround = between(load(above + x), load(step + x), fraction);
    const I16x8 at = load(centre + x);
    store(out + x, magnitude(mode == CentreSurround::sum ? at + surround : at - surround));
  });
}

}  // namespace

CentreSurroundRows::CentreSurroundRows(int widest)
    // A surround sample covers up to sixteen centre samples, also beyond the last one.
    : above_(static_cast<std::size_t>(padded_to_lanes(widest) + lane_count)),
      step_(static_cast<std::size_t>(padded_to_lanes(widest) + lane_count)) {}

void CentreSurroundRows::begin(CentreSurround mode, const ConstPlane& centre,
                               const ConstPlane& surround, int ratio_log2) {
  mode_ = mode;
  centre_ = centre;
  surround_ = surround;
  ratio_log2_ = ratio_log2;
  y_ = 0;
}

// Advances by one row of the surround; at the map's first row, by two.
void CentreSurroundRows::widen_next_surround_row() {
  const int below = std::min((y_ >> ratio_log2_) + 1, surround_.height - 1);
  const I16x8 near = multiples(fraction_of(1, ratio_log2_));
  const I16x8 far =
      near + splat(fraction_of(ratio_log2_ == far_surround ? lane_count : 0, ratio_log2_));
  const auto widen = [&](const std::int16_t* row, auto&& take) {
    for (int i = 0; i < surround_.width; ++i) {
      const I16x8 left = splat(row[i]);
      const I16x8 step = splat(row[std::min(i + 1, surround_.width - 1)]) - left;
      const int x = i << ratio_log2_;
      take(x, between(left, step, near));
      if (ratio_log2_ == far_surround) take(x + lane_count, between(left, step, far));
    }
  };
  std::int16_t *above = above_.data(), *step = step_.data();
  if (y_ == 0) {
    widen(surround_.row(0), [&](int x, I16x8 v) { store(above + x, v); });
  } else {
    for (int x = 0; x < centre_.stride; x += lane_count)
      store(above + x, load(above + x) + load(step + x));
  }
  widen(surround_.row(below), [&](int x, I16x8 v) { store(step + x, v - load(above + x)); });
}

void CentreSurroundRows::next(std::int16_t* out) {
  const int row_of_surround = y_ & ((1 << ratio_log2_) - 1);
  if (row_of_surround == 0) widen_next_surround_row();
  const I16x8 fraction = splat(fraction_of(row_of_surround, ratio_log2_));
  const std::int16_t* centre = centre_.row(y_++);
  if (mode_ == CentreSurround::sum) {
    compare_row<CentreSurround::sum>(centre, centre_.width, above_.data(), step_.data(), fraction,
                                     out);
  } else {
    compare_row<CentreSurround::difference>(centre, centre_.width, above_.data(), step_.data(),
                                            fraction, out);
  }
}

BorderRamp::BorderRamp(int width, int height)
    : width_(width),
      height_(height),
      length_(std::min(std::max(width, height) / 20, std::min(width, height) / 2)),
      left_end_(std::min(padded_to_lanes(length_), padded_to_lanes(width))),
      right_begin_(std::max(left_end_, (width - length_) / lane_count * lane_count)),
      loss_(static_cast<std::size_t>(padded_to_lanes(width))) {
  for (int i = 0; i < length_; ++i)
    loss_.data()[i] = loss_.data()[width - 1 - i] =
        static_cast<std::int16_t>(((length_ - i) << fraction_bits) / (length_ + 1));
}

// Subtracts what is lost instead of multiplying by what is kept, so that a loss of 0 changes
// nothing.
void BorderRamp::apply(int y, std::int16_t* row) const {
  if (length_ == 0) return;
  const auto attenuate = [row](int x, I16x8 loss) {
    store(row + x, load(row + x) - times_q15(load(row + x), loss));
  };
  const std::int16_t* loss = loss_.data();
  if (const int from_border = std::min(y, height_ - 1 - y); from_border < length_) {
    // Losses at the top and bottom equal those of the columns.
    const I16x8 of_row = splat(loss[from_border]);
    along_row(width_, [&](int x) { attenuate(x, of_row); });
  }
  for (int x = 0; x < left_end_; x += lane_count) attenuate(x, load(loss + x));
  for (int x = right_begin_; x < width_; x += lane_count) attenuate(x, load(loss + x));
}

}  // namespace gazed::saliency
