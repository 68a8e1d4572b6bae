// Temperatures of the head's motors, from the robot's memory.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "drivers/naoqi/motion.hpp"

namespace gazed::naoqi {

/// Asks ALMemory once a second, over its own connection. If ALMemory lives in another process
/// (NAOqi 2.8) or does not exist, the head works without temperatures.
class NaoqiTemperatures {
 public:
  NaoqiTemperatures(WakeUp& wake_up, QiRobot robot);

  void serve(std::int64_t now_us);
  [[nodiscard]] std::int64_t due_us() const;
  /// Degrees Celsius, at most 10 s old; NaN if unknown.
  [[nodiscard]] const PerJoint& celsius() const { return celsius_; }
  /// Why they are unknown; empty if they are known.
  [[nodiscard]] const std::string& fault() const;

 private:
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

  QiService memory_;
  QiWriter question_;
  PerJoint celsius_{unknown, unknown};
  std::int64_t next_us_ = 0;
  std::int64_t known_us_ = 0;  // time of the request that was answered last
  std::string trouble_;
};

}  // namespace gazed::naoqi
