// Computes the order for each state: the head moves towards the agent's target, everything else
// stays as it was found.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "agent/geometry/head_motion.hpp"
#include "drivers/head_guard.hpp"
#include "drivers/lola/body.hpp"
#include "drivers/lola/set_point.hpp"
#include "drivers/lola/settings.hpp"

namespace gazed::lola {

/// Times are those of a monotonic clock.
///
/// No order is sent, so LoLA continues with its last one, if the robot leans by more than 45
/// degrees (it has fallen or is being carried); if its first states differ from each other (the
/// body is held as they say until the end); or if a joint was moved or made soft while nobody held
/// it. The reason is written again for each such state, which allocates.
///
/// The head is stiffened within half a second before it moves. While its guard backs off, the order
/// is the head's measured position. A command is finished when its target is reached. One that
/// could not be obeyed for a total of 2 s is forgotten, because the agent has given it up by then
/// (CycleSettings::head_timeout_s).
class BodyControl {
  using HeadStiffness = std::array<double, 2>;  // HeadYaw, HeadPitch

 public:
  explicit BodyControl(OtherJoints other_joints) : other_joints_(other_joints) {}

  /// Obeyed from the next state on. A command that admit() refuses is counted and ignored.
  void command(const geometry::HeadCommand& command);
  /// States were missed or implausible: treat the next one as the first of a connection.
  void interrupt() {
    interrupted_ = true;
    agreeing_ = 0;
  }
  /// From now on the head stays where it is, and its stiffness returns to what it was.
  void let_go();
  /// Like let_go(), but the head goes limp: what a killed gazed had found is not known.
  void release();
  [[nodiscard]] bool is_limp() const { return found_ && head_stiffness_ == HeadStiffness{}; }
  /// True once it has, or if no order was ever sent.
  [[nodiscard]] bool has_let_go() const {
    return !found_ || (letting_go_ && head_stiffness_ == wanted_stiffness());
  }

  /// The order for a state, which must be plausible; none if nothing may be sent.
  [[nodiscard]] std::optional<LolaOrder> answer(const LolaState& state, std::int64_t now_us);

  /// Why there is no order; empty if there is one, and while the first states are compared.
  [[nodiscard]] const std::string& silence() const { return silence_; }
  /// The guard's fault; empty if all is well.
  [[nodiscard]] const std::string& fault() const { return guard_.fault(); }
  [[nodiscard]] std::int64_t refused_commands() const { return refused_commands_; }

  /// This many consecutive states must agree before the body is held as the last of them says.
  static constexpr int agreeing_states = 10;

 private:
  [[nodiscard]] std::string reason_for_silence(const LolaState& state, std::int64_t now_us);
  [[nodiscard]] std::string reason_not_to_begin(const LolaState& state);
  void take_over(const LolaState& state);
  void forget_old_command(std::int64_t elapsed_us);
  void watch(const LolaState& state, std::int64_t now_us);
  void move_head(geometry::HeadAngles measured, std::int64_t elapsed_us);
  void ramp_stiffness(std::int64_t elapsed_us);
  [[nodiscard]] HeadStiffness wanted_stiffness() const;
  [[nodiscard]] bool stiff() const;
  [[nodiscard]] LolaOrder order(const LolaState& state) const;

  OtherJoints other_joints_;
  drivers::HeadGuard guard_;
  SetPoint set_point_;
  LolaState first_;  // the first of those that agree
  int agreeing_ = 0;
  std::optional<LolaOrder> found_;               // how the body is held
  std::optional<geometry::HeadCommand> target_;  // not yet reached
  std::int64_t target_idle_us_ = 0;              // how long the target was not pursued
  HeadStiffness head_stiffness_{};
  std::int64_t last_answer_us_ = 0;
  std::optional<std::int64_t> leant_us_;  // when the torso was last not upright
  bool interrupted_ = true;               // since the last order
  bool letting_go_ = false;
  bool releasing_ = false;
  std::string silence_;
  std::int64_t refused_commands_ = 0;
};

}  // namespace gazed::lola
