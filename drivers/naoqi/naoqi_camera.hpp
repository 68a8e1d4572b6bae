// The camera of a robot that runs NAOqi, whose video device does not let anybody else have it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/camera_timing.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/camera.hpp"
#include "drivers/clocks.hpp"
#include "drivers/naoqi/image_container.hpp"
#include "drivers/naoqi/robot_clock.hpp"

namespace gazed::naoqi {

struct NaoqiCameraSettings {
  QiRobot robot;
  geometry::CameraPosition position = geometry::CameraPosition::top;
  int width_px = geometry::CameraModel().width_px;
  int height_px = geometry::CameraModel().height_px;
  geometry::CameraTiming
      timing{};  // without a new image for timing.timeout_s it is subscribed anew
};

/// YUYV images through ALVideoDevice, 30 a second where the robot and the network can. The pixels
/// handed out are where they were received, until the next call. Controls (exposure, flips) are
/// what NAOqi has set them to.
///
/// The time of an image is the robot's own stamp: unchanged on the robot itself, elsewhere
/// corrected by the difference of the clocks (robot_clock.hpp). Which of the two is decided by the
/// ages of a connection's first ten images.
///
/// Subscribed under a name of this computer's own; what an earlier gazed left behind when it was
/// killed is unsubscribed first, since a name serves only six times. When the driver ends, it waits
/// for the robot to have unsubscribed it, or to be reached again for it, 0.3 s at most.
class NaoqiCamera : public drivers::CameraDriver {
 public:
  /// Throws std::invalid_argument for a size that the robot does not have.
  explicit NaoqiCamera(NaoqiCameraSettings settings,
                       drivers::Clocks clocks = drivers::computers_clocks());
  ~NaoqiCamera() override;

  NaoqiCamera(const NaoqiCamera&) = delete;
  NaoqiCamera& operator=(const NaoqiCamera&) = delete;

  [[nodiscard]] int descriptor() const override { return wake_up_.descriptor(); }
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override;
  /// Dropped: of another size or format than asked for, or of an unknown time.
  [[nodiscard]] drivers::Health health() const override;

 private:
  void serve();
  void subscribe();
  void unsubscribe_left_over(const QiResult& subscribers);
  void subscribe_anew();
  void on_subscribed(const QiResult& result);
  void ask_image();
  void on_image(const QiResult& result);
  void start_over(drivers::HealthKind fault, const std::string& why);
  [[nodiscard]] std::optional<std::int64_t> time_of(std::int64_t stamp_us);

  NaoqiCameraSettings settings_;
  drivers::Clocks clocks_;
  WakeUp wake_up_;
  QiService video_;
  int resolution_;
  std::string name_;    // as the subscriber
  std::string handle_;  // the robot's answer to it; empty while not subscribed
  QiWriter handle_argument_;
  RobotClock robot_clock_;

  bool subscribing_ = false, image_asked_ = false;
  bool subscribed_ = false;        // handle_argument_ is, also while the connection is lost
  bool ending_ = false;            // nothing is subscribed any more
  int images_ = 0;                 // of this connection, as far as they decide whose clock it is
  std::int64_t least_age_us_ = 0;  // of these
  std::int64_t subscribe_us_ = 0;  // not before
  std::int64_t image_us_ = 0;      // the next one is asked for then
  std::int64_t new_image_us_ = 0;  // when the last one came, or was first waited for
  std::int64_t stamp_us_ = 0;
  std::optional<geometry::Frame> frame_;
  std::int64_t unusable_ = 0;
  std::string refused_;  // why the last image was of no use
  drivers::HealthKind fault_ = drivers::HealthKind::ok;
  std::string fault_words_;
};

}  // namespace gazed::naoqi
