// What the loop asks of any head.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/geometry/head_motion.hpp"

namespace gazed::drivers {

/// No call blocks, and none throws once the driver is made: what goes wrong shows in fault().
class HeadDriver {
 public:
  virtual ~HeadDriver() = default;

  /// Readable when a state may have come; -1 for a driver that knows its next_utime_us() instead.
  [[nodiscard]] virtual int descriptor() const { return -1; }
  /// For a simulated or recorded head, when its next state is due; none for a live one and after
  /// the last state.
  [[nodiscard]] virtual std::optional<std::int64_t> next_utime_us() { return std::nullopt; }
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

  /// Why no states come, in words; empty when all is well.
  [[nodiscard]] virtual std::string fault() const { return {}; }
  /// What was passed over so far (a damaged recording), in words; empty when nothing was.
  [[nodiscard]] virtual std::string notes() const { return {}; }
  /// True when no state will ever come again.
  [[nodiscard]] virtual bool finished() const { return false; }
};

}  // namespace gazed::drivers
