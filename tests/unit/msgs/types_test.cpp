// The generated types: fingerprints that other programs rely on, and every field through a round
// trip.
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/fixation_t.hpp"
#include "msgs/gazed/head_command_t.hpp"
#include "msgs/gazed/head_state_t.hpp"
#include "msgs/gazed/located_point_t.hpp"
#include "msgs/gazed/saliency_map_t.hpp"
#include "msgs/gazed/status_t.hpp"

namespace {

using ::testing::ElementsAre;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t utime = 1'700'000'000'123'456;

template <class Message>
Message round_trip(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const auto size = static_cast<int>(bytes.size());
  EXPECT_EQ(message.encode(bytes.data(), 0, size), size);
  Message decoded;
  EXPECT_EQ(decoded.decode(bytes.data(), 0, size), size);
  return decoded;
}

// What LCM hashes from names, types and order of the fields. These are the ones that readers
// outside this project were built with.
TEST(Fingerprints, LocatedPoint) {
  EXPECT_EQ(static_cast<std::uint64_t>(gazed::located_point_t::getHash()), 0x30c4a141f299475cU);
}

TEST(Fingerprints, Fixation) {
  EXPECT_EQ(static_cast<std::uint64_t>(gazed::fixation_t::getHash()), 0x696035f6d5a57270U);
}

TEST(Fingerprints, Image) {
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::image_t::getHash()), 0x14739ffe13d5f5f0U);
}

TEST(Constants, PixelFormatsAreFourCharacterCodes) {
  const auto four_cc = [](const char* c) {
    return c[0] | c[1] << 8 | c[2] << 16 | c[3] << 24;  // V4L2's v4l2_fourcc
  };
  EXPECT_EQ(+bot_core::image_t::PIXEL_FORMAT_YUYV, four_cc("YUYV"));
  EXPECT_EQ(+bot_core::image_t::PIXEL_FORMAT_RGB3, four_cc("RGB3"));
  EXPECT_EQ(+bot_core::image_t::PIXEL_FORMAT_GREY, four_cc("GREY"));
}

TEST(RoundTrip, LocatedPoint) {
  gazed::located_point_t point{};
  point.utime = utime;
  point.fixation = 7;
  point.status = gazed::located_point_t::UNCERTAIN;
  point.reason = "relative range sigma 0.31 over the gate 0.15";
  point.views = 2;
  for (int i = 0; i < 3; ++i) {
    point.position_m[i] = 0.1 + i;
    point.camera_position_m[i] = 0.2 + i;
    for (int j = 0; j < 3; ++j) point.covariance_m2[i][j] = 10.0 * i + j;
  }
  point.range_m = nan;
  point.range_sigma_m = 0.02;
  point.inverse_range_per_m = 3.3;
  point.inverse_range_sigma_per_m = 0.4;
  point.parallax_rad = 0.02;
  point.residual_px = 0.25;
  for (int i = 0; i < 2; ++i) {
    point.pixel_1[i] = 331.5 + i;
    point.pixel_2[i] = 253.25 + i;
    point.head_1_rad[i] = -0.5 + i;
    point.head_2_rad[i] = -0.4 + i;
  }
  point.saliency = 0.5F;
  point.distinctness = 6.25F;

  const gazed::located_point_t got = round_trip(point);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.fixation, 7);
  EXPECT_EQ(got.status, 5);
  EXPECT_EQ(got.reason, point.reason);
  EXPECT_EQ(got.views, 2);
  EXPECT_THAT(got.position_m, ElementsAre(0.1, 1.1, 2.1));
  EXPECT_THAT(got.camera_position_m, ElementsAre(0.2, 1.2, 2.2));
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(got.covariance_m2[i], ElementsAre(10.0 * i, 10.0 * i + 1, 10.0 * i + 2));
  }
  EXPECT_TRUE(std::isnan(got.range_m)) << "a number without meaning stays NaN";
  EXPECT_EQ(got.range_sigma_m, 0.02);
  EXPECT_EQ(got.inverse_range_per_m, 3.3);
  EXPECT_EQ(got.inverse_range_sigma_per_m, 0.4);
  EXPECT_EQ(got.parallax_rad, 0.02);
  EXPECT_EQ(got.residual_px, 0.25);
  EXPECT_THAT(got.pixel_1, ElementsAre(331.5, 332.5));
  EXPECT_THAT(got.pixel_2, ElementsAre(253.25, 254.25));
  EXPECT_THAT(got.head_1_rad, ElementsAre(-0.5, 0.5));
  EXPECT_THAT(got.head_2_rad, ElementsAre(-0.4, 0.6));
  EXPECT_EQ(got.saliency, 0.5F);
  EXPECT_EQ(got.distinctness, 6.25F);
}

