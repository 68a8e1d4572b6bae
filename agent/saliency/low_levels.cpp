#include "agent/saliency/low_levels.hpp"

#include <algorithm>

namespace gazed {

namespace {

std::size_t three_rows(int width) {
  return plane_count * static_cast<std::size_t>(width);
}

/// From a filtered row of level 0 in `to_level1` on: takes it, and calls emit() for each row of
/// three planes that stands in `level2` then. Each pass takes the filter's gain away but the last,
/// which keeps three of its four bits as fraction.
template <typename Sample, typename Emit>
void advance_to_level2(int width_px, RowRing<Sample>& to_level1, std::vector<Sample>& level1,
                       RowRing<Sample>& to_level2, std::vector<Sample>& level2, Emit&& emit) {
  const int width1 = length_at_level(width_px, 1), width2 = length_at_level(width_px, 2);
  to_level1.advance([&](const FiveRows<Sample>& rows) {
    decimate_columns<binomial_gain_log2>(rows, plane_count * width1, level1.data());
    for (int plane = 0; plane < plane_count; ++plane)
      decimate_row<binomial_gain_log2>(level1.data() + plane * width1, width1,
                                       to_level2.next_row() + plane * width2);
    to_level2.advance([&](const FiveRows<Sample>& rows2) {
      decimate_columns<1>(rows2, plane_count * width2, level2.data());
      emit();
    });
  });
}

}  // namespace

PixelOpponents::PixelOpponents(int width_px, int height_px, bool clamp_negative)
    : width_px_(width_px),
      clamp_negative_(clamp_negative),
      rgb_(three_rows(width_px)),
      level0_(three_rows(width_px)),
      level1_(three_rows(length_at_level(width_px, 1))),
      level2_(three_rows(length_at_level(width_px, 2))),
      to_level1_(plane_count * length_at_level(width_px, 1), height_px),
      to_level2_(plane_count * length_at_level(width_px, 2), length_at_level(height_px, 1)) {}

const std::uint8_t* PixelOpponents::rgb_row(const ImageView& frame, int y) {
  if (frame.format == PixelFormat::rgb24) return frame.row(y);
  if (frame.format == PixelFormat::yuyv) {
    rgb_of_yuyv(frame.row(y), width_px_, rgb_.data());
  } else {
    for (int x = 0; x < width_px_; ++x) std::fill_n(&rgb_[three_rows(x)], 3, frame.row(y)[x]);
  }
  return rgb_.data();
}

void PixelOpponents::read(const ImageView& frame, const LevelTwo& out) {
  const int width1 = length_at_level(width_px_, 1), width2 = length_at_level(width_px_, 2);
  int row2 = 0;
  for (int y = 0; y < frame.height_px; ++y) {
    const OpponentRows level0{level0_.data(), level0_.data() + width_px_,
                              level0_.data() + 2 * width_px_};
    opponents_of_pixels(rgb_row(frame, y), width_px_, clamp_negative_, level0);
    for (int plane = 0; plane < plane_count; ++plane)
      decimate_row<binomial_gain_log2>(level0_.data() + plane * width_px_, width_px_,
                                       to_level1_.next_row() + plane * width1);
    advance_to_level2(width_px_, to_level1_, level1_, to_level2_, level2_, [&] {
      const OpponentRows to = out.row(row2++);
      std::copy_n(level2_.data(), width2, to.intensity);
      std::copy_n(level2_.data() + width2, width2, to.red_green);
      std::copy_n(level2_.data() + 2 * width2, width2, to.blue_yellow);
    });
  }
}

LateOpponents::LateOpponents(int width_px, int height_px)
    : width_px_(width_px),
      level1_(three_rows(length_at_level(width_px, 1))),
      level2_(three_rows(length_at_level(width_px, 2))),
      to_level1_(plane_count * length_at_level(width_px, 1), height_px),
      to_level2_(plane_count * length_at_level(width_px, 2), length_at_level(height_px, 1)) {}

void LateOpponents::filter_frame_row(const ImageView& frame, int y) {
  const std::uint8_t* pixels = frame.row(y);
  const int width1 = length_at_level(width_px_, 1);
  std::uint16_t* out = to_level1_.next_row();
  switch (frame.format) {
    case PixelFormat::rgb24:
      for (int plane = 0; plane < plane_count; ++plane)
        decimate_row<0, 3>(pixels + plane, width_px_, out + plane * width1);
      break;
    case PixelFormat::yuyv:
      // u and v come with every second y, at its place: they are decimated along the row already,
      // and need the filter's gain only.
      decimate_row<0, 2>(pixels, width_px_, out);
      for (int x = 0; x < width1; ++x) {
        out[width1 + x] = static_cast<std::uint16_t>(binomial_gain * pixels[4 * x + 1]);
        out[2 * width1 + x] = static_cast<std::uint16_t>(binomial_gain * pixels[4 * x + 3]);
      }
      break;
    case PixelFormat::grey:
      for (int plane = 0; plane < plane_count; ++plane)
        decimate_row<0>(pixels, width_px_, out + plane * width1);
      break;
  }
}

void LateOpponents::read(const ImageView& frame, const LevelTwo& out) {
  const int width2 = length_at_level(width_px_, 2);
  const std::uint16_t* first = level2_.data();
  const std::uint16_t* second = first + width2;
  const std::uint16_t* third = second + width2;
  int row2 = 0;
  for (int y = 0; y < frame.height_px; ++y) {
    filter_frame_row(frame, y);
    advance_to_level2(width_px_, to_level1_, level1_, to_level2_, level2_, [&] {
      const OpponentRows to = out.row(row2++);
      if (frame.format == PixelFormat::yuyv) {
        opponents_of_smooth_yuv(first, second, third, width2, to);
      } else {
        opponents_of_smooth_rgb(first, second, third, width2, to);
      }
    });
  }
}

}  // namespace gazed
