// How warm the head's motors are, out of the robot's memory.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "drivers/naoqi/motion.hpp"

namespace gazed::naoqi {

/// Asks ALMemory once a second, on a connection of its own: where it lives in another process
/// (NAOqi 2.8) or is not there at all, the head does without.
class NaoqiTemperatures {
 public:
  NaoqiTemperatures(WakeUp& wake_up, QiRobot robot);

  void serve(std::int64_t now_us);
  [[nodiscard]] std::int64_t due_us() const;
  /// Celsius, of the last 10 s; NaN where it is not known.
  [[nodiscard]] const PerJoint& celsius() const { return celsius_; }
  /// Why it is not known; empty when it is.
  [[nodiscard]] const std::string& fault() const;

 private:
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

  QiService memory_;
  QiWriter question_;
  PerJoint celsius_{unknown, unknown};
  std::int64_t next_us_ = 0;
  std::int64_t known_us_ = 0;  // the last answer was asked for then
  std::string trouble_;
};

}  // namespace gazed::naoqi
