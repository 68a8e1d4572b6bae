// One channel of a log, message by message, through the checks that a live message goes through.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "drivers/driver.hpp"
#include "drivers/log/log_reader.hpp"

namespace gazed::log {

/// Keeps one message ahead. Intake: FrameIntake or HeadStateIntake.
template <class Intake>
class Playback {
 public:
  /// Throws std::invalid_argument when the file cannot be read, holds no message of the intake's
  /// channel (the text lists those it does hold), or none that can be used.
  Playback(const std::string& path, const std::string& channel, Intake intake)
      : reader_(path, channel), intake_(std::move(intake)) {
    advance();
    if (!finished()) return;
    if (!reader_.fault().empty()) throw std::invalid_argument(reader_.fault());
    if (intake_.refusals().count() > 0) {
      throw std::invalid_argument("nothing to play in the log " + path + ": " +
                                  intake_.refusals().text());
    }
    if (reader_.channels().empty()) throw std::invalid_argument(reader_.why_no_log());
    std::string held;
    for (const std::string& name : reader_.channels()) held += (held.empty() ? "" : ", ") + name;
    throw std::invalid_argument("the log " + path + " holds no message on " + channel +
                                "; it holds: " + held);
  }

  /// Reads on to the next message that can be used.
  void advance() {
    while (const auto message = reader_.next_message()) {
      if (intake_.take(*message)) return;
    }
  }

  /// When the message that waits is due, on a clock that goes on where the recorded one was set
  /// back; none at the end.
  [[nodiscard]] std::optional<std::int64_t> due_us() const {
    const std::optional<std::int64_t> utime_us = intake_.waiting_utime_us();
    return utime_us ? std::optional(*utime_us + intake_.set_back_us()) : std::nullopt;
  }

  [[nodiscard]] bool finished() const { return !intake_.waiting_utime_us(); }
  [[nodiscard]] Intake& intake() { return intake_; }
  [[nodiscard]] const Intake& intake() const { return intake_; }

  /// Lost when the file cannot be read to its end. A message that was passed over is no fault of a
  /// recording, but noted.
  [[nodiscard]] drivers::Health health() const {
    drivers::Health health;
    health.add(drivers::HealthKind::lost, reader_.fault());
    return health;
  }
  [[nodiscard]] std::string notes() const {
    const std::string skipped = reader_.notes();
    const std::string refused = intake_.refusals().text();
    return skipped + (skipped.empty() || refused.empty() ? "" : "; ") + refused;
  }

 private:
  LogReader reader_;
  Intake intake_;
};

}  // namespace gazed::log
