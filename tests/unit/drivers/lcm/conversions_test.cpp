#include "drivers/lcm/conversions.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "messages.hpp"

namespace gazed::lcm::conversions_test {
namespace {

TEST(FourCc, ThereAndBack) {
  for (const auto format :
       {base::PixelFormat::grey, base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    EXPECT_EQ(wire_format(four_cc(format))->format, format);
    EXPECT_EQ(wire_format(four_cc(format))->coding, Coding::plain);
  }
  EXPECT_EQ(four_cc(base::PixelFormat::yuyv), 1448695129);
  EXPECT_EQ(four_cc(base::PixelFormat::rgb24), 859981650);
  EXPECT_EQ(four_cc(base::PixelFormat::grey), 1497715271);
  EXPECT_FALSE(wire_format(0));
}

TEST(ImageMessage, PaddingIsLeftOut) {
  const base::Image wide = test_image(10, 3, base::PixelFormat::rgb24);
  base::ImageView part = wide.view();
  part.width_px = 4;
  bot_core::image_t message;
  to_message(geometry::Frame{part, 7}, message);
  EXPECT_EQ(message.utime, 7);
  EXPECT_EQ(message.width, 4);
  EXPECT_EQ(message.height, 3);
  EXPECT_EQ(message.row_stride, 12);
  EXPECT_EQ(message.size, 36);
  EXPECT_EQ(message.nmetadata, 0);
  const base::ImageView got{message.data.data(), 4, 3, 12, base::PixelFormat::rgb24};
  EXPECT_TRUE(same_pixels(got, part));
}

TEST(ImageMessage, IsEncodedAsLcmGenDoes) {
  for (const auto format :
       {base::PixelFormat::grey, base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    const base::Image wide = test_image(10, 3, format);
    base::ImageView part = wide.view();
    part.width_px = 4;
    const geometry::Frame frame{part, -7};
    bot_core::image_t message;
    to_message(frame, message);
    std::vector<std::uint8_t> expected(static_cast<std::size_t>(message.getEncodedSize())),
        encoded(encoded_bytes(part));
    message.encode(expected.data(), 0, static_cast<int>(expected.size()));
    encode_image(frame, encoded);
    EXPECT_EQ(encoded, expected);
  }
}

TEST(ImageMessage, MemoryIsReused) {
  const base::Image image = test_image(8, 8, base::PixelFormat::yuyv);
  bot_core::image_t message;
  to_message(geometry::Frame{image.view(), 1}, message);
  const std::uint8_t* first = message.data.data();
  to_message(geometry::Frame{image.view(), 2}, message);
  EXPECT_EQ(message.data.data(), first);
}

TEST(HeadMessages, ThereAndBack) {
  const geometry::HeadState state{.utime_us = 5,
                                  .measured = {0.1, -0.2},
                                  .velocity_rad_s = {std::numeric_limits<double>::quiet_NaN(), 0.4},
                                  .stiffness = 0.7F,
                                  .temperature_c = 41.0F};
  head_state_t state_message;
  to_message(state, state_message);
  const geometry::HeadState got = from_message(state_message);
  EXPECT_EQ(got.utime_us, 5);
  EXPECT_EQ(got.measured, state.measured);
  EXPECT_TRUE(std::isnan(got.velocity_rad_s.yaw_rad));
  EXPECT_EQ(got.velocity_rad_s.pitch_rad, 0.4);
  EXPECT_EQ(got.stiffness, 0.7F);
  EXPECT_EQ(got.temperature_c, 41.0F);

  head_command_t command_message;
  to_message(geometry::HeadCommand{.utime_us = 6, .target = {0.3, 0.2}, .speed_fraction = 0.25},
             command_message);
  const geometry::HeadCommand command = from_message(command_message);
  EXPECT_EQ(command.utime_us, 6);
  EXPECT_EQ(command.target, (geometry::HeadAngles{0.3, 0.2}));
  EXPECT_EQ(command.speed_fraction, 0.25);
}

}  // namespace
}  // namespace gazed::lcm::conversions_test
