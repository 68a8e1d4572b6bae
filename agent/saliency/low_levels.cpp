#include "agent/saliency/low_levels.hpp"

#include <algorithm>

#include "agent/saliency/opponents.hpp"
#include "agent/saliency/unzip.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

constexpr int channels = 3;                                  // r, g, b
constexpr int block_samples_rgb = channels * block_columns;  // of all three channels
constexpr int block_samples_yuyv = 2 * block_columns;

template <int count>
std::vector<PhaseRow<count>> rows_of_planes(int columns, int length) {
  return std::vector<PhaseRow<count>>(plane_count, PhaseRow<count>(columns, length));
}

/// Where the phases of a row are written: a copy, so that no store can change it.
template <std::size_t count>
struct PhaseWriter {
  explicit PhaseWriter(PhaseRow<static_cast<int>(count)>& row) {
    for (std::size_t p = 0; p < count; ++p) phases[p] = row.phase(static_cast<int>(p));
  }
  void write(int at, const std::array<I16x8, count>& samples) const {
    for (std::size_t p = 0; p < count; ++p) store(phases[p] + at, samples[p]);
  }

  std::array<std::int16_t*, count> phases;
};

/// A row of level 0 to level 1, both with their ends reflected.
template <typename Sample>
void halve_whole(PhaseRow<4>& row, int length, PhaseRow<2>& out) {
  row.reflect_ends();
  halve<Sample>(row, length, out);
  out.reflect_ends();
}

OpponentRows rows_of(const LevelTwo& planes, int y) {
  return {planes[0].row(y), planes[1].row(y), planes[2].row(y)};
}

void grey_to_rgb(const std::uint8_t* grey, int width, std::uint8_t* rgb) {
  for (int x = 0; x < width; ++x) std::fill_n(rgb + channels * x, channels, grey[x]);
}

template <bool clamp_negative>
void convert_block(const std::uint8_t* rgb, int phase_length, std::int16_t* out) {
  const auto [r, g, b] = unzip_rgb(rgb);
  for (std::size_t p = 0; p < 4; ++p) {
    const auto is = opponents_of_pixels<clamp_negative>(r[p], g[p], b[p]);
    std::int16_t* to = out + static_cast<std::ptrdiff_t>(p) * phase_length;
    store(to, is.intensity);
    store(to + 4 * phase_length, is.red_green);
    store(to + 8 * phase_length, is.blue_yellow);
  }
}

template <bool clamp_negative>
void convert_columns(const std::uint8_t* rgb, int width, int phase_length, std::int16_t* out) {
  int x = 0;
  for (; x + block_columns <= width; x += block_columns, out += lane_count)
    convert_block<clamp_negative>(rgb + channels * x, phase_length, out);
  if (x == width) return;
  std::array<std::uint8_t, block_samples_rgb> last{};
  std::copy(rgb + channels * x, rgb + channels * width, last.begin());
  convert_block<clamp_negative>(last.data(), phase_length, out);
}

}  // namespace

PixelOpponents::PixelOpponents(int width_px, int height_px, bool clamp_negative)
    : width_px_(width_px),
      clamp_negative_(clamp_negative),
      phase_length_(phase_length(width_px)),
      rgb_(static_cast<std::size_t>(channels * width_px)),
      level0_(plane_count * 4 * phase_length_, height_px),
      level1_(plane_count * 4 * phase_length_, halved(height_px)),
      planes_(rows_of_planes<4>(width_px, phase_length_)),
      half_(halved(width_px), phase_length_) {}

const std::uint8_t* PixelOpponents::rgb_row(const base::ImageView& frame, int y) {
  if (frame.format == base::PixelFormat::rgb24) return frame.row(y);
  if (frame.format == base::PixelFormat::yuyv) {
    rgb_of_yuyv(frame.row(y), width_px_, rgb_.data());
  } else {
    grey_to_rgb(frame.row(y), width_px_, rgb_.data());
  }
  return rgb_.data();
}

void PixelOpponents::convert_row(const std::uint8_t* rgb, std::int16_t* out) const {
  if (clamp_negative_) {
    convert_columns<true>(rgb, width_px_, phase_length_, out);
  } else {
    convert_columns<false>(rgb, width_px_, phase_length_, out);
  }
}

// The last pass down the columns goes straight to the phases of each plane.
void PixelOpponents::finish_row(const FiveRows<std::int16_t>& rows, const LevelTwo& out, int y) {
  FiveRows<std::int16_t> phases = rows;
  for (std::size_t c = 0; c < plane_count; ++c) {
    for (int p = 0; p < 4; ++p) {
      filter_columns<std::int16_t>(phases, phase_length_, planes_[c].phase(p));
      for (const std::int16_t*& row : phases) row += phase_length_;
    }
    halve_whole<std::int16_t>(planes_[c], phase_length_, half_);
    halve<std::int16_t>(half_, phase_length_, out[c].row(y));
  }
}

