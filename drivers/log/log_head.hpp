// The head of an LCM log: head_state_t on PREFIX_HEAD_STATE. It moves as it moved then.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/head.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/intake.hpp"
#include "drivers/log/playback.hpp"

namespace gazed::log {

/// Garbage between events, events of other channels, messages that cannot be used and times that go
/// backwards are passed over, and told in notes().
class LogHead : public drivers::HeadDriver {
 public:
  /// Throws std::invalid_argument when there is no head state to play, with the reason.
  LogHead(const std::string& path, const lcm::Channels& channels);

  [[nodiscard]] std::optional<std::int64_t> next_utime_us() override;
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override;

  [[nodiscard]] bool obeys() const override { return false; }
  void command(const geometry::HeadCommand&) override {}

  [[nodiscard]] drivers::Health health() const override { return playback_.health(); }
  [[nodiscard]] std::string notes() const override { return playback_.notes(); }
  [[nodiscard]] bool finished() const override { return playback_.finished(); }

 private:
  Playback<lcm::HeadStateIntake> playback_;
};

}  // namespace gazed::log
