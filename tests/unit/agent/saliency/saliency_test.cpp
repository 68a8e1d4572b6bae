// The whole stage: against its double-precision reference, on frames that saturate, from every
// format, at odd sizes.
#include "agent/saliency/saliency.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/reference.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::saliency_test {
namespace {

using frames::Canvas;

// Drawn frames have ridges of equal samples, where the last bit decides how many maxima N counts:
// one more or less in a map changes its weight by some per cent. Photographs do better: median
// 0.99999 (photographs_test.cpp).
constexpr double drawn_correlation_min = 0.99;
constexpr double straight_edge_correlation_min = 0.95;
constexpr double drawn_saliency_tolerance = 0.03;
constexpr double near_grey_correlation_min = 0.97;  // rounding weighs more where little else is

SaliencySettings settings_of(SaliencyProfile profile) {
  SaliencySettings settings;
  settings.profile = profile;
  return settings;
}

std::vector<std::uint16_t> map_of(const SaliencySettings& settings, const base::ImageView& view) {
  Saliency saliency(settings, view.width_px, view.height_px);
  const SaliencyMap map = saliency.examine(view).map;
  return {map.samples.begin(), map.samples.end()};
}

class SaliencyOf : public testing::TestWithParam<SaliencyProfile> {
 protected:
  SaliencySettings settings = settings_of(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Profiles, SaliencyOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust),
                         profile_name);

TEST_P(SaliencyOf, DrawnFramesFollowTheReference) {
  for (const frames::NamedFrame& frame : frames::drawn_frames()) {
    const Comparison c = compare(frame.canvas.view(), settings);
    EXPECT_GE(c.correlation, drawn_correlation_min) << frame.name;
    EXPECT_LE(c.winner_distance, 1) << frame.name;
    EXPECT_NEAR(c.saliency, c.reference_saliency, drawn_saliency_tolerance) << frame.name;
  }
}

TEST_P(SaliencyOf, NearGreyDisplaysFollowTheReference) {
  for (const frames::NamedFrame& frame : frames::near_grey_displays()) {
    const Comparison c = compare(frame.canvas.view(), settings);
    EXPECT_GE(c.correlation, near_grey_correlation_min) << frame.name;
  }
}

TEST_P(SaliencyOf, WeightsFollowTheReference) {
  settings.intensity_weight = 3.0;
  settings.colour_weight = 0.5;
  for (const frames::NamedFrame& frame : frames::drawn_frames())
    EXPECT_GE(compare(frame.canvas.view(), settings).correlation, drawn_correlation_min)
        << frame.name;
}

TEST(SaliencyReport, ClampedOpponentsFollowTheReference) {
  SaliencySettings settings = settings_of(SaliencyProfile::report);
  settings.clamp_negative = true;
  for (const frames::NamedFrame& frame : frames::drawn_frames())
    EXPECT_GE(compare(frame.canvas.view(), settings).correlation, drawn_correlation_min)
        << frame.name;
}

// Wrapped arithmetic would give another map altogether; low_levels_test.cpp looks closer.
TEST_P(SaliencyOf, EdgesOfPureColoursFollowTheReference) {
  const std::array colours{frames::red,    frames::green, frames::blue,
                           frames::yellow, frames::black, frames::white};
  for (const frames::Colour& one : colours) {
    for (const frames::Colour& other : colours) {
      if (one == other || (test::few_trials && other != frames::red && one != frames::blue))
        continue;
      const Canvas edge = Canvas(320, 240, one)
                              .rectangle(150, 0, 170, 240, other)
                              .rectangle(60, 70, 50, 50, other)
                              .rectangle(200, 150, 37, 41, one)
                              .noise(1, 1);
      EXPECT_GE(compare(edge.view(), settings).correlation, straight_edge_correlation_min)
          << int{one[0]} << ' ' << int{one[1]} << ' ' << int{one[2]} << " beside " << int{other[0]}
          << ' ' << int{other[1]} << ' ' << int{other[2]};
    }
  }
}

TEST_P(SaliencyOf, ColourWithoutContrastIsNotSalientToDifferences) {
  for (const frames::Colour& colour :
       {frames::red, frames::green, frames::blue, frames::yellow, frames::black, frames::white}) {
    const Canvas flat(320, 240, colour);
    Saliency saliency(settings, 320, 240);
    const SaliencyResult result = saliency.examine(flat.view());
    // The report's RG and BY are sums: they answer to any uniform colour, everywhere alike.
    if (GetParam() == SaliencyProfile::robust) {
      EXPECT_EQ(result.saliency, 0.0F);
    }
    const auto [lowest, highest] =
        std::minmax_element(result.map.samples.begin(), result.map.samples.end());
    EXPECT_LE(*highest - *lowest, *highest / 100);
    EXPECT_EQ(result.distinctness, 0.0F);
  }
}

// A small disc is found where it is: no half cell between the map and the frame.
TEST_P(SaliencyOf, ASmallDiscIsFoundWithin8Pixels) {
  for (const auto& [x, y] :
       {std::pair{320, 240}, {100, 100}, {133, 391}, {520, 77}, {571, 402}, {248, 200}}) {
    const Canvas canvas =
        Canvas(640, 480, {215, 215, 210}).disc(x, y, 12, {200, 30, 30}).noise(1, 1);
    Saliency saliency(settings, 640, 480);
    const geometry::Pixel found = saliency.examine(canvas.view()).peak_px;
    EXPECT_LE((found - geometry::Pixel(x, y)).norm(), 8.0)
        << "at " << x << ',' << y << " found " << found.transpose();
  }
}

TEST(SaliencyRobust, FlatWithAVignetteHasNoWinnerOnTheBorder) {
  for (int percent : {10, 30, 60}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Canvas canvas = Canvas(640, 480, {200, 195, 185}).vignette(percent).noise(1, seed);
      Saliency saliency(settings_of(SaliencyProfile::robust), 640, 480);
      const SaliencyResult result = saliency.examine(canvas.view());
      if (result.saliency == 0.0F) continue;
      EXPECT_GE(std::min({result.peak_px.x(), result.peak_px.y(), 639 - result.peak_px.x(),
                          479 - result.peak_px.y()}),
                24.0)
          << percent << " % found " << result.peak_px.transpose();
    }
  }
}