void PixelOpponents::read(const base::ImageView& frame, const LevelTwo& out) {
  int row2 = 0;
  for (int y = 0; y < frame.height_px; ++y) {
    convert_row(rgb_row(frame, y), level0_.next_row());
    level0_.advance([&](const FiveRows<std::int16_t>& rows) {
      filter_columns<std::int16_t>(rows, plane_count * 4 * phase_length_, level1_.next_row());
      level1_.advance([&](const FiveRows<std::int16_t>& rows1) { finish_row(rows1, out, row2++); });
    });
  }
}

LateOpponents::LateOpponents(int width_px, int height_px)
    : width_px_(width_px),
      phase_length_(phase_length(width_px)),
      rgb_(static_cast<std::size_t>(2 * channels * width_px)),
      columns_(block_samples_rgb * blocks_of(width_px)),
      level1_(block_samples_rgb * blocks_of(width_px), halved(height_px)),
      filtered_(static_cast<std::size_t>(block_samples_rgb * blocks_of(width_px))),
      planes_(rows_of_planes<4>(width_px, phase_length_)),
      half_(rows_of_planes<2>(halved(width_px), phase_length_)),
      smooth_(plane_count, AlignedSamples<std::int16_t>(static_cast<std::size_t>(phase_length_))) {}

const std::uint8_t* LateOpponents::row_of(const base::ImageView& frame, int y) {
  const std::uint8_t* row = frame.row(reflect_101(y, frame.height_px));
  if (frame.format != base::PixelFormat::grey) return row;
  // Of two rows that follow each other one is even, also where they are reflected.
  std::uint8_t* rgb = rgb_.data() + (y & 1) * channels * width_px_;
  grey_to_rgb(row, width_px_, rgb);
  return rgb;
}

ThreeRows LateOpponents::smooth_rows() const {
  return {smooth_[0].data(), smooth_[1].data(), smooth_[2].data()};
}

void LateOpponents::finish_rgb_row(const LevelTwo& out, int y) {
  const PhaseWriter<4> r(planes_[0]), g(planes_[1]), b(planes_[2]);
  const std::int16_t* block = filtered_.data();
  for (int m = 0; m < phase_length_; m += lane_count, block += block_samples_rgb) {
    const auto rgb = unzip_rgb(block);
    r.write(m, rgb[0]);
    g.write(m, rgb[1]);
    b.write(m, rgb[2]);
  }
  for (std::size_t c = 0; c < channels; ++c) {
    halve_whole<std::uint16_t>(planes_[c], phase_length_, half_[c]);
    halve<std::uint16_t>(half_[c], phase_length_, smooth_[c].data());
  }
  opponents_of_smooth_rgb(smooth_rows(), phase_length_, rows_of(out, y));
}

// u and v come with every second pixel, at its place: along the row they are at level 1 already.
void LateOpponents::finish_yuyv_row(const LevelTwo& out, int y) {
  const PhaseWriter<4> luma(planes_[0]);
  const PhaseWriter<2> u(half_[1]), v(half_[2]);
  const std::int16_t* block = filtered_.data();
  for (int m = 0; m < phase_length_; m += lane_count, block += block_samples_yuyv) {
    const YuvPhases yuv = unzip_yuyv(block);
    luma.write(m, yuv.y);
    u.write(m, yuv.u);
    v.write(m, yuv.v);
  }
  halve_whole<std::uint16_t>(planes_[0], phase_length_, half_[0]);
  half_[1].reflect_ends();
  half_[2].reflect_ends();
  for (std::size_t c = 0; c < plane_count; ++c)
    halve<std::uint16_t>(half_[c], phase_length_, smooth_[c].data());
  opponents_of_smooth_yuv(smooth_rows(), phase_length_, rows_of(out, y));
}

void LateOpponents::read(const base::ImageView& frame, const LevelTwo& out) {
  const bool yuyv = frame.format == base::PixelFormat::yuyv;
  const int bytes = width_px_ * (yuyv ? 2 : channels);
  const int samples = blocks_of(width_px_) * (yuyv ? block_samples_yuyv : block_samples_rgb);
  int row2 = 0;
  // The pairs before the first row and after the last one are reflections; the first two outputs
  // belong to rows above the frame.
  for (int y = -2; y <= 2 * halved(frame.height_px); y += 2) {
    columns_.push(row_of(frame, y), row_of(frame, y + 1), bytes, level1_.next_row());
    if (y < 2) continue;
    level1_.advance([&](const FiveRows<std::int16_t>& rows) {
      filter_columns<std::uint16_t>(rows, samples, filtered_.data());
      if (yuyv) {
        finish_yuyv_row(out, row2++);
      } else {
        finish_rgb_row(out, row2++);
      }
    });
  }
}

}  // namespace gazed::saliency
