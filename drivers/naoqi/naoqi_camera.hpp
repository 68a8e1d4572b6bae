// The camera of a robot that runs NAOqi, whose video device has exclusive use of it.
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
      timing{};  // if no new image comes for timing.timeout_s, it is subscribed again
};

/// YUYV images through ALVideoDevice, 30 per second if robot and network can deliver them. Pixels
/// are handed out in the receive buffer and are valid until the next call. Controls (exposure,
/// flips) stay as NAOqi has set them.
///
/// The time of an image is the robot's own stamp: unchanged on the robot itself, elsewhere
/// corrected by the difference of the clocks (robot_clock.hpp). The ages of a connection's first
/// ten images decide which case it is.
///
/// The driver subscribes under a name specific to this computer. It first unsubscribes whatever a
/// killed gazed left behind, since a name can subscribe only six times. When it ends, it
/// unsubscribes, waiting at most 0.3 s for the answer or a new connection.
class NaoqiCamera : public drivers::CameraDriver {
 public:
  /// Throws std::invalid_argument if the robot does not have this size.
  explicit NaoqiCamera(NaoqiCameraSettings settings,
                       drivers::Clocks clocks = drivers::computers_clocks());
  ~NaoqiCamera() override;

  NaoqiCamera(const NaoqiCamera&) = delete;
  NaoqiCamera& operator=(const NaoqiCamera&) = delete;

  [[nodiscard]] int descriptor() const override { return wake_up_.descriptor(); }
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override;
  /// `dropped` counts images of the wrong size or format, and images whose time is unknown.
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
  std::string name_;    // of the subscriber
  std::string handle_;  // from the robot; empty while not subscribed
  QiWriter handle_argument_;
  RobotClock robot_clock_;

  bool subscribing_ = false, image_asked_ = false;
  bool subscribed_ = false;  // handle_argument_ is subscribed, even if the connection is lost
  bool ending_ = false;      // subscribe no more
  int images_ = 0;           // of this connection, up to the number that decides whose clock it is
  std::int64_t least_age_us_ = 0;  // over those images
  std::int64_t subscribe_us_ = 0;  // earliest time for the next attempt
  std::int64_t image_us_ = 0;      // when to ask for the next image
  std::int64_t new_image_us_ = 0;  // when the last new image came, or waiting began
  std::int64_t stamp_us_ = 0;
  std::optional<geometry::Frame> frame_;
  std::int64_t unusable_ = 0;
  std::string refused_;  // why the last image was refused
  drivers::HealthKind fault_ = drivers::HealthKind::ok;
  std::string fault_words_;
};

}  // namespace gazed::naoqi
