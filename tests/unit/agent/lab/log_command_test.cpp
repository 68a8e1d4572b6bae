// gazelab log, read back through the drivers that gazed uses.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "agent/lab/io/picture.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"

#include "scratch.hpp"

namespace gazed::lab::log_command_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* csv_header = "utime_us,file,yaw_rad,pitch_rad\n";
constexpr std::int64_t start_us = 1'700'000'000'000'000;

class GazelabLog : public ::testing::Test {
 protected:
  void picture(const std::string& name, cv::Size size = {320, 240},
               cv::Point2d centre = {100, 80}) {
    cv::imwrite((folder_ / name).string(), red_disc(size, centre, 20));
  }
  void frames(const std::string& rows) { write_text(folder_ / "frames.csv", csv_header + rows); }

  Outcome run(const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"log", folder_.path().string(), log_.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gazelab(arguments);
  }

  [[nodiscard]] std::vector<geometry::HeadState> head_states() const {
    log::LogHead head(log_.string(), lcm::Channels("GAZED"));
    std::vector<geometry::HeadState> states;
    while (!head.finished()) {
      if (const auto state = head.next_state()) states.push_back(*state);
    }
    EXPECT_THAT(head.notes(), IsEmpty());
    return states;
  }

  /// A log that was not made leaves nothing behind.
  void expect_failure(const Outcome& run, int exit_code, const std::string& message) const {
    EXPECT_EQ(run.exit_code, exit_code);
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(log_));
    EXPECT_FALSE(std::filesystem::exists(log_.string() + ".part"));
  }

  ScratchFolder folder_;
  ScratchFolder output_;
  std::filesystem::path log_ = output_ / "out.lcm";
};

/// What a head that is read between its samples says, as the cycle does it.
geometry::HeadAngles interpolated(const std::vector<geometry::HeadState>& states,
                                  std::int64_t utime_us) {
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].utime_us < utime_us) continue;
    const geometry::HeadState& before = states[i - 1];
    const geometry::HeadState& after = states[i];
    const double part = static_cast<double>(utime_us - before.utime_us) /
                        static_cast<double>(after.utime_us - before.utime_us);
    const geometry::HeadAngles way = after.measured - before.measured;
    return before.measured + geometry::HeadAngles{part * way.yaw_rad, part * way.pitch_rad};
  }
  return {};
}

TEST_F(GazelabLog, DriversReadTheFramesAndTheirAngles) {
  picture("a.png");
  picture("b.png", {320, 240}, {200, 120});
  frames("1700000000000000,a.png,0.3,-0.1\n1700000000400000,b.png,-0.123456789,0.2\n");
  ASSERT_EQ(run().exit_code, 0);

  log::LogCamera camera(log_.string(), lcm::Channels("GAZED"), 320, 240);
  const std::vector<std::int64_t> times = {start_us, start_us + 400'000};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto frame = camera.next_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->utime_us, times[i]);
    EXPECT_EQ(frame->image.format, base::PixelFormat::rgb24);
    const cv::Mat rgb = io::rgb_of(io::read_picture(folder_ / (i == 0 ? "a.png" : "b.png")));
    for (int y = 0; y < rgb.rows; ++y) {
      EXPECT_EQ(std::memcmp(frame->image.row(y), rgb.ptr(y), 3U * 320U), 0) << y;
    }
  }
  EXPECT_FALSE(camera.next_frame());
  EXPECT_TRUE(camera.finished());
  EXPECT_THAT(camera.notes(), IsEmpty());

  const auto states = head_states();
  EXPECT_EQ(interpolated(states, times[0]), (geometry::HeadAngles{0.3, -0.1}));
  EXPECT_EQ(interpolated(states, times[1]), (geometry::HeadAngles{-0.123456789, 0.2}));
}

TEST_F(GazelabLog, HeadIsStillForTwoSamplesBeforeEachFrame) {
  for (const char* name : {"a.png", "b.png", "c.png"}) picture(name);
  frames("1000000,a.png,0,0\n1033333,b.png,0.1,0\n4000000,c.png,-0.1,0.1\n");
  ASSERT_EQ(run().exit_code, 0);
  const auto states = head_states();
  for (const std::int64_t utime_us : {1'000'000, 1'033'333, 4'000'000}) {
    int before = 0;
    for (const geometry::HeadState& state : states) {
      if (state.utime_us >= utime_us || utime_us - state.utime_us > 25'000) continue;
      const bool still =
          state.measured == interpolated(states, utime_us) && state.velocity_rad_s.yaw_rad == 0.0;
      before = still ? before + 1 : 0;
    }
    EXPECT_GE(before, 2) << utime_us;
  }
}

TEST_F(GazelabLog, PictureAfterALongPauseIsShownEarly) {
  picture("a.png");
  picture("b.png");
  frames("1000000,a.png,0,0\n4000000,b.png,0.2,0\n");
  const Outcome log = run();
  ASSERT_EQ(log.exit_code, 0);
  EXPECT_THAT(log.err, HasSubstr("4 images (2 of them repeated)"));
  log::LogCamera camera(log_.string(), lcm::Channels("GAZED"), 320, 240);
  const auto states = head_states();
  for (const std::int64_t utime_us : {1'000'000, 2'000'000, 3'000'000, 4'000'000}) {
    const auto frame = camera.next_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->utime_us, utime_us);
    EXPECT_EQ(interpolated(states, utime_us).yaw_rad, utime_us == 1'000'000 ? 0.0 : 0.2);
  }
  EXPECT_FALSE(camera.next_frame());
}

