#include "agent/daemon/loop.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include "agent/daemon/wiring.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"

#include "loop_devices.hpp"
#include "tests/unit/drivers/log/log_files.hpp"

namespace gazed::daemon::loop_test {
namespace {

class LoopTest : public testing::Test {
 protected:
  LoopTest() {
    settings_ = settings::default_settings();
    settings_.run.print = settings::PrintFormat::none;
    settings_.lcm.url = "memq://";
    settings_.sim.pace = sim::Pace::fast;
  }

  // Nothing to see: a grey image 30 times a second, a still head.
  LoopParts grey_parts(double seconds) {
    constexpr std::int64_t start_us = 1'000'000;
    const auto end_us = start_us + static_cast<std::int64_t>(1e6 * seconds);
    std::vector<geometry::HeadState> states;
    std::vector<std::int64_t> frames;
    for (std::int64_t t = start_us; t < end_us; t += 12'000) states.push_back({t, {}, {}});
    for (std::int64_t t = start_us + 5'000; t < end_us; t += 33'000) frames.push_back(t);
    base::Image grey(640, 480, base::PixelFormat::rgb24);
    std::fill(grey.pixels().begin(), grey.pixels().end(), 128);
    LoopParts parts;
    parts.link = std::make_unique<lcm::LcmLink>(settings_.lcm.url);
    parts.camera = std::make_unique<ListedCamera>(std::move(grey), std::move(frames));
    auto head = std::make_unique<ListedHead>(std::move(states));
    holds_ = head->holds;
    parts.head = std::move(head);
    return parts;
  }

  int run(LoopParts parts) {
    Report report(settings_.run.print, stdout);
    ServiceManager service(service_, getpid());
    return Loop(settings_, std::move(parts), signals_, report, service).run();
  }

  EndSignals signals_;
  ServiceEnvironment service_;
  settings::Settings settings_;
  std::shared_ptr<int> holds_;
};

TEST_F(LoopTest, ARecordingsEndIsAGoodEnd) {
  EXPECT_EQ(run(grey_parts(0.5)), 0);
  EXPECT_EQ(*holds_, 1);
}

TEST_F(LoopTest, ARecordingThatEndsBeforeTheFixationsAreMadeIsNot) {
  settings_.run.fixations = 3;
  EXPECT_EQ(run(grey_parts(2.5)), 1);
}

TEST_F(LoopTest, EndsAfterTheFixationsAskedFor) {
  settings_.run.fixations = 2;
  int scenes = 0;
  LoopParts parts = grey_parts(60.0);
  parts.scene_goes_on = [&] { ++scenes; };
  EXPECT_EQ(run(std::move(parts)), 0);
  EXPECT_EQ(scenes, 2);
}

TEST_F(LoopTest, WarningsOfTheHeadAreToldOnce) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(run(grey_parts(0.5)), 0);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(told.find("gazed: this head is listed\n"), told.rfind("gazed: this head is listed\n"));
  EXPECT_THAT(told, testing::HasSubstr("gazed: this head is listed\n"));
}

TEST_F(LoopTest, ASignalEndsItWithTheHeadStill) {
  // In real time it would last a minute.
  settings_.sim.pace = sim::Pace::real;
  std::raise(SIGTERM);
  EXPECT_EQ(run(grey_parts(60.0)), 0);
  EXPECT_EQ(*holds_, 1);
}

/// All that was published, by channel and in order.
using Published = std::map<std::string, std::vector<std::vector<std::uint8_t>>>;

Published published_in(const std::string& log_file) {
  Published published;
  ::lcm::LogFile log(log_file, "r");
  EXPECT_TRUE(log.good()) << log_file;
  while (const ::lcm::LogEvent* event = log.good() ? log.readNextEvent() : nullptr) {
    const auto* bytes = static_cast<const std::uint8_t*>(event->data);
    published[event->channel].emplace_back(bytes, bytes + event->datalen);
  }
  return published;
}

template <class Message>
std::vector<Message> decoded(const std::vector<std::vector<std::uint8_t>>& messages) {
  std::vector<Message> all;
  for (const auto& bytes : messages) {
    const int size = static_cast<int>(bytes.size());
    EXPECT_EQ(all.emplace_back().decode(bytes.data(), 0, size), size);
  }
  return all;
}

/// Published into a file, which loses nothing and leaves nothing on its way.
class PublishingLoop : public LoopTest {
 protected:
  PublishingLoop() { settings_.lcm.url = "file://" + log_.path() + "?mode=w"; }
  [[nodiscard]] Published published() const { return published_in(log_.path()); }

