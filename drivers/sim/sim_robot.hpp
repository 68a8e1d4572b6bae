// The simulated robot: its room, its joints, its camera and its clock.
//
// The clock is virtual: it stands at the time of the last event served, and the caller serves the
// events, head states every 12 ms (LoLA's cycle) and frames, in the order of their times. The
// camera and head drivers below share one robot. Ground truth is for tests only, through the robot
// itself, never through the drivers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/base/random.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "drivers/sim/joints.hpp"
#include "drivers/sim/render.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sensor.hpp"
#include "drivers/sim/torso_sway.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::sim {

/// Ground truth, which no agent may see. Angles are such that cam_from_torso(head, angles) is the
/// true pose, in the torso's frame: that which sways, where a scene lets it.
struct SimTruth {
  std::size_t test = 0;  // counted from 0
  geometry::CameraModel camera;
  geometry::HeadGeometry head;
  geometry::HeadAngles angles;                     // now
  std::optional<Eigen::Vector3d> target_in_torso;  // now
};

class SimRobot {
 public:
  static constexpr std::int64_t state_period_us = 12'000;
  static constexpr std::int64_t pause_us = 500'000;  // between two tests

  /// The same scene, profile, seed and calls give the same bytes. Throws std::invalid_argument for
  /// a scene that cannot be built.
  SimRobot(Scene scene, const geometry::RobotProfile& profile, std::uint64_t seed,
           std::int64_t start_utime_us);

  /// To be called after each published fixation: the next test's scene, the head at (0, 0), 0.5 s
  /// later. With another head (observe) the head stays where it is, and time goes on.
  void next_test();
  /// True after the last test of a scene that does not repeat.
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

  /// When the next frame has been read out.
  [[nodiscard]] std::optional<std::int64_t> next_frame_utime_us();
  /// Frames one by one; with another head those that are long past are dropped. What is not wanted
  /// is not drawn and shows an earlier picture; the others are the same bytes either way.
  [[nodiscard]] std::optional<geometry::Frame> next_frame(const drivers::FrameFilter& wanted =
                                                              [](std::int64_t) { return true; });
  [[nodiscard]] std::int32_t frames_dropped() const { return frames_dropped_; }

  [[nodiscard]] std::optional<std::int64_t> next_state_utime_us() const;
  [[nodiscard]] std::optional<geometry::HeadState> next_state();
  void command(const geometry::HeadCommand& command) { joints_.command(command); }
  void hold() { joints_.hold(); }

  /// The true angles are those that another head driver reports. From then on next_state() is not
  /// to be called.
  void observe(const geometry::HeadState& state);

  // The truth, for tests.
  [[nodiscard]] SimTruth truth() const;
  /// When a row of one of the last 1024 frames was exposed, the frame by its utime. Rows may be
  /// fractions.
  [[nodiscard]] std::optional<geometry::HeadAngles> true_angles(std::int64_t frame_utime_us,
                                                                double row = 0.0) const;
  /// What the true ray through a pixel of such a frame of the current test met when the pixel's row
  /// was exposed.
  [[nodiscard]] std::optional<Hit> true_hit_in_frame(std::int64_t frame_utime_us,
                                                     const geometry::Pixel& pixel) const;
  /// What the true ray through a pixel meets in a test's room (the current one's by default, as it
  /// is now; another one's as it is when the test starts).
  [[nodiscard]] std::optional<Hit> true_hit(geometry::HeadAngles true_angles,
                                            const geometry::Pixel& pixel) const;
  [[nodiscard]] std::optional<Hit> true_hit(geometry::HeadAngles true_angles,
                                            const geometry::Pixel& pixel, std::size_t test) const;
  /// Of that, the distance from the camera's centre.
  [[nodiscard]] std::optional<double> true_range_m(geometry::HeadAngles true_angles,
                                                   const geometry::Pixel& pixel) const;

 private:
  struct Exposure {
    std::int64_t utime_us = 0;  // its time stamp
    std::int64_t start_us = 0;
    std::size_t test = 0;
    double test_time_s = 0.0;  // at the start
  };
  static constexpr std::size_t exposures_kept = 1024;
  /// All that the light on the sensor depends on while nothing moves.
  struct Sight {
    geometry::HeadAngles angles;
    std::size_t test = 0;
    double exposure = 1.0;
    friend bool operator==(const Sight&, const Sight&) = default;
  };

