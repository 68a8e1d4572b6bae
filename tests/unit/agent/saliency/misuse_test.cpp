// Settings out of range, frames and factors that do not fit: refused, and named with their value.
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"

namespace gazed::saliency::misuse_test {
namespace {

using frames::Canvas;

template <typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(SaliencyMisuse, SettingsOutOfRangeAreNamedWithTheirValue) {
  const auto with = [](auto change) {
    SaliencySettings settings;
    change(settings);
    return error_of([&] { Saliency(settings, 640, 480); });
  };
  EXPECT_THAT(with([](auto& s) { s.intensity_weight = -1.0; }),
              testing::HasSubstr("intensity_weight is -1"));
  EXPECT_THAT(with([](auto& s) { s.colour_weight = 10.5; }),
              testing::HasSubstr("colour_weight is 10.5"));
  EXPECT_THAT(with([](auto& s) { s.colour_weight = s.intensity_weight = 0.0; }),
              testing::HasSubstr("both 0"));
  EXPECT_THAT(with([](auto& s) { s.red_green_weight = -0.5; }),
              testing::HasSubstr("red_green_weight is -0.5"));
  EXPECT_THAT(with([](auto& s) { s.blue_yellow_weight = 11.0; }),
              testing::HasSubstr("blue_yellow_weight is 11"));
  EXPECT_THAT(with([](auto& s) { s.red_green_weight = s.blue_yellow_weight = 0.0; }),
              testing::HasSubstr("red_green_weight and blue_yellow_weight are both 0"));
  EXPECT_THAT(with([](auto& s) { s.flicker_weight = 10.5; }),
              testing::HasSubstr("flicker_weight is 10.5"));
  EXPECT_THAT(with([](auto& s) { s.flicker_noise_floor = -1.0; }),
              testing::HasSubstr("flicker_noise_floor is -1"));
  EXPECT_THAT(with([](auto& s) { s.hysteresis = -0.1; }), testing::HasSubstr("hysteresis is -0.1"));
  EXPECT_THAT(with([](auto& s) { s.overexposed_weight = 1.1; }),
              testing::HasSubstr("overexposed_weight is 1.1"));
  EXPECT_THAT(with([](auto& s) { s.inhibition_radius_rad = 0.0; }),
              testing::HasSubstr("inhibition_radius_rad is 0"));
  EXPECT_THAT(with([](auto& s) { s.inhibition_decay_s = std::nan(""); }),
              testing::HasSubstr("inhibition_decay_s is nan"));
  EXPECT_THAT(with([](auto& s) { s.distinctness_min = 1.5; }), testing::HasSubstr("1.5"));
  EXPECT_THAT(with([](auto& s) { s.intensity_noise_floor = std::nan(""); }),
              testing::HasSubstr("intensity_noise_floor is nan"));
  EXPECT_THAT(with([](auto& s) { s.colour_noise_floor = 256.0; }), testing::HasSubstr("256"));
}

TEST(SaliencyMisuse, SizesOutOfRangeAreRefused) {
  for (const auto& [width, height] : {std::pair{159, 120}, {160, 119}, {2561, 1920}, {640, 0}})
    EXPECT_THAT(error_of([&] { Saliency(SaliencySettings{}, width, height); }),
                testing::HasSubstr(std::to_string(width) + "x" + std::to_string(height)));
}

TEST(SaliencyMisuse, FactorsThatDoNotFitTheMapAreRefused) {
  const Canvas canvas(320, 240, frames::grey);
  Saliency saliency(SaliencySettings{}, 320, 240);
  const std::vector<std::uint16_t> kept(299);
  EXPECT_THAT(error_of([&] { (void)saliency.examine(canvas.view(), {.kept = kept}); }),
              testing::AllOf(testing::HasSubstr("299"), testing::HasSubstr("300")));
  EXPECT_THAT(error_of([&] { (void)saliency.examine(canvas.view(), {.without_own_parts = kept}); }),
              testing::AllOf(testing::HasSubstr("own parts has 299"), testing::HasSubstr("300")));
}

TEST(SaliencyMisuse, FramesThatDoNotFitAreRefused) {
  const Canvas canvas(320, 240, frames::grey);
  const base::ImageView good = canvas.view();
  Saliency saliency(SaliencySettings{}, 320, 240);
  EXPECT_THAT(error_of([&] { (void)saliency.examine({}); }), testing::HasSubstr("no pixels"));
  base::ImageView other = good;
  other.height_px = 239;
  EXPECT_THAT(error_of([&] { (void)saliency.examine(other); }), testing::HasSubstr("320x239"));
  other = good;
  other.row_stride = 959;
  EXPECT_THAT(error_of([&] { (void)saliency.examine(other); }), testing::HasSubstr("959"));
  Saliency odd(SaliencySettings{}, 321, 240);
  const base::ImageView yuyv{good.data, 321, 240, 642, base::PixelFormat::yuyv};
  EXPECT_THAT(error_of([&] { (void)odd.examine(yuyv); }), testing::HasSubstr("odd width 321"));
}

}  // namespace
}  // namespace gazed::saliency::misuse_test
