// What the loop asks of any head.
#pragma once

#include <optional>

#include "agent/geometry/head_motion.hpp"
#include "drivers/driver.hpp"

namespace gazed::drivers {

class HeadDriver : public Driver {
 public:
  /// Does everything that is due, such as answering a robot that waits; to be called as often as
  /// possible, also in the midst of a long computation: next_state() and command() are not needed
  /// for it.
  virtual void serve() {}
  /// The states not yet returned, oldest first, one a call.
  [[nodiscard]] virtual std::optional<geometry::HeadState> next_state() = 0;

  /// False for a recorded head: it moves by itself, commands are only listed.
  [[nodiscard]] virtual bool obeys() const { return true; }
  virtual void command(const geometry::HeadCommand& command) = 0;
  /// Called once at the end: the head stops where it is.
  virtual void hold() {}
};

}  // namespace gazed::drivers