/// The same pixels in rows that are padded, from an address on that is `offset` off an aligned one;
/// nothing follows the last pixel.
std::vector<std::uint16_t> map_of_padded(const SaliencySettings& settings,
                                         const base::ImageView& tight, std::ptrdiff_t offset) {
  const std::ptrdiff_t stride = tight.row_stride + 37;
  std::vector<std::uint8_t> bytes(
      static_cast<std::size_t>(offset + stride * (tight.height_px - 1) + tight.row_stride), 0xAA);
  for (int y = 0; y < tight.height_px; ++y)
    std::copy_n(tight.row(y), tight.row_stride, bytes.data() + offset + stride * y);
  base::ImageView padded = tight;
  padded.data = bytes.data() + offset;
  padded.row_stride = static_cast<int>(stride);
  return map_of(settings, padded);
}

TEST_P(SaliencyOf, PaddedRowsChangeNothing) {
  const frames::NamedFrame frame = frames::drawn_frames().front();
  const base::ImageView rgb = frame.canvas.view();
  const std::vector<std::uint8_t> yuyv = frames::yuyv_of(rgb);
  const base::ImageView grey{rgb.data, 3 * 640, 480, 3 * 640, base::PixelFormat::grey};
  for (const base::ImageView& view : {rgb, frames::yuyv_view(yuyv, 640, 480), grey}) {
    const auto tight = map_of(settings, view);
    for (const std::ptrdiff_t offset : {0, 1})
      EXPECT_EQ(map_of_padded(settings, view, offset), tight)
          << base::bytes_per_pixel(view.format) << " bytes a pixel, offset " << offset;
  }
}

TEST_P(SaliencyOf, FramesLeaveNothingBehind) {
  const auto all = frames::drawn_frames();
  Saliency saliency(settings, 640, 480);
  const auto first = map_of(settings, all[1].canvas.view());
  (void)saliency.examine(all[0].canvas.view());
  const SaliencyMap again = saliency.examine(all[1].canvas.view()).map;
  EXPECT_TRUE(std::equal(again.samples.begin(), again.samples.end(), first.begin(), first.end()));
}

TEST_P(SaliencyOf, YuyvShowsWhatRgbShows) {
  // Chroma of half the width and 8 bits of limited range; and in the robust profile chroma is not
  // low-passed along the row at level 0.
  constexpr double correlation_min = 0.99;
  for (const frames::NamedFrame& frame : frames::drawn_frames()) {
    const base::ImageView rgb = frame.canvas.view();
    if (rgb.width_px % 2 != 0) continue;
    const auto bytes = frames::yuyv_of(rgb);
    Saliency from_rgb(settings, rgb.width_px, rgb.height_px),
        from_yuyv = Saliency(settings, rgb.width_px, rgb.height_px);
    const SaliencyResult a = from_rgb.examine(rgb);
    const SaliencyResult b =
        from_yuyv.examine(frames::yuyv_view(bytes, rgb.width_px, rgb.height_px));
    EXPECT_GE(correlation(as_mat(a.map), as_mat(b.map)), correlation_min) << frame.name;
    EXPECT_LE((a.peak_px - b.peak_px).norm(), 16.0) << frame.name;
  }
}