 private:
  log::TemporaryFile log_;
};

TEST_F(PublishingLoop, StatusTellsTheCamerasSourceAndSizeAndTheHeadsSource) {
  using drivers::Part;
  using drivers::Source;
  settings_.sim.pace = sim::Pace::real;
  const std::pair<const char*, const char*> sources[] = {{"sim", "sim"},
                                                         {"lcm", "lcm"},
                                                         {"log:a.lcm", "log:a.lcm"},
                                                         {"v4l2", "lola"},
                                                         {"v4l2:/dev/video2", "lola:/tmp/a"},
                                                         {"naoqi", "naoqi"},
                                                         {"naoqi:10.0.0.7:9560", "naoqi:10.0.0.7"}};
  for (const auto& [camera, head] : sources) {
    settings_.camera.source = Source::parse(Part::camera, camera).value();
    settings_.head.source = Source::parse(Part::head, head).value();
    EXPECT_EQ(run(grey_parts(0.1)), 0);
    const auto statuses = decoded<status_t>(published()["GAZED_STATUS"]);
    ASSERT_FALSE(statuses.empty()) << camera;
    for (const status_t& status : statuses) {
      EXPECT_EQ(status.camera, std::string(camera) + " 640x480");
      EXPECT_EQ(status.head, head);
    }
  }
}

TEST_F(PublishingLoop, ASimulatedHeadBesideALiveCameraKeepsToTheWallClock) {
  settings_.camera.source = drivers::Source::parse(drivers::Part::camera, "v4l2").value();
  settings_.run.fixations = 1;  // NO_SALIENT_OBJECT after a second of looking
  // Made long before the loop turns, as when a network is searched for meanwhile.
  constexpr std::int64_t early_us = 60'000'000;
  const std::int64_t made_us = LiveCamera::wall_us() - early_us;
  LoopParts parts;
  parts.link = std::make_unique<lcm::LcmLink>(settings_.lcm.url);
  parts.camera = std::make_unique<LiveCamera>();
  parts.head = std::make_unique<sim::SimHead>(std::make_shared<sim::SimRobot>(
      sim::parse_scene("[[report_test]]\nnumber = 1\n", "test.toml"),
      *geometry::robot_profile("nao-v6"), 1, made_us));
  testing::internal::CaptureStderr();
  EXPECT_EQ(run(std::move(parts)), 0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("this camera is grey\n"));
  const auto states = decoded<head_state_t>(published()["GAZED_HEAD_STATE"]);
  ASSERT_FALSE(states.empty());
  EXPECT_GT(states.back().utime, made_us + early_us);
}

// As when NTP sets a robot's clock back, or one image comes with a time that cannot be.
TEST_F(PublishingLoop, StatusAndFaultsFollowAClockThatIsSetBack) {
  settings_.camera.source = drivers::Source::parse(drivers::Part::camera, "v4l2").value();
  settings_.run.fixations = 1;  // NO_SALIENT_OBJECT, once the camera is believed again
  for (const std::int64_t ahead_us : {std::int64_t{3'600'000'000}, std::int64_t{1} << 61}) {
    LoopParts parts;
    parts.link = std::make_unique<lcm::LcmLink>(settings_.lcm.url);
    parts.camera = std::make_unique<LiveCamera>(5, ahead_us);
    parts.head = std::make_unique<sim::SimHead>(std::make_shared<sim::SimRobot>(
        sim::parse_scene("[[report_test]]\nnumber = 1\n", "test.toml"),
        *geometry::robot_profile("nao-v6"), 1, LiveCamera::wall_us()));
    EXPECT_EQ(run(std::move(parts)), 0);
    auto published = this->published();
    const std::int64_t end_us = LiveCamera::wall_us() + 1'000'000;
    EXPECT_LT(decoded<status_t>(published["GAZED_STATUS"]).back().utime, end_us);
    const auto points = decoded<located_point_t>(published["GAZED_LOCATED_POINT"]);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].status, located_point_t::CAMERA_FAULT);
    EXPECT_LT(points[0].utime, end_us) << points[0].reason;
    EXPECT_LT(points[1].utime, end_us) << points[1].reason;
  }
}

TEST_F(PublishingLoop, OfNothingButGreyIsStatusFixationsMapsAndHeadStates) {
  EXPECT_EQ(run(grey_parts(2.5)), 0);
  auto published = this->published();
  EXPECT_EQ(published["GAZED_LOCATED_POINT"].size(), 2U);  // NO_SALIENT_OBJECT, one a second
  EXPECT_EQ(published["GAZED_FIXATION"].size(), 2U);
  EXPECT_EQ(published["GAZED_SALIENCY"].size(), 2U);
  EXPECT_EQ(published["GAZED_HEAD_STATE"].size(), 209U);
  EXPECT_GE(published["GAZED_STATUS"].size(), 2U);
  EXPECT_EQ(published.size(), 5U);
}

TEST_F(PublishingLoop, EveryPointHasItsFixation) {
  settings_.run.fixations = 2;
  EXPECT_EQ(run(make_parts(settings_, settings_.lcm.url)), 0);
  auto published = this->published();
  const auto points = decoded<located_point_t>(published["GAZED_LOCATED_POINT"]);
  const auto fixations = decoded<fixation_t>(published["GAZED_FIXATION"]);
  ASSERT_EQ(points.size(), 2U);
  ASSERT_EQ(fixations.size(), 2U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(fixations[i].utime, points[i].utime);
    EXPECT_EQ(fixations[i].fixation, points[i].fixation);
    EXPECT_EQ(fixations[i].status, points[i].status);
    EXPECT_EQ(fixations[i].robot_name, settings_.robot);
    EXPECT_GE(fixations[i].nlooks, points[i].views);
  }
}

TEST_F(PublishingLoop, TheStatusSaysWhatWasDone) {
  settings_.run.fixations = 1;
  settings_.cycle.locate.looks = 2;
  settings_.publish.images = settings::PublishedImages::pixels;
  EXPECT_EQ(run(make_parts(settings_, settings_.lcm.url)), 0);
  auto published = this->published();
  const auto points = decoded<located_point_t>(published["GAZED_LOCATED_POINT"]);
  const auto images = decoded<bot_core::image_t>(published["GAZED_IMAGE"]);
  const auto states = decoded<head_state_t>(published["GAZED_HEAD_STATE"]);
  const auto statuses = decoded<status_t>(published["GAZED_STATUS"]);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].status, located_point_t::LOCATED) << points[0].reason;
  EXPECT_EQ(published["GAZED_HEAD_COMMAND"].size(), 1U);
  EXPECT_EQ(published["GAZED_SALIENCY"].size(), 2U);  // of both views
  ASSERT_FALSE(images.empty() || states.empty() || statuses.empty());
  const status_t& last = statuses.back();
  EXPECT_EQ(last.state, "stopping");
  EXPECT_EQ(last.utime, std::max(images.back().utime, states.back().utime));
  EXPECT_EQ(last.frames, static_cast<int>(images.size()));
  EXPECT_EQ(last.frames_dropped, 0);
  EXPECT_EQ(last.fixations, 1);
  EXPECT_EQ(last.located, 1);
  EXPECT_GT(last.saliency_ms, 0.0F);
  EXPECT_GT(last.locate_ms, 0.0F);
  EXPECT_GT(last.resident_mb, 1.0F);
  EXPECT_THAT(last.camera, testing::StartsWith("sim"));
  EXPECT_THAT(last.head, testing::StartsWith("sim"));
  EXPECT_EQ(last.fault, "");
  std::vector<std::string> told;
  for (const status_t& status : statuses) {
    if (status.state == "waiting" && told.empty()) continue;  // a busy machine comes to say so
    if (told.empty() || told.back() != status.state) told.push_back(status.state);
  }
  EXPECT_THAT(told, testing::ElementsAre("looking", "turning", "settling", "relooking", "looking",
                                         "stopping"));
}

}  // namespace
}  // namespace gazed::daemon::loop_test
