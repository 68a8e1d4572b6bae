// What LoLA is told, state by state: the head on its way to the agent's target, everything else as
// it was found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/head_motion.hpp"
#include "agent/other_joints.hpp"
#include "drivers/head_guard.hpp"
#include "drivers/lola/body.hpp"
#include "drivers/lola/set_point.hpp"

namespace gazed {

/// Times are a monotonic clock's.
///
/// No order goes to a robot that leans by more than 45 degrees (it has fallen, or is being
/// carried), whose first state is no robot's, or one of whose joints was moved far from where it is
/// to be held while nobody held it; LoLA goes on with its last one then.
///
/// The head is stiffened within half a second before it moves. While its guard backs off it is told
/// to be where it is. A command whose target it has reached is done with; one that was not obeyed
/// for 2 s because no order could go out is forgotten, as the agent has given it up by then
/// (CycleSettings::head_timeout_s).
class BodyControl {
 public:
  explicit BodyControl(OtherJoints other_joints) : other_joints_(other_joints) {}

  /// Obeyed from the next state on; what is no command (admit()) is refused and counted.
  void command(const HeadCommand& command);
  /// The next state is the first of a new connection.
  void restart() { interrupted_ = true; }
  /// From now on the head stays where it is, and its stiffness goes back to what it was found with.
  void let_go();
  /// True once it has.
  [[nodiscard]] bool has_let_go() const {
    return letting_go_ && head_stiffness_ == found_stiffness_;
  }

  /// The answer to a state; none when nothing may be sent. `state` must be plausible.
  [[nodiscard]] std::optional<LolaOrder> answer(const LolaState& state, std::int64_t now_us);

  /// Why there is no answer, empty when there is one.
  [[nodiscard]] const std::string& silence() const { return silence_; }
  /// What the guard has noticed, empty when all is well.
  [[nodiscard]] const std::string& fault() const { return guard_.fault(); }
  [[nodiscard]] std::int64_t refused_commands() const { return refused_commands_; }

 private:
  [[nodiscard]] std::string reason_for_silence(const LolaState& state, std::int64_t now_us);
  void take_over(const LolaState& state, std::int64_t now_us);
  void move_head(HeadAngles measured, std::int64_t elapsed_us);
  void ramp_stiffness(std::int64_t elapsed_us);
  [[nodiscard]] LolaOrder order(const LolaState& state) const;

  OtherJoints other_joints_;
  HeadGuard guard_;
  SetPoint set_point_;
  std::optional<LolaOrder> found_;     // the first state
  std::optional<HeadCommand> target_;  // not reached yet
  double found_stiffness_ = 0.0;       // of the head
  double head_stiffness_ = 0.0;
  std::int64_t last_answer_us_ = 0;
  std::optional<std::int64_t> leant_us_;  // when the torso was last not upright
  bool interrupted_ = true;               // since the last answer
  bool letting_go_ = false;
  std::string silence_;
  std::int64_t refused_commands_ = 0;
};

}  // namespace gazed