gazed::look_t look_with_a_corner() {
  gazed::look_t look{};
  look.utime = utime;
  for (int i = 0; i < 2; ++i) {
    look.measured_rad[i] = 0.1 + i;
    look.refined_rad[i] = 0.2 + i;
    look.pixel[i] = 320.5 + i;
    look.epipole[i] = nan;
    for (int j = 0; j < 2; ++j) look.pixel_covariance_px2[i][j] = 10.0 * i + j;
  }
  for (int i = 0; i < 3; ++i) {
    look.torso_rad[i] = 0.01 * i;
    look.torso_m[i] = 0.001 * i;
  }
  look.chi2 = 1.5F;
  look.used = 1;
  look.reason = "the others contradict it";
  look.noutline = 2;
  look.outline_px = {{1.5F, 2.5F}, {3.5F, 4.5F}};
  look.ncorners = 1;
  look.corner_px = {{5.5F, 6.5F}};
  look.corner_used = {1};
  return look;
}

TEST(RoundTrip, Fixation) {
  gazed::fixation_t fixation{};
  fixation.utime = utime;
  fixation.fixation = 7;
  fixation.status = gazed::located_point_t::UNCERTAIN;
  fixation.status_name = "UNCERTAIN";
  fixation.method = "all_looks";
  fixation.looks = {look_with_a_corner(), gazed::look_t{}};
  fixation.nlooks = 2;
  for (int i = 0; i < 3; ++i) fixation.report_position_m[i] = 0.5 + i;
  fixation.robot_name = "nao-v6";
  for (int i = 0; i < 13; ++i) {
    fixation.robot[i] = 1.0 * i;
    fixation.robot_sigma[i] = 0.1 * i;
  }
  fixation.features_used = 44;
  fixation.features_rejected = 3;

  const gazed::fixation_t got = round_trip(fixation);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.fixation, 7);
  EXPECT_EQ(got.status, 5);
  EXPECT_EQ(got.status_name, "UNCERTAIN");
  EXPECT_EQ(got.method, "all_looks");
  ASSERT_EQ(got.nlooks, 2);
  EXPECT_THAT(got.report_position_m, ElementsAre(0.5, 1.5, 2.5));
  EXPECT_EQ(got.robot_name, "nao-v6");
  EXPECT_EQ(got.robot[12], 12.0);
  EXPECT_EQ(got.robot_sigma[12], 0.1 * 12);
  EXPECT_EQ(got.features_used, 44);
  EXPECT_EQ(got.features_rejected, 3);
  const gazed::look_t& look = got.looks[0];
  EXPECT_EQ(look.utime, utime);
  EXPECT_THAT(look.measured_rad, ElementsAre(0.1, 1.1));
  EXPECT_THAT(look.refined_rad, ElementsAre(0.2, 1.2));
  EXPECT_THAT(look.torso_rad, ElementsAre(0.0, 0.01, 0.02));
  EXPECT_THAT(look.torso_m, ElementsAre(0.0, 0.001, 0.002));
  EXPECT_THAT(look.pixel, ElementsAre(320.5, 321.5));
  EXPECT_THAT(look.pixel_covariance_px2[1], ElementsAre(10.0, 11.0));
  EXPECT_TRUE(std::isnan(look.epipole[0]));
  EXPECT_EQ(look.chi2, 1.5F);
  EXPECT_EQ(look.used, 1);
  EXPECT_EQ(look.reason, "the others contradict it");
  EXPECT_EQ(look.outline_px, fixation.looks[0].outline_px);
  EXPECT_EQ(look.corner_px, fixation.looks[0].corner_px);
  EXPECT_THAT(look.corner_used, ElementsAre(1));
  EXPECT_EQ(got.looks[1].ncorners, 0);
}

