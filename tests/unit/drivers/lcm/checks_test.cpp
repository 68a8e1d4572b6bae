#include "drivers/lcm/checks.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <variant>

#include "drivers/lcm/big_endian.hpp"

#include "messages.hpp"

namespace gazed::lcm::checks_test {
namespace {

using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string refusal_of(const bot_core::image_t& message) {
  const auto bytes = encoded(message);
  const auto read = read_image(bytes);
  const auto* refusal = std::get_if<Refusal>(&read);
  return refusal != nullptr ? refusal->reason : "accepted";
}

std::string refusal_of(const head_state_t& message) {
  const auto read = read_head_state(encoded(message));
  const auto* refusal = std::get_if<Refusal>(&read);
  return refusal != nullptr ? refusal->reason : "accepted";
}

class EveryFormat : public ::testing::TestWithParam<base::PixelFormat> {};

TEST_P(EveryFormat, IsReadInPlace) {
  const base::Image image = test_image(6, 4, GetParam());
  const auto bytes = encoded(image_message(6, 4, GetParam(), 42));
  const auto read = read_image(bytes);
  ASSERT_TRUE(std::holds_alternative<WireImage>(read)) << std::get<Refusal>(read).reason;
  const auto& frame = std::get<WireImage>(read).frame;
  EXPECT_EQ(frame.utime_us, 42);
  EXPECT_TRUE(same_pixels(frame.image, image.view()));
  EXPECT_GE(frame.image.data, bytes.data());
  EXPECT_LT(frame.image.data, bytes.data() + bytes.size());
}

TEST_P(EveryFormat, IsReadWithPaddedRows) {
  const base::Image image = test_image(6, 4, GetParam());
  bot_core::image_t message = image_message(6, 4, GetParam());
  const int row_bytes = message.row_stride;
  message.row_stride = row_bytes + 5;
  message.data.clear();
  for (int y = 0; y < 4; ++y) {
    message.data.insert(message.data.end(), image.view().row(y), image.view().row(y) + row_bytes);
    if (y < 3) message.data.insert(message.data.end(), 5, 0xAA);  // the last row may end early
  }
  message.size = static_cast<int>(message.data.size());
  const auto bytes = encoded(message);
  const auto read = read_image(bytes);
  ASSERT_TRUE(std::holds_alternative<WireImage>(read)) << std::get<Refusal>(read).reason;
  EXPECT_TRUE(same_pixels(std::get<WireImage>(read).frame.image, image.view()));
}

INSTANTIATE_TEST_SUITE_P(ReadImage, EveryFormat,
                         ::testing::Values(base::PixelFormat::grey, base::PixelFormat::rgb24,
                                           base::PixelFormat::yuyv));

TEST(ReadImage, MetadataIsPassedOver) {
  auto message = image_message(2, 2, base::PixelFormat::grey);
  message.metadata.resize(2);
  message.metadata[0] = {"exposure", 3, {1, 2, 3}};
  message.metadata[1] = {"", 0, {}};
  message.nmetadata = 2;
  EXPECT_EQ(refusal_of(message), "accepted");
}

TEST(ReadImage, EmptyMessage) {
  const auto read = read_image({});
  EXPECT_EQ(std::get<Refusal>(read).reason, "too short to be a bot_core.image_t");
}

TEST(ReadImage, AnotherType) {
  const auto read = read_image(encoded(head_message(0, 0)));
  EXPECT_THAT(std::get<Refusal>(read).reason, HasSubstr("14739ffe13d5f5f0 expected"));
}

TEST(ReadImage, CutShortAnywhere) {
  const auto bytes = encoded(image_message(4, 2, base::PixelFormat::yuyv));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto read = read_image(std::span(bytes).first(length));
    EXPECT_TRUE(std::holds_alternative<Refusal>(read)) << length << " of " << bytes.size();
  }
}

TEST(ReadImage, BytesLeftOver) {
  auto bytes = encoded(image_message(4, 2, base::PixelFormat::yuyv));
  bytes.push_back(0);
  EXPECT_TRUE(std::holds_alternative<Refusal>(read_image(bytes)));
}

TEST(ReadImage, PixelformatThatIsNotRead) {
  auto message = image_message(4, 2, base::PixelFormat::yuyv);
  message.pixelformat = 'N' | 'V' << 8 | '1' << 16 | '2' << 24;
  EXPECT_THAT(refusal_of(message), HasSubstr("pixelformat NV12 found"));
  message.pixelformat = 'Y' | '1' << 8 | '6' << 16 | ' ' << 24;
  EXPECT_THAT(refusal_of(message),
              HasSubstr("pixelformat Y16 (grey of 16 bit) found; YUYV, UYVY, RGB3, BGR3, GREY (8 "
                        "bit) or MJPG can be read"));
  message.pixelformat = 357;  // libbot2's PIXEL_FORMAT_BE_GRAY16
  EXPECT_THAT(refusal_of(message), HasSubstr("BE_GRAY16 (grey of 16 bit) found"));
  message.pixelformat = 825770306;  // libbot2's PIXEL_FORMAT_BAYER_BGGR
  EXPECT_THAT(refusal_of(message), HasSubstr("BAYER_BGGR (a sensor's mosaic) found"));
  message.pixelformat = -3;
  EXPECT_THAT(refusal_of(message), HasSubstr("pixelformat -3 found"));
}

TEST(ReadImage, AbsurdSides) {
  for (const int side :
       {0, -1, 16385, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    auto message = image_message(4, 2, base::PixelFormat::rgb24);
    message.width = side;
    EXPECT_THAT(refusal_of(message), HasSubstr("pixels; 1 to 16384")) << side;
    message = image_message(4, 2, base::PixelFormat::rgb24);
    message.height = side;
    EXPECT_THAT(refusal_of(message), HasSubstr("pixels; 1 to 16384")) << side;
  }
}

TEST(ReadImage, LyingRowStride) {
  for (const int stride : {0, -1, 7, std::numeric_limits<int>::min()}) {
    auto message = image_message(4, 2, base::PixelFormat::yuyv);
    message.row_stride = stride;
    EXPECT_THAT(refusal_of(message), HasSubstr("a row of 4 pixels has 8 bytes")) << stride;
  }
  auto message = image_message(4, 2, base::PixelFormat::yuyv);
  message.row_stride = std::numeric_limits<int>::max();
  EXPECT_THAT(refusal_of(message), HasSubstr("need 2147483655 bytes"));
}

// What the message says in front of the pixels, against what it holds.
TEST(ReadImage, LyingSize) {
  constexpr std::size_t size_at = 8 + 8 + 4 * 4;
  for (const std::int32_t size : {0, 15, -1, std::numeric_limits<std::int32_t>::min()}) {
    auto bytes = encoded(image_message(4, 2, base::PixelFormat::yuyv));
    write_big_endian(size, std::span(bytes).subspan(size_at));
    EXPECT_THAT(std::get<Refusal>(read_image(bytes)).reason, HasSubstr("need 16 bytes")) << size;
  }
  for (const std::int32_t size : {21, 1'000'000'000, std::numeric_limits<std::int32_t>::max()}) {
    auto bytes = encoded(image_message(4, 2, base::PixelFormat::yuyv));
    write_big_endian(size, std::span(bytes).subspan(size_at));
    EXPECT_THAT(std::get<Refusal>(read_image(bytes)).reason, HasSubstr("bytes are left")) << size;
  }
}

TEST(ReadImage, LyingMetadata) {
  auto message = image_message(2, 2, base::PixelFormat::grey);
  message.metadata.resize(1);
  message.metadata[0] = {"key", 2, {1, 2}};
  message.nmetadata = 1;
  const auto sound = encoded(message);
  // From the end: 2 value bytes, their count, "key" and its zero, the key's length, nmetadata.
  for (const std::size_t from_end : {6U, 14U, 18U}) {
    for (const std::int32_t lie : {-1, 3, std::numeric_limits<std::int32_t>::max()}) {
      auto bytes = sound;
      write_big_endian(lie, std::span(bytes).last(from_end));
      EXPECT_THAT(std::get<Refusal>(read_image(bytes)).reason, HasSubstr("metadata"))
          << from_end << ' ' << lie;
    }
  }
}

TEST(ReadImage, RandomDamageIsRefusedOrHarmless) {
  std::mt19937_64 random(1);
  auto message = image_message(16, 8, base::PixelFormat::yuyv);
  message.metadata.resize(1);
  message.metadata[0] = {"key", 2, {1, 2}};
  message.nmetadata = 1;
  const auto sound = encoded(message);
  int accepted = 0;
  std::uint64_t sum = 0;
  for (int i = 0; i < 100'000; ++i) {
    auto bytes = sound;
    mutate(bytes, random);
    bytes.shrink_to_fit();  // so that the address sanitizer sees the first byte beyond
    const auto read = read_image(bytes);
    if (const auto* frame = std::get_if<WireImage>(&read)) {
      ++accepted;
      const base::ImageView& image = frame->frame.image;
      for (int y = 0; y < image.height_px && frame->coding != Coding::jpeg; ++y) {
        sum += image.row(y)[image.width_px * base::bytes_per_pixel(image.format) - 1];
      }
    }
  }
  EXPECT_GT(accepted, 0) << "damage to a pixel or to the time cannot be seen";
  EXPECT_LT(accepted, 100'000);
  EXPECT_GT(sum, 0U);
}

TEST(ReadHeadState, IsRead) {
  auto message = head_message(0.25, -0.125, 42);
  message.yaw_velocity_rad_s = 1.5;
  message.pitch_velocity_rad_s = nan;
  const auto read = read_head_state(encoded(message));
  ASSERT_TRUE(std::holds_alternative<geometry::HeadState>(read));
  const auto& state = std::get<geometry::HeadState>(read);
  EXPECT_EQ(state.utime_us, 42);
  EXPECT_EQ(state.measured, (geometry::HeadAngles{0.25, -0.125}));
  EXPECT_EQ(state.velocity_rad_s.yaw_rad, 1.5);
  EXPECT_TRUE(std::isnan(state.velocity_rad_s.pitch_rad)) << "not measured stays not measured";
  EXPECT_EQ(state.stiffness, 0.7F);
  EXPECT_EQ(state.temperature_c, 38.0F);
}

TEST(ReadHeadState, NanAngle) {
  EXPECT_THAT(refusal_of(head_message(nan, 0.0)), HasSubstr("head angles (nan, 0) rad"));
  EXPECT_THAT(refusal_of(head_message(0.0, nan)), HasSubstr("head angles (0, nan) rad"));
}

TEST(ReadHeadState, InfiniteAngle) {
  EXPECT_THAT(refusal_of(head_message(infinity, 0.0)), HasSubstr("within +-pi"));
  EXPECT_THAT(refusal_of(head_message(0.0, -infinity)), HasSubstr("within +-pi"));
}

TEST(ReadHeadState, AngleInDegrees) {
  EXPECT_THAT(refusal_of(head_message(30.0, 0.0)), HasSubstr("head angles (30, 0) rad"));
  EXPECT_EQ(refusal_of(head_message(std::numbers::pi, -std::numbers::pi)), "accepted");
}

TEST(ReadHeadState, AnotherType) {
  const auto read = read_head_state(encoded(image_message(2, 2, base::PixelFormat::grey)));
  EXPECT_THAT(std::get<Refusal>(read).reason, HasSubstr("not a gazed.head_state_t"));
}

TEST(ReadHeadState, AnyOtherLength) {
  auto bytes = encoded(head_message(0, 0));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(read_head_state(std::span(bytes).first(length))));
  }
  bytes.push_back(0);
  EXPECT_TRUE(std::holds_alternative<Refusal>(read_head_state(bytes)));
}

TEST(ReadHeadState, RandomDamageNeverGivesAnAngleThatCannotBe) {
  std::mt19937_64 random(2);
  const auto sound = encoded(head_message(0.25, -0.125));
  int accepted = 0;
  for (int i = 0; i < 100'000; ++i) {
    auto bytes = sound;
    mutate(bytes, random);
    bytes.shrink_to_fit();
    const auto read = read_head_state(bytes);
    if (const auto* state = std::get_if<geometry::HeadState>(&read)) {
      ++accepted;
      ASSERT_LE(std::abs(state->measured.yaw_rad), std::numbers::pi);
      ASSERT_LE(std::abs(state->measured.pitch_rad), std::numbers::pi);
    }
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 100'000);
}

}  // namespace
}  // namespace gazed::lcm::checks_test
