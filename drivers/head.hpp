// The interface of all heads.
#pragma once

#include <optional>

#include "agent/geometry/head_motion.hpp"
#include "drivers/driver.hpp"

namespace gazed::drivers {

class HeadDriver : public Driver {
 public:
  /// Does everything that is due, such as answering a robot that waits. Call it as often as
  /// possible, also during long computations; it does not need next_state() or command().
  virtual void serve() {}
  /// States not returned yet, oldest first, one per call.
  [[nodiscard]] virtual std::optional<geometry::HeadState> next_state() = 0;

  /// False for a recorded head, which moves by itself: commands are only listed.
  [[nodiscard]] virtual bool obeys() const { return true; }
  virtual void command(const geometry::HeadCommand& command) = 0;
  /// Called once at the end: the head stops where it is.
  virtual void hold() {}
};

}  // namespace gazed::drivers
