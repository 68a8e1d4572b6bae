// The head of a NAO V6, through LoLA's socket.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "drivers/clocks.hpp"
#include "drivers/head.hpp"
#include "drivers/lola/body_control.hpp"
#include "drivers/lola/head_queue.hpp"
#include "drivers/lola/lola_link.hpp"
#include "drivers/lola/settings.hpp"
#include "drivers/lola/state_packet.hpp"

namespace gazed::lola {

/// LoLA sends a state every 12 ms and then accepts an order. serve() reads every waiting state and
/// answers only the newest: a late call loses no state and does not move the head faster, and LoLA
/// continues with its last order meanwhile. Without a call for about a second LoLA drops us; this
/// shows as silence, and gazed connects again.
///
/// While nothing may be sent to the robot (BodyControl), or what arrives are not valid states, no
/// state is returned: the agent notices the silence, and health() has the reason.
class LolaHead : public drivers::HeadDriver {
 public:
  explicit LolaHead(const LolaSettings& settings,
                    drivers::Clocks clocks = drivers::computers_clocks());
  /// Releases the head if hold() has not: however gazed ends, the head is not left stiff.
  ~LolaHead() override { let_go(); }

  LolaHead(const LolaHead&) = delete;
  LolaHead& operator=(const LolaHead&) = delete;

  [[nodiscard]] int descriptor() const override { return link_.descriptor(); }
  void serve() override;
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override { return queue_.take(); }
  void command(const geometry::HeadCommand& command) override { control_.command(command); }
  /// The head stops where it is and its stiffness returns to what it was. This takes half a second;
  /// after two it is given up, as notes() reports.
  void hold() override { let_go(); }
  /// Releases a head that a killed gazed left stiff; the other joints are held. Returns why that
  /// failed; empty on success.
  [[nodiscard]] std::string release(std::chrono::milliseconds at_most);
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override;

 private:
  /// False if the packet is not a valid state.
  [[nodiscard]] bool take(StatePacket packet, std::int64_t now_us);
  void let_go();
  void serve_until(const std::function<bool()>& done, std::int64_t at_most_us);

  drivers::Clocks clocks_;
  LolaLink link_;
  StatePacketParser parser_;
  BodyControl control_;
  HeadQueue queue_;
  LolaState newest_;
  std::int64_t served_us_ = 0;  // time of the last call of serve()
  std::string refusal_;         // why the newest packet was refused
  std::int64_t refused_ = 0;
  bool letting_go_ = false;
};

}  // namespace gazed::lola
