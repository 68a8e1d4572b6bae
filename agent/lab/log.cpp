// gazelab log: pictures and made-up or measured head angles as an LCM log that gazed replays.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/commands.hpp"
#include "agent/lab/head_trace.hpp"
#include "agent/lab/io/frames_csv.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/progress.hpp"
#include "agent/saliency/validation.hpp"
#include "drivers/log/log_writer.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

struct LogOptions {
  fs::path folder;
  fs::path log;
  std::string size;  // "640x480"; empty: as the pictures are
};

bool size_is_taken(cv::Size size) {
  return saliency::size_is_taken(size.width, size.height);
}

std::string text_of(cv::Size size) {
  return base::size_text(size.width, size.height);
}

/// None for an empty text. Throws std::invalid_argument for what is not a size or not taken.
std::optional<cv::Size> parsed_size(std::string_view text) {
  if (text.empty()) return std::nullopt;
  cv::Size size;
  const char* end = text.data() + text.size();
  const auto [cross, width_error] = std::from_chars(text.data(), end, size.width);
  if (width_error == std::errc() && cross != end && *cross == 'x') {
    const auto [rest, height_error] = std::from_chars(cross + 1, end, size.height);
    if (height_error == std::errc() && rest == end && size_is_taken(size)) return size;
  }
  throw std::invalid_argument("--size: '" + std::string(text) + "' found; allowed: WIDTHxHEIGHT, " +
                              saliency::sizes_taken());
}

/// Reads the pictures of one log, all to one size.
class PictureReader {
 public:
  PictureReader(fs::path folder, std::optional<cv::Size> size)
      : folder_(std::move(folder)), resampled_to_(size) {}

  /// 8UC3, red green blue. Throws std::runtime_error that names the file and its line.
  cv::Mat read(const io::RecordedFrame& frame) {
    const cv::Mat picture = [&] {
      try {
        return io::read_picture(folder_ / frame.file, io::Orientation::as_coded);
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(std::string(error.what()) + place(frame));
      }
    }();
    if (resampled_to_) {
      check_shape(frame, picture.size());
      return io::rgb_of(io::resampled(picture, *resampled_to_));
    }
    check_size(frame, picture.size());
    return io::rgb_of(picture);
  }

 private:
  static std::string place(const io::RecordedFrame& frame) {
    return " (line " + std::to_string(frame.line) + " of frames.csv)";
  }

  [[noreturn]] void fail(const io::RecordedFrame& frame, const std::string& why) const {
    throw std::runtime_error((folder_ / frame.file).string() + ": " + why + place(frame));
  }

  void check_shape(const io::RecordedFrame& frame, cv::Size size) const {
    constexpr double greatest_stretch = 0.01;  // from the rounding of sizes, not from another shape
    const double x = static_cast<double>(resampled_to_->width) / size.width;
    const double y = static_cast<double>(resampled_to_->height) / size.height;
    if (std::abs(x / y - 1.0) <= greatest_stretch) return;
    fail(frame, "is " + text_of(size) + ", another shape than " + text_of(*resampled_to_) +
                    ": crop it first");
  }

  void check_size(const io::RecordedFrame& frame, cv::Size size) {
    if (!size_is_taken(size)) {
      fail(frame, "is " + text_of(size) + ", gazed takes " + saliency::sizes_taken() +
                      ": resample with --size");
    }
    if (first_size_.empty()) first_size_ = size;
    if (size == first_size_) return;
    fail(frame, "is " + text_of(size) + ", the first picture is " + text_of(first_size_) +
                    ": resample with --size");
  }

  fs::path folder_;
  std::optional<cv::Size> resampled_to_;
  cv::Size first_size_;
};

/// A log that takes its name only when it is complete, and leaves nothing behind when it is not.
class WholeLog {
 public:
  explicit WholeLog(const fs::path& file)
      : file_(file),
        part_(file.string() + ".part"),
        writer_(part_.string(), lcm::Channels("GAZED")) {}
  WholeLog(const WholeLog&) = delete;
  WholeLog& operator=(const WholeLog&) = delete;
  ~WholeLog() {
    std::error_code ignored;
    fs::remove(part_, ignored);
  }

  void write(const std::vector<geometry::HeadState>& states) {
    for (const geometry::HeadState& state : states) check(writer_.write(state));
    states_ += states.size();
  }
  void write(const cv::Mat& rgb, std::int64_t utime_us) {
    check(writer_.write(geometry::Frame{.image = io::view_of(rgb), .utime_us = utime_us}));
    ++images_;
  }
  void complete() { fs::rename(part_, file_); }

  [[nodiscard]] std::size_t images() const { return images_; }
  [[nodiscard]] std::size_t states() const { return states_; }