  [[nodiscard]] std::int64_t exposure_start_us() const;
  [[nodiscard]] std::int64_t delivery_us() const;
  void skip_lost_frames();
  /// Time goes on to the next frame; false when none comes.
  bool wait_for_frame();
  void skip_old_frames();
  [[nodiscard]] double test_time_s(std::int64_t utime_us) const;
  /// After the start of exposure.
  [[nodiscard]] double row_time_s(double row) const;
  void remember_exposure(std::int64_t start_us);
  /// The frame's place among those kept.
  [[nodiscard]] std::optional<std::size_t> exposure(std::int64_t frame_utime_us) const;
  [[nodiscard]] geometry::HeadAngles angles_after(std::size_t exposure, double time_s) const;
  /// Where the camera is in the room when the joints stand there.
  [[nodiscard]] geometry::Pose cam_from_room(geometry::HeadAngles angles,
                                             std::int64_t utime_us) const;
  [[nodiscard]] double exposure_factor(std::int64_t start_us);
  [[nodiscard]] base::ImageView picture(std::int64_t start_us, double exposure);
  void render(std::int64_t start_us, bool moving);

  Scene scene_;
  TrueRobot robot_;
  World world_;
  SimJoints joints_;
  TorsoSway sway_;
  Renderer renderer_;
  Sensor sensor_;
  base::Random losses_, exposure_steps_;
  std::vector<Light> row_;
  geometry::HeadAngles exposed_at_;  // where the exposure last changed
  double exposure_step_ = 0.0;
  std::optional<Sight> rendered_;  // what the sensor saw last; none when it saw it move
  std::size_t test_ = 0;
  bool finished_ = false;
  std::int64_t start_us_;
  std::int64_t now_us_;
  std::int64_t test_start_us_;
  std::int64_t frames_since_us_;  // frame 0 of the current test
  std::int64_t frame_ = 0;        // the next one
  bool frame_decided_ = false;    // not lost
  std::int64_t next_state_us_;
  std::int32_t frames_dropped_ = 0;
  std::optional<std::int64_t> observed_us_;  // set when another head is used
  std::array<Exposure, exposures_kept> exposures_{};
  std::size_t exposure_count_ = 0;
  // Of each of these the angles from the exposure of the first row to that of the last, one a
  // millisecond.
  std::vector<geometry::HeadAngles> trails_;
  std::size_t trail_length_ = 1;
};

class SimCamera : public drivers::CameraDriver {
 public:
  /// Says the warning once, unless it is empty.
  explicit SimCamera(std::shared_ptr<SimRobot> robot, std::string warning = {})
      : robot_(std::move(robot)), warning_(std::move(warning)) {}
  [[nodiscard]] std::optional<std::int64_t> next_utime_us() override {
    return robot_->next_frame_utime_us();
  }
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override {
    return robot_->next_frame();
  }
  [[nodiscard]] std::optional<geometry::Frame> next_frame_if(
      const drivers::FrameFilter& wanted) override {
    return robot_->next_frame(wanted);
  }
  [[nodiscard]] drivers::Health health() const override {
    return {.dropped = robot_->frames_dropped()};
  }
  [[nodiscard]] std::string warning() override { return std::exchange(warning_, {}); }
  [[nodiscard]] bool finished() const override { return robot_->finished(); }

 private:
  std::shared_ptr<SimRobot> robot_;
  std::string warning_;
};

class SimHead : public drivers::HeadDriver {
 public:
  explicit SimHead(std::shared_ptr<SimRobot> robot) : robot_(std::move(robot)) {}
  [[nodiscard]] std::optional<std::int64_t> next_utime_us() override {
    return robot_->next_state_utime_us();
  }
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override {
    return robot_->next_state();
  }
  void command(const geometry::HeadCommand& command) override { robot_->command(command); }
  void hold() override { robot_->hold(); }
  [[nodiscard]] bool finished() const override { return robot_->finished(); }

 private:
  std::shared_ptr<SimRobot> robot_;
};

}  // namespace gazed::sim
