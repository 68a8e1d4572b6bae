// Between the agent and a robot's head, for every driver that moves real motors: no command leaves
// the table of limits, and a head that does not do what it is told is noticed.
//
// Vocabulary. A reading is what the robot measured at one time. An order is what the driver had
// told the joints at that time: the last set point sent, anywhere on the way to a command's target.
// To back off is to stop pushing: the driver commands the joints to where they are. There is no
// socket and no clock here: times are arguments, in microseconds of any clock that never goes back.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "agent/geometry/head_motion.hpp"

namespace gazed::drivers {

/// The command that may be sent to a robot: the target is clamped to HeadLimits without a margin,
/// the speed to the joints' maximum (1). None if the target is not finite or the speed is not
/// positive.
[[nodiscard]] std::optional<geometry::HeadCommand> admit(const geometry::HeadCommand& command);
/// The message for a command that admit() refuses.
[[nodiscard]] std::string why_not_admitted(const geometry::HeadCommand& command);

/// NaN means that the robot does not report the value, which is then not judged.
struct JointReading {
  double angle_rad = 0.0;
  double stiffness = std::numeric_limits<double>::quiet_NaN();  // [0, 1]; negative also means off
  double temperature_c = std::numeric_limits<double>::quiet_NaN();
  double current_a = std::numeric_limits<double>::quiet_NaN();
  int temperature_status = 0;  // the robot's own: 0 normal, 1 hot, 2 very hot, 3 critically hot
};

struct HeadReading {
  std::int64_t time_us = 0;
  JointReading yaw, pitch;
};

struct HeadOrder {
  geometry::HeadAngles set_point;
  double stiffness =
      0.0;  // of both joints, [0, 1]; where it is low they are not expected to follow
};

class HeadGuard {
 public:
  /// Judges a reading, given the order that the joints had at that time. The angles must be finite.
  void watch(const HeadReading& reading, const HeadOrder& order);

  /// True for back_off_us after a fault, and as long as a joint is too hot, as of the last reading:
  /// no new order may be sent to the head.
  [[nodiscard]] bool backs_off() const { return backs_off_; }
  /// The fault, with numbers, until the head has done what it was told for a while (which is tried
  /// after backing off); empty if all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  static constexpr std::int64_t back_off_us = 1'000'000;
  /// A joint within this distance of its set point is following: the agent also uses it for a head
  /// that has arrived (head.settle_tolerance_rad). A NAO's head settles within 0.02 rad.
  static constexpr double follows_within_rad = 0.05;

 private:
  /// How one joint follows its set point.
  struct Following {
    double set_point_rad = 0.0;
    double rest_rad = 0.0;     // position since rest_us, apart from encoder noise
    double nearest_rad = 0.0;  // smallest distance from the current set point
    std::int64_t set_us = 0;   // time of the set point's last change
    std::int64_t rest_us = 0, near_us = 0, stiff_us = 0, powered_us = 0;

    void start(std::int64_t time_us, const JointReading& joint, double set_point);
    /// Empty if there is none.
    [[nodiscard]] std::string trouble(const char* name, std::int64_t time_us,
                                      const JointReading& joint, double set_point,
                                      double stiffness);
  };

  /// True if a joint is too hot; sets fault_ when it becomes so.
  [[nodiscard]] bool heat(const HeadReading& reading);
  void back_off(std::int64_t time_us);
  void start(const HeadReading& reading, const HeadOrder& order);
  [[nodiscard]] std::string trouble(const HeadReading& reading, const HeadOrder& order);
  void clear_when_well(const HeadReading& reading, const HeadOrder& order);

  std::array<Following, 2> following_{};  // yaw, pitch
  std::optional<std::int64_t> last_us_;
  std::int64_t back_off_until_us_ = 0;
  std::int64_t unwell_us_ = 0;  // when the head last failed to do what it was told
  bool backs_off_ = false;
  std::array<bool, 2> too_hot_{};  // yaw, pitch
  std::string fault_;
};

}  // namespace gazed::drivers
