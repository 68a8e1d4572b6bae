// message_publisher URL: publishes one message of each of gazed's types, ten times over half a
// second. read_with_python.py knows the values.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <thread>

#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/link.hpp"
#include "drivers/lcm/url.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/fixation_t.hpp"
#include "msgs/gazed/located_point_t.hpp"
#include "msgs/gazed/saliency_map_t.hpp"
#include "msgs/gazed/status_t.hpp"

namespace gazed::integration {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t utime_us = 1'700'000'000'123'456;

located_point_t located_point() {
  located_point_t point{};
  point.utime = utime_us;
  point.fixation = 7;
  point.status = located_point_t::UNCERTAIN;
  point.reason = "relative range sigma 0.31 over the gate 0.15";
  point.views = 2;
  for (int i = 0; i < 3; ++i) {
    point.position_m[i] = 0.5 + i;
    point.camera_position_m[i] = 0.25 + i;
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
    point.head_2_rad[i] = -0.25 + i;
  }
  point.saliency = 0.5F;
  point.distinctness = 6.25F;
  return point;
}

fixation_t fixation() {
  fixation_t message{};
  message.utime = utime_us;
  message.fixation = 7;
  message.status = located_point_t::UNCERTAIN;
  message.status_name = "UNCERTAIN";
  message.method = "all_looks";
  look_t look{};
  look.utime = utime_us;
  look.measured_rad[0] = 0.5;
  look.refined_rad[0] = 0.25;
  look.epipole[0] = look.epipole[1] = nan;
  look.chi2 = 1.5F;
  look.used = 1;
  look.noutline = 1;
  look.outline_px = {{1.5F, 2.5F}};
  look.ncorners = 2;
  look.corner_px = {{3.5F, 4.5F}, {5.5F, 6.5F}};
  look.corner_used = {1, 0};
  message.nlooks = 1;
  message.looks = {look};
  message.report_position_m[2] = -0.25;
  message.robot_name = "nao-v6";
  for (int i = 0; i < 13; ++i) {
    message.robot[i] = 0.5 * i;
    message.robot_sigma[i] = nan;
  }
  message.features_used = 44;
  message.features_rejected = 3;
  return message;
}

saliency_map_t saliency_map() {
  saliency_map_t map{};
  map.utime = utime_us;
  map.width = 3;
  map.height = 2;
  map.map = {0, 1, 2, 3, 128, 255};
  map.size = 6;
  map.peak_px[0] = 32.0;
  map.peak_px[1] = 16.0;
  map.saliency = 0.75F;
  map.distinctness = 3.5F;
  return map;
}

status_t status() {
  status_t message{};
  message.utime = utime_us;
  message.state = "looking";
  message.frames = 100;
  message.frames_dropped = 3;
  message.fixations = 8;
  message.located = 5;
  message.saliency_ms = 1.5F;
  message.locate_ms = 12.0F;
  message.cpu_percent = 7.5F;
  message.resident_mb = 12.25F;
  message.camera = "sim 640x480";
  message.head = "sim";
  return message;
}

// 320x240 RGB is more than one packet: LCM sends it in pieces.
bot_core::image_t image() {
  bot_core::image_t message{};
  message.utime = utime_us;
  message.width = 320;
  message.height = 240;
  message.row_stride = 960;
  message.pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB3;
  message.size = 320 * 240 * 3;
  message.data.resize(static_cast<std::size_t>(message.size));
  for (std::size_t i = 0; i < message.data.size(); ++i) {
    message.data[i] = static_cast<std::uint8_t>(i % 251);
  }
  return message;
}

bool publish_all(const std::string& url) {
  const lcm::Channels channels("GAZED");
  lcm::LcmLink link(lcm::effective_lcm_url(url, false));
  bool sent = true;
  for (int i = 0; i < 10 && sent; ++i) {
    sent = link.publish(channels.located_point, located_point()) &&
           link.publish(channels.fixation, fixation()) &&
           link.publish(channels.saliency, saliency_map()) &&
           link.publish(channels.status, status()) && link.publish(channels.image, image());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  if (!sent) std::fprintf(stderr, "%s\n", link.fault().c_str());
  return sent;
}

}  // namespace
}  // namespace gazed::integration

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("message_publisher URL\n", stderr);
    return 2;
  }
  return gazed::integration::publish_all(argv[1]) ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