 private:
  void check(bool written) const {
    if (!written) throw std::runtime_error(writer_.fault());
  }

  fs::path file_;
  fs::path part_;
  log::LogWriter writer_;
  std::size_t images_ = 0;
  std::size_t states_ = 0;
};

/// The head's way to `frame` and its picture; after a long pause the picture comes early as well.
void write_step(WholeLog& log, const cv::Mat& rgb, const io::RecordedFrame& frame,
                const std::vector<geometry::HeadState>& states,
                std::span<const std::int64_t> early_us) {
  auto next = states.begin();
  const auto write_until = [&](std::int64_t utime_us) {
    const auto end = std::upper_bound(
        next, states.end(), utime_us,
        [](std::int64_t t, const geometry::HeadState& s) { return t < s.utime_us; });
    log.write({next, end});
    next = end;
    log.write(rgb, utime_us);
  };
  for (const std::int64_t utime_us : early_us) write_until(utime_us);
  write_until(frame.utime_us);
}

std::vector<std::string> inputs_of(const LogOptions& options,
                                   const std::vector<io::RecordedFrame>& frames) {
  std::vector<std::string> inputs = {(options.folder / "frames.csv").string()};
  for (const io::RecordedFrame& frame : frames)
    inputs.push_back((options.folder / frame.file).string());
  return inputs;
}

void write_log(const LogOptions& options) {
  PictureReader pictures(options.folder, parsed_size(options.size));
  const std::vector<io::RecordedFrame> frames = io::read_frames_csv(options.folder / "frames.csv");
  io::check_output_file(options.log, inputs_of(options, frames));
  WholeLog log(options.log);
  io::Progress progress(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const cv::Mat rgb = pictures.read(frames[i]);
    if (i == 0) {
      write_step(log, rgb, frames[0], head_states_before(frames[0]), {});
    } else {
      write_step(log, rgb, frames[i], head_states_between(frames[i - 1], frames[i]),
                 early_showings(frames[i - 1], frames[i]));
    }
    progress.show(i + 1);
  }
  log.write(head_states_after(frames.back()));
  log.complete();
  progress.clear();
  std::fprintf(stderr, "%s: %zu images (%zu of them repeated), %zu head states\n",
               options.log.c_str(), log.images(), log.images() - frames.size(), log.states());
}

int run_log(const LogOptions& options) {
  write_log(options);
  return exit_done;
}

constexpr const char* log_footer = R"(
FOLDER holds pictures and frames.csv, one row a picture in the order of time:

  utime_us,file,yaw_rad,pitch_rad
  1700000000000000,first.jpg,0.0,0.0
  1700000000500000,second.jpg,-0.12,0.1

utime_us: start of exposure, microseconds since the Unix epoch, each 1 ms to 60 s after the one
before. yaw_rad, pitch_rad: HeadYaw (positive left) and HeadPitch (positive down) at that time.

The log has an image (bot_core.image_t, RGB3) on GAZED_IMAGE for each row and head states
(gazed.head_state_t) on GAZED_HEAD_STATE at 100 Hz. Around each picture the head rests at its angles
for 0.4 of the time to the next one, 0.2 s at most; then it turns, in 0.2 of that time, 0.2 s at
most, and rests at the new angles. One state stands exactly on each picture's time.

gazed locates an object from two pictures between which the head turned by 0.02 rad or more, and
takes 2 s without a picture for a broken camera. Where more than 1.5 s lie between two rows, the
second picture is therefore also shown early, every second counted back from its own time, as soon as
the head rests there.

The pixels count as they were coded: an orientation that a camera noted is not applied. All pictures
must have one size, that of gazed's camera.width_px and camera.height_px; --size resamples them (area
average) and keeps their shape.

Exit: 0 done, 1 a file could not be read or written, 2 bad arguments. OUT.lcm appears only when it is
complete.

Examples:
  gazelab log walk walk.lcm
  gazelab log --size 640x480 walk walk.lcm && gazed --camera log:walk.lcm --head log:walk.lcm
)";

}  // namespace

Command add_log_command(CLI::App& gazelab) {
  CLI::App* command = gazelab.add_subcommand(
      "log", "Write pictures and their head angles as an LCM log that gazed replays.");
  const auto options = std::make_shared<LogOptions>();
  command->add_option("FOLDER", options->folder, "pictures and frames.csv")
      ->required()
      ->type_name("");
  command->add_option("OUT.lcm", options->log, "the log to write")->required()->type_name("");
  command->add_option("--size", options->size, "resample every picture to this size")
      ->type_name("WxH");
  command->footer(log_footer);
  return {.options = command, .run = [options] { return run_log(*options); }};
}

}  // namespace gazed::lab