TEST_F(GazelabLog, PicturesAreResampled) {
  picture("a.png", {1280, 960}, {400, 320});
  picture("b.png", {640, 480}, {200, 160});
  frames("1000000,a.png,0,0\n1400000,b.png,0.2,0\n");
  expect_failure(run(), 1, "b.png: is 640x480, the first picture is 1280x960");
  ASSERT_EQ(run({"--size", "320x240"}).exit_code, 0);
  log::LogCamera camera(log_.string(), lcm::Channels("GAZED"), 320, 240);
  for (int i = 0; i < 2; ++i) {
    const auto frame = camera.next_frame();
    ASSERT_TRUE(frame);
    const std::uint8_t* disc = frame->image.row(80) + 3 * 100;
    EXPECT_NEAR(disc[0], 200, 2);  // red
    EXPECT_NEAR(disc[1], 30, 2);
  }
}

TEST_F(GazelabLog, AnotherShapeIsNotStretched) {
  picture("a.png", {640, 426});
  frames("1000000,a.png,0,0\n");
  expect_failure(run({"--size", "640x480"}), 1, "a.png: is 640x426, another shape than 640x480");
}

TEST_F(GazelabLog, SizeThatGazedDoesNotTake) {
  picture("a.png", {100, 80});
  frames("1000000,a.png,0,0\n");
  expect_failure(run(), 1, "a.png: is 100x80, gazed takes 160x120 to 2560x1920");
  for (const char* size : {"640", "640x", "x480", "640x480x3", "640X480", "-640x480", "64x48"}) {
    expect_failure(run({"--size", size}), 2,
                   std::string("'") + size + "' found; allowed: WIDTHxHEIGHT");
  }
}

TEST_F(GazelabLog, MissingPictureIsNamedWithItsLine) {
  picture("a.png");
  frames("1000000,a.png,0,0\n1400000,gone.png,0.2,0\n");
  expect_failure(run(), 1,
                 (folder_ / "gone.png").string() +
                     ": cannot be opened: No such file or directory (line 3 of frames.csv)");
}

TEST_F(GazelabLog, TruncatedPictureIsNamed) {
  picture("a.png");
  write_cut(folder_ / "a.png", folder_ / "b.png", 500);
  frames("1000000,a.png,0,0\n1400000,b.png,0.2,0\n");
  expect_failure(run(), 1, "b.png: the picture ends early");
}

TEST_F(GazelabLog, CsvErrorsNameTheLine) {
  picture("a.png");
  frames("1000000,a.png,0,0\n900000,a.png,0.2,0\n");
  expect_failure(run(), 1, "frames.csv:3: utime_us is 900000");
  frames("1000000,a.png,nan,0\n");
  expect_failure(run(), 1, "frames.csv:2: yaw_rad is 'nan'");
  frames("");
  expect_failure(run(), 1, "frames.csv: no frames");
}

TEST_F(GazelabLog, FolderWithoutCsv) {
  expect_failure(run(), 1, "frames.csv: cannot be opened");
}

TEST_F(GazelabLog, OutputThatCannotBeWritten) {
  picture("a.png");
  frames("1000000,a.png,0,0\n");
  const Outcome run = run_gazelab({"log", folder_.path().string(), "/nowhere/out.lcm"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("/nowhere/out.lcm"), HasSubstr("No such file")));
}

TEST_F(GazelabLog, InputsAreNotOverwritten) {
  picture("a.png");
  frames("1000000,a.png,0,0\n");
  const auto csv = folder_ / "frames.csv";
  const Outcome run = run_gazelab({"log", folder_.path().string(), csv.string()});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("would overwrite the input"));
  EXPECT_THAT(file_text(csv), HasSubstr("1000000,a.png"));
}

}  // namespace
}  // namespace gazed::lab::log_command_test
