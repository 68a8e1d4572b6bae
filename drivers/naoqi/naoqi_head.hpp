// The head of a robot that runs NAOqi: V3.3 to V5, and a V6 as it is sold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "agent/base/ring.hpp"
#include "agent/geometry/limits.hpp"
#include "drivers/clocks.hpp"
#include "drivers/head.hpp"
#include "drivers/head_guard.hpp"
#include "drivers/naoqi/takeover.hpp"
#include "drivers/naoqi/temperatures.hpp"

namespace gazed::naoqi {

struct NaoqiHeadSettings {
  QiRobot robot;
  float stiffness = 0.7F;  // the least it is moved with; B-Human's in games
};

/// Through ALMotion, by calls that are sent and answered while the loop goes on.
///
/// Angles are the sensors', asked for every 10 ms, or as often as the robot answers. A state's time
/// is the middle between question and answer, right within half of that; what took over 0.1 s to
/// come is passed over. Velocities are left to whoever has the history. Stiffness is asked for
/// every 0.2 s. One that somebody takes away while gazed runs is not given back by force: it is a
/// fault until somebody gives it back.
///
/// A command is sent when the head is taken over, the robot answers, and HeadGuard does not back
/// off. Until then it waits, for 1.5 s at most, and only the newest one; it is sent once. It goes
/// to the nearest place inside both our table and the robot's own limits (getLimits), whichever is
/// narrower.
///
/// A robot that says that it is none of the NAOs (getRobotConfig) is a fault, and neither stiffened
/// nor moved.
///
/// What was changed to move the head (takeover.hpp) is changed back when the driver ends, which
/// takes as long as the robot needs to answer, or to be reached again, but 0.3 s at most.
class NaoqiHead : public drivers::HeadDriver {
 public:
  explicit NaoqiHead(NaoqiHeadSettings settings,
                     drivers::Clocks clocks = drivers::computers_clocks());
  ~NaoqiHead() override;

  NaoqiHead(const NaoqiHead&) = delete;
  NaoqiHead& operator=(const NaoqiHead&) = delete;

  [[nodiscard]] int descriptor() const override { return wake_up_.descriptor(); }
  void serve() override;
  [[nodiscard]] std::optional<geometry::HeadState> next_state() override;
  void command(const geometry::HeadCommand& command) override;
  /// Commands the angles that were measured last, at the speed of the last command; one that waits
  /// is not sent any more.
  void hold() override;
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override;

 private:
  struct Waiting {
    geometry::HeadCommand command;
    std::int64_t since_us = 0;
  };

  void begin_connection();
  void ask_model();
  void take_over();
  void ask_limits();
  void ask_angles();
  void ask_stiffness();
  void on_angles(const QiResult& result);
  [[nodiscard]] std::string trouble_of_angles(const QiResult& result, std::int64_t took_us) const;
  void watch(const geometry::HeadState& state, std::int64_t now_us);
  [[nodiscard]] bool may_send() const;
  void send_waiting();
  void send(const geometry::HeadCommand& command);
  void stop();
  [[nodiscard]] geometry::HeadCommand within_own_limits(geometry::HeadCommand command);

  NaoqiHeadSettings settings_;
  drivers::Clocks clocks_;
  WakeUp wake_up_;
  QiService motion_;
  NaoqiTemperatures temperatures_;
  HeadTakeover takeover_;
  drivers::HeadGuard guard_;

  // What is asked for again and again.
  QiWriter angles_question_, stiffness_question_;

  bool connected_ = false;
  bool is_nao_ = false;  // or does not say what it is
  bool taken_over_ = false;
  bool angles_asked_ = false, stiffness_asked_ = false;
  std::int64_t angles_asked_us_ = 0, stiffness_asked_us_ = 0, next_takeover_us_ = 0;
  std::int64_t measured_us_ = 0;
  // When the last time nothing had come, and how long before the last serve() that was.
  std::int64_t all_heard_us_ = 0, absence_us_ = 0;
  std::optional<PerJoint> stiffness_;
  // Not yet handed on; of more than 0.3 s the oldest are dropped.
  base::Ring<geometry::HeadState, 32> states_;
  std::optional<geometry::HeadState> measured_;  // the last one
  std::array<std::optional<geometry::AngleRange>, 2> own_limits_;
  int limits_due_ = 0;          // answers
  geometry::HeadAngles order_;  // where the joints are told to be
  std::optional<geometry::HeadCommand> last_command_;
  std::optional<Waiting> waiting_;
  std::string angles_fault_, command_fault_, limits_fault_, model_fault_;
  std::int64_t passed_over_ = 0, dropped_ = 0, longest_answer_us_ = 0;
};

}  // namespace gazed::naoqi
