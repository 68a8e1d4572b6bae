// Frames of a camera and of a video, and gazelab saliency as a user runs it on them.
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/lab/live/sources.hpp"

#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::live::live_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// Gives two frames, the second one at the second time of asking; then it is at its end, or broken.
class FakeCamera : public drivers::CameraDriver {
 public:
  explicit FakeCamera(std::string fault) : fault_(std::move(fault)) {}

  std::optional<geometry::Frame> next_frame() override {
    ++asked_;
    if (asked_ != 1 && asked_ != 3) return std::nullopt;
    return geometry::Frame{.image = image_.view(), .utime_us = asked_};
  }
  [[nodiscard]] bool finished() const override { return asked_ > 3 && fault_.empty(); }
  [[nodiscard]] drivers::Health health() const override {
    drivers::Health health;
    health.add(drivers::HealthKind::lost, fault_);
    return health;
  }

 private:
  std::string fault_;
  int asked_ = 0;
  base::Image image_{320, 240, base::PixelFormat::yuyv};
};

constexpr double no_patience_s = 0.2;

TEST(LiveCamera, WaitsForItsFrames) {
  Camera camera("fake", std::make_unique<FakeCamera>(""), 60.0);
  EXPECT_EQ(camera.next().size(), cv::Size(320, 240));
  EXPECT_EQ(camera.next().size(), cv::Size(320, 240));
  EXPECT_TRUE(camera.next().empty());
}

TEST(LiveCamera, SaysWhyNoFrameComes) {
  Camera camera("fake", std::make_unique<FakeCamera>("fake: it was unplugged"), no_patience_s);
  static_cast<void>(camera.next());
  static_cast<void>(camera.next());
  try {
    static_cast<void>(camera.next());
    FAIL() << "a frame came";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "fake: it was unplugged");
  }
}

class LiveSaliency : public ::testing::Test {
 protected:
  static constexpr int frames = 6;
  static constexpr double fps = 12.5;

  /// A disc that goes to the right, 20 px a frame.
  std::string video() {
    const std::string file = (folder_ / "disc.avi").string();
    cv::VideoWriter writer(file, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), fps, {320, 240});
    for (int i = 0; i < frames; ++i)
      writer.write(red_disc({320, 240}, {100.0 + 20.0 * i, 120.0}, 20));
    return file;
  }
  static Outcome run(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"saliency"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gazelab(arguments);
  }

  ScratchFolder folder_;
};

TEST_F(LiveSaliency, AVideoHasItsFramesAndItsPace) {
  Video source(video());
  EXPECT_NEAR(source.pace(), fps, 0.01);
  int count = 0;
  while (!source.next().empty()) ++count;
  EXPECT_EQ(count, frames);
}

TEST_F(LiveSaliency, ARowForEachFrameFollowsTheDisc) {
  const Outcome outcome = run({"--video", video(), "--csv", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  constexpr double of_a_cell_px = 8.0;  // the map's cells, 16 px of the doubled frame
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "image,x_px,y_px,saliency,distinctness,distinct");
  for (int i = 0; i < frames; ++i) {
    ASSERT_TRUE(std::getline(lines, line)) << outcome.out;
    EXPECT_THAT(line, HasSubstr("#00000" + std::to_string(i + 1)));
    EXPECT_NEAR(std::stod(line.substr(line.find(',') + 1)), 100.0 + 20.0 * i, of_a_cell_px);
    EXPECT_THAT(line, HasSubstr(",yes"));
  }
  EXPECT_FALSE(std::getline(lines, line));
  EXPECT_THAT(outcome.err,
              ContainsRegex("disc.avi: 6 frames, [0-9.]+ a second, saliency [0-9.]+ ms each"));
}

TEST_F(LiveSaliency, OverlaysAreFilesAndFramesAnEnd) {
  const std::filesystem::path out = folder_ / "out";
  EXPECT_EQ(run({"--video", video(), "--overlay", out.string(), "--frames", "2"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(out / "000002.png"));
  EXPECT_FALSE(std::filesystem::exists(out / "000003.png"));
}

TEST_F(LiveSaliency, RefusesWhatItCannotDo) {
  const auto expect_refusal = [](const Outcome& outcome, int code, const std::string& why) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(why));
  };
  const std::string none = (folder_ / "none.avi").string();
  expect_refusal(run({"--video", none, "--csv", "-"}), 2, none + ": there is no such file");
  write_text(none, "no video");
  expect_refusal(run({"--video", none, "--csv", "-"}), 2,
                 none + ": no video that OpenCV can decode");
  expect_refusal(run({}), 2, "one of IMAGE, --camera and --video is needed");
  expect_refusal(run({"--video", none, "--camera", "/dev/video0"}), 2,
                 "one of IMAGE, --camera and --video");
  expect_refusal(run({"--video", none, "--maps", "maps"}), 2, "--maps is for pictures");
  expect_refusal(run({"--frames", "3", "x.png"}), 2, "--frames is for --camera and --video");
  expect_refusal(run({"--camera", (folder_ / "video7").string(), "--csv", "-"}), 1, "video7");
}

TEST_F(LiveSaliency, AVideoIsNotOverwritten) {
  const std::string file = video();
  EXPECT_EQ(run({"--video", file, "--csv", file}).exit_code, 2);
  EXPECT_GT(std::filesystem::file_size(file), 1000U);
}

TEST_F(LiveSaliency, WithoutADisplayItSaysWhatToDo) {
  for (const std::string display : {"", ":54321", "not a display"}) {
    ::setenv("DISPLAY", display.c_str(), 1);
    const Outcome outcome = run({"--video", video()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("DISPLAY is '" + display + "'"),
                                   HasSubstr("--csv FILE or --overlay DIR")));
  }
  ::unsetenv("DISPLAY");
  EXPECT_THAT(run({"--video", video()}).err, HasSubstr("DISPLAY is not set"));
}

}  // namespace
}  // namespace gazed::lab::live::live_test