TEST(SaliencyRobust, YuyvFollowsItsOwnReference) {
  const SaliencySettings settings = settings_of(SaliencyProfile::robust);
  for (const frames::NamedFrame& frame : frames::drawn_frames()) {
    const base::ImageView rgb = frame.canvas.view();
    if (rgb.width_px % 2 != 0) continue;
    auto bytes = frames::yuyv_of(rgb);
    Saliency saliency(settings, rgb.width_px, rgb.height_px);
    const SaliencyResult result =
        saliency.examine(frames::yuyv_view(bytes, rgb.width_px, rgb.height_px));
    const cv::Mat yuyv(rgb.height_px, rgb.width_px, CV_8UC2, bytes.data());
    EXPECT_GE(correlation(as_mat(result.map), reference::look_yuyv(yuyv, settings).map),
              drawn_correlation_min)
        << frame.name;
  }
}

// The report profile converts pixel by pixel: the same pixels as rgb24 give the same bits.
TEST(SaliencyReport, YuyvIsItsPixelsAsRgb) {
  std::vector<std::uint8_t> yuyv(std::size_t{2} * 320 * 240, 128), rgb(std::size_t{3} * 320 * 240);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const int luma = (x / 40 + y / 40) % 2 == 0 ? 60 : 180;
      const std::ptrdiff_t i = std::ptrdiff_t{y} * 320 + x;
      yuyv[static_cast<std::size_t>(2 * i)] = static_cast<std::uint8_t>(luma);
      // 255/219 (y - 16) rounded: 44 x 1.1644 = 51.2, 164 x 1.1644 = 190.96
      for (int k = 0; k < 3; ++k) rgb[static_cast<std::size_t>(3 * i + k)] = luma == 60 ? 51 : 191;
    }
  }
  const SaliencySettings settings = settings_of(SaliencyProfile::report);
  EXPECT_EQ(map_of(settings, frames::yuyv_view(yuyv, 320, 240)),
            map_of(settings, {rgb.data(), 320, 240, 960, base::PixelFormat::rgb24}));
}

TEST_P(SaliencyOf, GreyIsRgbWithoutColour) {
  std::vector<std::uint8_t> grey(std::size_t{320} * 240, 100);
  Canvas same(320, 240, {100, 100, 100});
  for (int y = 60; y < 90; ++y) {
    for (int x = 200; x < 230; ++x) {
      grey[static_cast<std::size_t>(320 * y + x)] = 190;
      std::fill_n(same.pixel(x, y), 3, std::uint8_t{190});
    }
  }
  EXPECT_EQ(map_of(settings, {grey.data(), 320, 240, 320, base::PixelFormat::grey}),
            map_of(settings, same.view()));
}

TEST_P(SaliencyOf, SizesFrom160x120To2560x1920FollowTheReference) {
  for (const auto& [width, height] : {std::pair{160, 120},
                                      {161, 121},
                                      {317, 243},
                                      {640, 361},
                                      {499, 643},
                                      {1280, 960},
                                      {1281, 719},
                                      {2560, 1920}}) {
    if (test::few_trials && width > 1000) continue;
    const int x = width * 2 / 3, y = height / 3, radius = height / 16;
    const Canvas canvas = Canvas(width, height, {190, 195, 200})
                              .disc(x, y, radius, {200, 40, 30})
                              .rectangle(width / 8, height / 2, radius, 3 * radius, {60, 60, 70})
                              .noise(2, 1);
    const Comparison c = compare(canvas.view(), settings);
    EXPECT_GE(c.correlation, drawn_correlation_min) << width << 'x' << height;
    EXPECT_LE(c.winner_distance, 1) << width << 'x' << height;
  }
}

TEST_P(SaliencyOf, TheMapIsOfScaleFour) {
  const Canvas canvas(163, 127, frames::grey);
  Saliency saliency(settings, 163, 127);
  const SaliencyMap map = saliency.examine(canvas.view()).map;
  EXPECT_EQ(map.width, 11);  // 163, 82, 41, 21, 11
  EXPECT_EQ(map.height, 8);  // 127, 64, 32, 16, 8
  EXPECT_EQ(map.samples.size(), 88U);
}

}  // namespace
}  // namespace gazed::saliency::saliency_test
