// Between the agent and a robot's head, for every driver that moves real motors: no command leaves
// the table of limits, and a head that does not do what it is told is noticed.
//
// Vocabulary. A reading is what the robot measured at one time. An order is what the driver has
// told the joints at that time: the last set point on the wire, which on its way to a command's
// target may be any place before it. To back off is to push nothing: the driver tells the joints
// where they are. No socket and no clock here: times are handed in, microseconds of any clock that
// only goes forward.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "agent/geometry/head_motion.hpp"

namespace gazed::drivers {

/// What may go to a robot: the target clamped into HeadLimits without a margin, the speed to the
/// joints' greatest (1). None for a target that is not finite, and for a speed that is not above 0.
[[nodiscard]] std::optional<geometry::HeadCommand> admit(const geometry::HeadCommand& command);
/// What a driver says of a command that admit() refuses.
[[nodiscard]] std::string why_not_admitted(const geometry::HeadCommand& command);

/// NaN: the robot does not report it, and it is not judged.
struct JointReading {
  double angle_rad = 0.0;
  double stiffness = std::numeric_limits<double>::quiet_NaN();  // [0, 1]; below 0 is off as well
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
  /// Every reading, with the order that the joints had then. The angles must be finite.
  void watch(const HeadReading& reading, const HeadOrder& order);

  /// True for back_off_us after something was noticed, and as long as a joint is too hot: nothing
  /// new may be told to the head. As of the last reading.
  [[nodiscard]] bool backs_off() const { return backs_off_; }
  /// What was noticed, in words with numbers, until the head has done what it was told for a while
  /// (which is tried after backing off); empty when all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  static constexpr std::int64_t back_off_us = 1'000'000;
  /// A joint at most this far from its set point does what it is told: the agent's own measure of a
  /// head that has arrived (head.settle_tolerance_rad). A NAO's head settles within 0.02 rad.
  static constexpr double follows_within_rad = 0.05;

 private:
  /// How one joint follows its set point.
  struct Following {
    double set_point_rad = 0.0;
    double rest_rad = 0.0;     // where it has been since rest_us, but for its encoder's noise
    double nearest_rad = 0.0;  // the least it was off a set point that stays
    std::int64_t set_us = 0;   // the set point's last change
    std::int64_t rest_us = 0, near_us = 0, stiff_us = 0, powered_us = 0;

    void start(std::int64_t time_us, const JointReading& joint, double set_point);
    /// Empty when there is none.
    [[nodiscard]] std::string trouble(const char* name, std::int64_t time_us,
                                      const JointReading& joint, double set_point,
                                      double stiffness);
  };

  /// A joint is too hot; says so in fault_ when it becomes so.
  [[nodiscard]] bool heat(const HeadReading& reading);
  void back_off(std::int64_t time_us);
  void start(const HeadReading& reading, const HeadOrder& order);
  [[nodiscard]] std::string trouble(const HeadReading& reading, const HeadOrder& order);
  void clear_when_well(const HeadReading& reading, const HeadOrder& order);

  std::array<Following, 2> following_{};  // yaw, pitch
  std::optional<std::int64_t> last_us_;
  std::int64_t back_off_until_us_ = 0;
  std::int64_t unwell_us_ = 0;  // when the head last did not do what it was told
  bool backs_off_ = false;
  std::array<bool, 2> too_hot_{};  // yaw, pitch
  std::string fault_;
};

}  // namespace gazed::drivers
