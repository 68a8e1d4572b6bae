// A head that another program drives, through LCM: head_state_t on PREFIX_HEAD_STATE comes in,
// head_command_t on PREFIX_HEAD_COMMAND goes out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/clocks.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/intake.hpp"
#include "drivers/lcm/link.hpp"
#include "msgs/gazed/head_command_t.hpp"

namespace gazed::lcm {

/// A state whose angles are NaN or beyond +-pi, or that goes back in time, is refused, counted, and
/// told in health() until a good one comes.
class LcmHead : public drivers::HeadDriver {
 public:
  /// `link` must outlive the head.
  LcmHead(LcmLink& link, const Channels& channels);

  LcmHead(const LcmHead&) = delete;
  LcmHead& operator=(const LcmHead&) = delete;

  [[nodiscard]] int descriptor() const override { return link_.descriptor(); }
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override;
  /// Sends what admit() makes of it: nothing leaves the table of limits, whoever drives the head.
  void command(const geometry::HeadCommand& command) override;
  /// Commands the angles that were measured last, at the speed of the last command; of angles
  /// outside the limits the nearest allowed ones.
  void hold() override;
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override { return intake_.refusals().text(); }
  [[nodiscard]] std::string warning() override { return intake_.warning(); }

  /// Messages refused so far.
  [[nodiscard]] std::int64_t refused() const { return intake_.refusals().count(); }

 private:
  LcmLink& link_;
  drivers::Clocks clocks_ = drivers::computers_clocks();
  std::string command_channel_;
  HeadStateIntake intake_;
  std::optional<geometry::HeadCommand> last_command_;
  bool last_command_failed_ = false;
  std::string command_fault_;  // of the last command, when it was none
  head_command_t message_{};   // reused
};

}  // namespace gazed::lcm
