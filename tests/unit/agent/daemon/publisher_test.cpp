#include "agent/daemon/publisher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "agent/daemon/report.hpp"
#include "drivers/jpeg/decoder.hpp"

#include "tests/unit/agent/daemon/example_fixation.hpp"
#include "tests/unit/drivers/lcm/messages.hpp"

namespace gazed::daemon::publisher_test {
namespace {

using settings::PublishedImages;
using ::testing::AllOf;
using ::testing::ElementsAre;

template <std::size_t count>
void fill(double (&field)[count], const double (&values)[count]) {
  std::copy(std::begin(values), std::end(values), field);
}

/// Of example_fixation(), written down anew.
located_point_t example_point() {
  located_point_t point{};
  point.utime = 1'700'000'000'000'000;
  point.fixation = 3;
  point.status = located_point_t::LOCATED;
  point.reason = "relative sigma 5 %, a \"quoted\" word";
  point.views = 2;
  fill(point.position_m, {0.35, 0.04, 0.19});
  fill(point.covariance_m2[0], {4e-4, 1e-5, 2e-5});
  fill(point.covariance_m2[1], {1e-5, 9e-4, 3e-5});
  fill(point.covariance_m2[2], {2e-5, 3e-5, 1e-4});
  fill(point.camera_position_m, {0.01, 0.02, 0.30});
  point.range_m = 0.30;
  point.range_sigma_m = 0.018;
  point.inverse_range_per_m = 1.0 / 0.30;
  point.inverse_range_sigma_per_m = 0.2;
  point.parallax_rad = 0.033;
  point.residual_px = 0.12;
  fill(point.pixel_1, {319.5, 240.25});
  fill(point.pixel_2, {400.75, 158.5});
  fill(point.head_1_rad, {0.001, -0.002});
  fill(point.head_2_rad, {0.108, 0.109});
  point.saliency = 0.75F;
  point.distinctness = 0.5F;
  return point;
}

TEST(LocatedPointMessage, CarriesEveryFieldOfTheFixation) {
  const located_point_t message = to_message(example_fixation());
  EXPECT_EQ(to_json(message), to_json(example_point()));            // says which field differs
  EXPECT_EQ(lcm::encoded(message), lcm::encoded(example_point()));  // leaves none out
}

TEST(LocatedPointMessage, CarriesEveryStatus) {
  cycle::Fixation fixation = example_fixation();
  located_point_t expected = example_point();
  const std::array statuses{
      std::pair{cycle::Status::no_salient_object, located_point_t::NO_SALIENT_OBJECT},
      std::pair{cycle::Status::target_lost, located_point_t::TARGET_LOST},
      std::pair{cycle::Status::degenerate, located_point_t::DEGENERATE},
      std::pair{cycle::Status::behind_camera, located_point_t::BEHIND_CAMERA},
      std::pair{cycle::Status::uncertain, located_point_t::UNCERTAIN},
      std::pair{cycle::Status::head_fault, located_point_t::HEAD_FAULT},
      std::pair{cycle::Status::camera_fault, located_point_t::CAMERA_FAULT}};
  for (const auto& [status, number] : statuses) {
    fixation.status = status;
    expected.status = number;
    EXPECT_EQ(lcm::encoded(to_message(fixation)), lcm::encoded(expected)) << name(status);
  }
}

TEST(LocatedPointMessage, HasNaNNeverZeroForWhatHasNoMeaning) {
  const located_point_t message = to_message(cycle::Fixation{});
  for (const double value : message.position_m) EXPECT_TRUE(std::isnan(value));
  for (const double value : message.head_1_rad) EXPECT_TRUE(std::isnan(value));
  for (const double value : message.pixel_2) EXPECT_TRUE(std::isnan(value));
  EXPECT_TRUE(std::isnan(message.range_m));
  EXPECT_TRUE(std::isnan(message.residual_px));
}

TEST(SaliencyMessage, CarriesEveryFieldAndNothingOfTheOneBefore) {
  const std::array<std::uint16_t, 6> samples{1000, 0, 1000, 0, 0, 0};
  cycle::UsedSaliency used;
  used.utime_us = 1'700'000'000'000'001;
  used.result.map = {samples, 3, 2};
  used.result.peak_px = {32.5, 16.25};
  used.result.saliency = 0.75F;
  used.result.distinctness = 0.25F;
  saliency_map_t message{};
  message.map.assign(100, 7);  // of a larger camera
  to_message(used, message);
  saliency_map_t expected{};
  expected.utime = 1'700'000'000'000'001;
  expected.width = 3;
  expected.height = 2;
  expected.size = 6;
  expected.map = {255, 0, 255, 0, 0, 0};
  fill(expected.peak_px, {32.5, 16.25});
  expected.saliency = 0.75F;
  expected.distinctness = 0.25F;
  EXPECT_EQ(lcm::encoded(message), lcm::encoded(expected));
}

TEST(SaliencyMessage, HasItsMaximumAt255) {
  const std::array<std::uint16_t, 6> samples{0, 100, 200, 300, 400, 1000};
  cycle::UsedSaliency used;
  used.result.map = {samples, 3, 2};
  used.result.saliency = 0.5F;
  saliency_map_t message{};
  to_message(used, message);
  EXPECT_EQ(message.width, 3);
  EXPECT_EQ(message.height, 2);
  EXPECT_EQ(message.size, 6);
  // 255 sample / 1000, rounded.
  EXPECT_THAT(message.map, ElementsAre(0, 26, 51, 77, 102, 255));
  EXPECT_EQ(message.saliency, 0.5F);
}

TEST(SaliencyMessage, OfAnEmptySceneIsBlack) {
  const std::array<std::uint16_t, 4> samples{};
  cycle::UsedSaliency used;
  used.result.map = {samples, 2, 2};
  saliency_map_t message{};
  to_message(used, message);
  EXPECT_THAT(message.map, ElementsAre(0, 0, 0, 0));
}

status_t looking() {
  status_t status{};
  status.utime = 1;
  status.state = "looking";
  status.camera = "sim";
  return status;
}

/// What a publisher sent, by channel.
class Sent {
 public:
  explicit Sent(const std::string& prefix, const settings::PublishSettings& settings = {},
                CameOverLcm came = {})
      : publisher_(link_, prefix, settings, came) {
    const lcm::Channels channels(prefix);
    for (const std::string& channel :
         {channels.image, channels.head_state, channels.head_command, channels.located_point,
          channels.fixation, channels.saliency, channels.status}) {
      link_.subscribe(channel, 100'000, [this, channel](auto bytes) {
        by_channel_[channel].assign(bytes.begin(), bytes.end());
      });
    }
  }

