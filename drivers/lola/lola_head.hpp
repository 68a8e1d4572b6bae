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

/// LoLA sends a state every 12 ms and takes an order after it. serve() reads every state that waits
/// and answers once, to the newest: whoever calls it late loses no state, and moves the head no
/// faster; LoLA goes on with its last order meanwhile. After about a second without a call it has
/// given us up; that shows as its silence, and it is connected to anew.
///
/// While nothing may be sent to the robot (BodyControl), or what arrives are not states, no state
/// is handed on either: the agent notices the silence, and health() has the reason.
class LolaHead : public drivers::HeadDriver {
 public:
  explicit LolaHead(const LolaSettings& settings,
                    drivers::Clocks clocks = drivers::computers_clocks());
  /// Lets the head go where hold() has not: whatever ends gazed, it is not left stiff.
  ~LolaHead() override { let_go(); }

  LolaHead(const LolaHead&) = delete;
  LolaHead& operator=(const LolaHead&) = delete;

  [[nodiscard]] int descriptor() const override { return link_.descriptor(); }
  void serve() override;
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override { return queue_.take(); }
  void command(const geometry::HeadCommand& command) override { control_.command(command); }
  /// The head stops where it is and gets back the stiffness it was found with; that takes half a
  /// second, and is given up after two, which notes() tells.
  void hold() override { let_go(); }
  /// For a head that a killed gazed has left stiff: makes it limp, the other joints are held as
  /// they are. Why not, in words; empty when it is.
  [[nodiscard]] std::string release(std::chrono::milliseconds at_most);
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override;

 private:
  /// False for one that is no state.
  [[nodiscard]] bool take(StatePacket packet, std::int64_t now_us);
  void let_go();
  void serve_until(const std::function<bool()>& done, std::int64_t at_most_us);

  drivers::Clocks clocks_;
  LolaLink link_;
  StatePacketParser parser_;
  BodyControl control_;
  HeadQueue queue_;
  LolaState newest_;
  std::int64_t served_us_ = 0;  // the last call of serve()
  std::string refusal_;         // of the newest packet
  std::int64_t refused_ = 0;
  bool letting_go_ = false;
};

}  // namespace gazed::lola