TEST(RoundTrip, Image) {
  bot_core::image_t image{};
  image.utime = utime;
  image.width = 2;
  image.height = 2;
  image.row_stride = 4;
  image.pixelformat = bot_core::image_t::PIXEL_FORMAT_YUYV;
  image.data = {1, 2, 3, 4, 5, 6, 7, 255};
  image.size = 8;
  image.metadata.resize(1);
  image.metadata[0].key = "exposure";
  image.metadata[0].value = {9, 8};
  image.metadata[0].n = 2;
  image.nmetadata = 1;

  const bot_core::image_t got = round_trip(image);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.width, 2);
  EXPECT_EQ(got.height, 2);
  EXPECT_EQ(got.row_stride, 4);
  EXPECT_EQ(got.pixelformat, 1448695129);
  EXPECT_EQ(got.size, 8);
  EXPECT_EQ(got.data, image.data);
  ASSERT_EQ(got.nmetadata, 1);
  EXPECT_EQ(got.metadata[0].key, "exposure");
  EXPECT_EQ(got.metadata[0].n, 2);
  EXPECT_THAT(got.metadata[0].value, ElementsAre(9, 8));
}

TEST(RoundTrip, HeadState) {
  gazed::head_state_t state{};
  state.utime = utime;
  state.yaw_rad = 0.25;
  state.pitch_rad = -0.125;
  state.yaw_velocity_rad_s = nan;
  state.pitch_velocity_rad_s = 1.5;
  state.stiffness = -1.0F;
  state.temperature_c = 38.0F;
  const gazed::head_state_t got = round_trip(state);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.yaw_rad, 0.25);
  EXPECT_EQ(got.pitch_rad, -0.125);
  EXPECT_TRUE(std::isnan(got.yaw_velocity_rad_s));
  EXPECT_EQ(got.pitch_velocity_rad_s, 1.5);
  EXPECT_EQ(got.stiffness, -1.0F);
  EXPECT_EQ(got.temperature_c, 38.0F);
}

TEST(RoundTrip, HeadCommand) {
  gazed::head_command_t command{};
  command.utime = utime;
  command.yaw_rad = -0.3;
  command.pitch_rad = 0.2;
  command.speed_fraction = 0.15;
  const gazed::head_command_t got = round_trip(command);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.yaw_rad, -0.3);
  EXPECT_EQ(got.pitch_rad, 0.2);
  EXPECT_EQ(got.speed_fraction, 0.15);
}

TEST(RoundTrip, SaliencyMap) {
  gazed::saliency_map_t map{};
  map.utime = utime;
  map.width = 3;
  map.height = 2;
  map.map = {0, 1, 2, 3, 4, 255};
  map.size = 6;
  map.peak_px[0] = 32.0;
  map.peak_px[1] = 16.0;
  map.saliency = 0.75F;
  map.distinctness = 3.5F;
  const gazed::saliency_map_t got = round_trip(map);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.width, 3);
  EXPECT_EQ(got.height, 2);
  EXPECT_EQ(got.size, 6);
  EXPECT_EQ(got.map, map.map);
  EXPECT_THAT(got.peak_px, ElementsAre(32.0, 16.0));
  EXPECT_EQ(got.saliency, 0.75F);
  EXPECT_EQ(got.distinctness, 3.5F);
}

TEST(RoundTrip, Status) {
  gazed::status_t status{};
  status.utime = utime;
  status.state = "looking";
  status.frames = 100;
  status.frames_dropped = 3;
  status.fixations = 8;
  status.located = 5;
  status.saliency_ms = 1.5F;
  status.locate_ms = 12.0F;
  status.cpu_percent = 7.5F;
  status.resident_mb = 12.25F;
  status.camera = "sim 640x480";
  status.head = "sim";
  status.fault = "";
  const gazed::status_t got = round_trip(status);
  EXPECT_EQ(got.utime, utime);
  EXPECT_EQ(got.state, "looking");
  EXPECT_EQ(got.frames, 100);
  EXPECT_EQ(got.frames_dropped, 3);
  EXPECT_EQ(got.fixations, 8);
  EXPECT_EQ(got.located, 5);
  EXPECT_EQ(got.saliency_ms, 1.5F);
  EXPECT_EQ(got.locate_ms, 12.0F);
  EXPECT_EQ(got.cpu_percent, 7.5F);
  EXPECT_EQ(got.resident_mb, 12.25F);
  EXPECT_EQ(got.camera, "sim 640x480");
  EXPECT_EQ(got.head, "sim");
  EXPECT_EQ(got.fault, "");
}

}  // namespace