  /// One of each kind.
  std::map<std::string, std::vector<std::uint8_t>> all() {
    publisher_.publish(example_point());
    publisher_.publish(to_fixation_message(example_fixation(), "nao-v6"));
    publisher_.publish(looking());
    publisher_.publish(cycle::UsedSaliency{.utime_us = 2, .result = {}});
    publisher_.publish(
        geometry::HeadState{.utime_us = 3, .measured = {0.1, 0.2}, .velocity_rad_s = {}});
    publisher_.publish(
        geometry::HeadCommand{.utime_us = 4, .target = {0.3, 0.4}, .speed_fraction = 0.5});
    publisher_.publish(geometry::Frame{image_.view(), 5});
    link_.handle();
    return by_channel_;
  }

  [[nodiscard]] const base::Image& image() const { return image_; }

 private:
  base::Image image_ = lcm::test_image(8, 4, base::PixelFormat::yuyv);
  lcm::LcmLink link_{"memq://"};
  Publisher publisher_;
  std::map<std::string, std::vector<std::uint8_t>> by_channel_;
};

TEST(Publishing, EachKindGoesToItsChannel) {
  Sent sent("ROBOT", {.images = PublishedImages::pixels});
  const auto messages = sent.all();
  const auto holds = [&](const std::string& channel, const auto& message) {
    const auto found = messages.find(channel);
    return found != messages.end() && found->second == lcm::encoded(message);
  };
  head_state_t state{};
  lcm::to_message(geometry::HeadState{.utime_us = 3, .measured = {0.1, 0.2}, .velocity_rad_s = {}},
                  state);
  head_command_t command{};
  lcm::to_message(geometry::HeadCommand{.utime_us = 4, .target = {0.3, 0.4}, .speed_fraction = 0.5},
                  command);
  bot_core::image_t image{};
  lcm::to_message(geometry::Frame{sent.image().view(), 5}, image);
  saliency_map_t map{};
  to_message(cycle::UsedSaliency{.utime_us = 2, .result = {}}, map);
  EXPECT_TRUE(holds("ROBOT_LOCATED_POINT", example_point()));
  EXPECT_TRUE(holds("ROBOT_FIXATION", to_fixation_message(example_fixation(), "nao-v6")));
  EXPECT_TRUE(holds("ROBOT_STATUS", looking()));
  EXPECT_TRUE(holds("ROBOT_SALIENCY", map));
  EXPECT_TRUE(holds("ROBOT_HEAD_STATE", state));
  EXPECT_TRUE(holds("ROBOT_HEAD_COMMAND", command));
  EXPECT_TRUE(holds("ROBOT_IMAGE", image));
}

TEST(Publishing, WhatIsNotAskedForIsNotSent) {
  const auto kinds = [](const settings::PublishSettings& settings, CameOverLcm came = {}) {
    std::vector<std::string> channels;
    for (const auto& [channel, bytes] : Sent("GAZED", settings, came).all())
      channels.push_back(channel);
    return channels;
  };
  using testing::Not, testing::Contains, testing::SizeIs;
  EXPECT_THAT(kinds({}), AllOf(SizeIs(6), Not(Contains("GAZED_IMAGE"))));
  EXPECT_THAT(kinds({.saliency = false}), AllOf(SizeIs(5), Not(Contains("GAZED_SALIENCY"))));
  EXPECT_THAT(kinds({.images = PublishedImages::pixels}), SizeIs(7));
}

TEST(Publishing, ImagesGoAsJpegOfTheQualityThatIsSet) {
  const auto sent = [](int quality) {
    Sent one("GAZED", {.images = PublishedImages::jpeg, .jpeg_quality = quality});
    const std::vector<std::uint8_t> bytes = one.all().at("GAZED_IMAGE");
    bot_core::image_t image;
    EXPECT_GT(image.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
    return image;
  };
  const bot_core::image_t good = sent(95), poor = sent(10);
  EXPECT_EQ(good.pixelformat, 1196444237);  // MJPG
  EXPECT_EQ(good.utime, 5);
  EXPECT_EQ(good.width, 8);
  EXPECT_EQ(good.height, 4);
  base::Image pixels;
  EXPECT_EQ(jpeg::decode(good.data, 8, 4, pixels), "");
  EXPECT_LT(poor.size, good.size);
}

/// Which of frames at `times_us` are sent, at most so many a second.
std::vector<std::int64_t> published(double per_second, const std::vector<std::int64_t>& times_us) {
  ImageRate rate(per_second);
  std::vector<std::int64_t> due;
  std::ranges::copy_if(times_us, std::back_inserter(due),
                       [&](std::int64_t utime_us) { return rate.is_due(utime_us); });
  return due;
}

TEST(ImageRate, ZeroIsAll) {
  EXPECT_THAT(published(0.0, {1, 2, 3, 3, 1}), ElementsAre(1, 2, 3, 3, 1));
}

TEST(ImageRate, EverySecondOfThirtyFramesASecondIsFifteen) {
  std::vector<std::int64_t> times_us;
  for (int i = 0; i < 300; ++i) times_us.push_back(i * 100'000 / 3 + (i % 3) * 4000);  // jitter
  EXPECT_EQ(published(15.0, times_us).size(), 150U);
  EXPECT_NEAR(static_cast<double>(published(10.0, times_us).size()), 100.0, 1.0);
  EXPECT_NEAR(static_cast<double>(published(20.0, times_us).size()), 200.0, 1.0);
  EXPECT_EQ(published(60.0, times_us).size(), 300U);
}

TEST(ImageRate, GoesOnAfterAPauseAndWhereTheClockIsSetBack) {
  EXPECT_THAT(published(1.0, {0, 500'000, 10'000'000, 10'100'000, 11'000'000}),
              ElementsAre(0, 10'000'000, 11'000'000));
  EXPECT_THAT(published(1.0, {100'000'000, 50'000'000, 50'100'000, 51'000'000}),
              ElementsAre(100'000'000, 50'000'000, 51'000'000));
}

TEST(Publishing, WhatCameOverLcmIsNotSentAgain) {
  const auto messages = [](CameOverLcm came) {
    return Sent("GAZED", {.images = PublishedImages::pixels}, came).all();
  };
  const auto no_head = messages({.head = true}), no_camera = messages({.camera = true});
  EXPECT_EQ(no_head.size(), 5U);
  EXPECT_FALSE(no_head.contains("GAZED_HEAD_STATE") || no_head.contains("GAZED_HEAD_COMMAND"));
  EXPECT_EQ(no_camera.size(), 6U);
  EXPECT_FALSE(no_camera.contains("GAZED_IMAGE"));
}

}  // namespace
}  // namespace gazed::daemon::publisher_test
