// Cameras that give JPEG alone.
#include <cstdint>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/v4l2/v4l2_camera.hpp"

#include "tests/unit/drivers/jpeg/files.hpp"
#include "tests/unit/drivers/v4l2/fake_camera.hpp"

namespace gazed::v4l2::jpeg_test {
namespace {

using ::testing::HasSubstr;

class V4l2Jpeg : public testing::Test {
 protected:
  V4l2Jpeg() {
    kernel.formats = {{V4L2_PIX_FMT_MJPEG, {{640, 480}}}};
    EXPECT_FALSE(dut.next_frame());
  }
  ~V4l2Jpeg() override { EXPECT_THAT(kernel.misuse, testing::IsEmpty()); }

  base::Image picture = jpeg::waves(640, 480);
  jpeg::Bytes coded = jpeg::file_of(picture);
  FakeCamera kernel;
  V4l2Camera dut{{.device = "/dev/video0"}, kernel.system()};
};

TEST_F(V4l2Jpeg, AFrameIsThePicture) {
  kernel.shoot({.content = coded});
  const auto frame = dut.next_frame();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->image.format, base::PixelFormat::rgb24);
  constexpr int greatest_change = 12;  // of a grey level, by the codec at quality 95
  const base::ImageView expected = picture.view();
  for (int y = 0; y < 480; ++y) {
    for (int i = 0; i < 3 * 640; ++i)
      ASSERT_LE(std::abs(frame->image.row(y)[i] - expected.row(y)[i]), greatest_change) << y;
  }
}

TEST_F(V4l2Jpeg, OnlyTheNewestIsDecoded) {
  kernel.shoot({.content = {0xFF, 0xD8, 0xFF, 0xD9}});
  kernel.shoot({.content = coded});
  EXPECT_TRUE(dut.next_frame());
  EXPECT_EQ(dut.health().dropped, 1);
  EXPECT_EQ(dut.notes(), "");
}

TEST_F(V4l2Jpeg, WhatLacksTablesOrEndMarkerIsTaken) {
  constexpr std::uint8_t huffman_tables = 0xC4;
  jpeg::Bytes bare = jpeg::without_segments(coded, huffman_tables);
  bare.resize(bare.size() - 2);
  kernel.shoot({.content = bare});
  EXPECT_TRUE(dut.next_frame());
}

TEST_F(V4l2Jpeg, WhatIsNoPictureIsPassedOverAndCounted) {
  kernel.shoot({.content = jpeg::Bytes(1000, 0x55)});
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.content = jpeg::Bytes(coded.begin(), coded.begin() + 2000)});
  EXPECT_FALSE(dut.next_frame());
  kernel.shoot({.content = jpeg::file_of(jpeg::waves(320, 240))});
  EXPECT_FALSE(dut.next_frame());
  EXPECT_TRUE(dut.health().ok());
  EXPECT_EQ(dut.health().dropped, 3);
  kernel.pass(5.0);
  EXPECT_FALSE(dut.next_frame());
  EXPECT_THAT(dut.health().words, HasSubstr("; of the last one: "));
}

TEST_F(V4l2Jpeg, MoreBytesThanABufferHasAreNotRead) {
  kernel.shoot({.missing_bytes = -1'000'000'000});
  EXPECT_FALSE(dut.next_frame());
}

}  // namespace
}  // namespace gazed::v4l2::jpeg_test
