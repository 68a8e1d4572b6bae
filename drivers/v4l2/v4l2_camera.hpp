// A camera of this computer, through the kernel's V4L2.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/camera_timing.hpp"
#include "drivers/camera.hpp"
#include "drivers/repeated_stamp.hpp"
#include "drivers/v4l2/buffers.hpp"
#include "drivers/v4l2/camera_controls.hpp"
#include "drivers/v4l2/format.hpp"
#include "drivers/v4l2/sequence_gaps.hpp"
#include "drivers/v4l2/stamp_clock.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace gazed::v4l2 {

struct V4l2Settings {
  std::string device;  // "/dev/video0"
  int width_px = geometry::CameraModel().width_px;
  int height_px = geometry::CameraModel().height_px;
  geometry::CameraTiming timing{};
  CameraControls controls{};
  /// The flips go to the extension unit of the NAO V6's cameras, which have no such controls.
  bool flips_by_extension_unit = false;
  /// After the stream begins: exposure and white balance have not settled in them.
  int first_frames_dropped = 0;
};

/// YUYV frames of exactly the size asked for, at 30 a second where the camera can. Frames are not
/// copied: the pixels handed out are the kernel's buffer, which is not filled again before the next
/// call. Where the camera has no YUYV of that size, its JPEG (MJPG) is decoded, of the newest frame
/// only.
///
/// The time of a frame is its stamp in Unix time with delay_s added: the start of exposure of its
/// first row.
///
/// What is lost (no camera yet, unplugged, an error, no frame for the timeout) is closed, told in
/// health(), and opened again, 0.1 s later, then 0.2, 0.4 ... and every 2 s, until a frame comes.
/// That happens in next_frame(), to be called every 100 ms at the latest, also while there is no
/// descriptor. No call waits for a frame or for a time. Opening goes in steps, each as long as the
/// camera needs to answer it; after 50 ms the next one is left to the next call.
class V4l2Camera : public drivers::CameraDriver {
 public:
  explicit V4l2Camera(V4l2Settings settings, VideoSystem system = kernel_video_system());

  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  [[nodiscard]] int descriptor() const override { return device_.descriptor(); }
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override;
  /// Dropped: older than the newest one, left out by the camera's driver, damaged, or too short.
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override;
  [[nodiscard]] std::string warning() override { return std::exchange(unreported_, {}); }

 private:
  /// The steps of opening, in their order: what comes next.
  enum class Opening : std::uint8_t { device, format, controls, buffers, done };

  [[nodiscard]] std::string open();
  [[nodiscard]] std::string open_next();
  void begin_stream();
  void close();
  void lose(drivers::HealthKind fault, const std::string& why);
  [[nodiscard]] std::string take_newest();
  [[nodiscard]] bool is_of_use(const v4l2_buffer& buffer);
  [[nodiscard]] bool decode();
  [[nodiscard]] geometry::Frame frame();
  void report(std::string what);
  void check_stamp(StampClock clock);

  V4l2Settings settings_;
  VideoSystem system_;
  VideoDevice device_{system_};
  VideoBuffers buffers_{system_, device_};
  VideoFormat format_;
  SequenceGaps gaps_;
  Opening opening_ = Opening::device;

  std::optional<v4l2_buffer> held_;  // the newest, handed out
  base::Image decoded_;              // of a camera that gives JPEG
  std::int64_t last_frame_us_ = 0;   // monotonic; since opening, at first
  std::int64_t next_attempt_us_ = 0;
  std::int64_t back_off_us_;
  bool frames_came_ = false;   // since it was last opened
  int first_frames_left_ = 0;  // to be dropped
  bool lost_ = false;          // it gave frames, and is not open again yet
  std::optional<StampClock> stamp_clock_;
  drivers::RepeatedStamp repeated_stamp_;
  std::string unusable_;  // why the last buffer was of no use
  drivers::HealthKind fault_ = drivers::HealthKind::ok;
  std::string fault_words_;
  std::vector<std::string> noted_;
  std::string unreported_;

  std::int64_t older_ = 0, left_out_ = 0, damaged_ = 0, too_short_ = 0;
  std::int64_t reopened_ = 0;  // after it had given frames
};

}  // namespace gazed::v4l2
