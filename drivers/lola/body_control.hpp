// What LoLA is told, state by state: the head on its way to the agent's target, everything else as
// it was found.
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

/// Times are a monotonic clock's.
///
/// No order goes to a robot that leans by more than 45 degrees (it has fallen, or is being
/// carried), whose first states differ from each other (what they say is what the body is held to
/// until the end), or one of whose joints was moved or made soft while nobody held it; LoLA goes on
/// with its last one then. The reason is written anew for each such state, which allocates.
///
/// The head is stiffened within half a second before it moves. While its guard backs off it is told
/// to be where it is. A command whose target it has reached is done with; one that could not be
/// obeyed for 2 s in all is forgotten, as the agent has given it up by then
/// (CycleSettings::head_timeout_s).
class BodyControl {
  using HeadStiffness = std::array<double, 2>;  // HeadYaw, HeadPitch

 public:
  explicit BodyControl(OtherJoints other_joints) : other_joints_(other_joints) {}

  /// Obeyed from the next state on; a command that admit() refuses is counted and ignored.
  void command(const geometry::HeadCommand& command);
  /// States were missed or implausible: the next one is taken as the first of a connection.
  void interrupt() {
    interrupted_ = true;
    agreeing_ = 0;
  }
  /// From now on the head stays where it is, and its stiffness goes back to what it was found with.
  void let_go();
  /// As let_go(), but the head goes limp: what a killed gazed had found is not known any more.
  void release();
  [[nodiscard]] bool is_limp() const { return found_ && head_stiffness_ == HeadStiffness{}; }
  /// True once it has, or if nothing was ever sent.
  [[nodiscard]] bool has_let_go() const {
    return !found_ || (letting_go_ && head_stiffness_ == wanted_stiffness());
  }

  /// The answer to a state; none when nothing may be sent. `state` must be plausible.
  [[nodiscard]] std::optional<LolaOrder> answer(const LolaState& state, std::int64_t now_us);

  /// Why there is no answer; empty when there is one, and while the first states are compared.
  [[nodiscard]] const std::string& silence() const { return silence_; }
  /// What the guard has noticed, empty when all is well.
  [[nodiscard]] const std::string& fault() const { return guard_.fault(); }
  [[nodiscard]] std::int64_t refused_commands() const { return refused_commands_; }

  /// This many consecutive states must agree before the body is held to the last of them.
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
  LolaState first_;  // of those that agree
  int agreeing_ = 0;
  std::optional<LolaOrder> found_;               // how the body is held
  std::optional<geometry::HeadCommand> target_;  // not reached yet
  std::int64_t target_idle_us_ = 0;              // for which the target was not pursued
  HeadStiffness head_stiffness_{};
  std::int64_t last_answer_us_ = 0;
  std::optional<std::int64_t> leant_us_;  // when the torso was last not upright
  bool interrupted_ = true;               // since the last answer
  bool letting_go_ = false;
  bool releasing_ = false;
  std::string silence_;
  std::int64_t refused_commands_ = 0;
};

}  // namespace gazed::lola
