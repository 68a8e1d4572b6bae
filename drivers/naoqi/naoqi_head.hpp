// The head of a robot that runs NAOqi: V3.3 to V5, and V6 as sold.
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
  float stiffness = 0.7F;  // minimum stiffness for moving the head; B-Human's in games
};

/// Uses ALMotion through asynchronous calls.
///
/// Angles are the sensors', requested every 10 ms or as often as the robot answers. A state's time
/// is the middle between request and answer, so its error is at most half of that interval; answers
/// that took more than 0.1 s are ignored. Velocities are left to the receiver, which has the
/// history. Stiffness is requested every 0.2 s. If somebody else reduces it while gazed runs, gazed
/// does not raise it again: it reports a fault until the stiffness is back.
///
/// A command is sent once the head is taken over, the robot answers, and HeadGuard does not back
/// off. Until then only the newest command waits, for 1.5 s at most. It is sent once, to the
/// nearest place inside both our table and the robot's own limits (getLimits).
///
/// If the robot says that it is not a NAO (getRobotConfig), this is a fault, and it is neither
/// stiffened nor moved.
///
/// When the driver ends, it undoes everything that it changed to move the head (takeover.hpp). This
/// takes as long as the robot needs to answer or to be reached again, but at most 0.3 s.
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
  /// Commands the last measured angles, at the speed of the last command; a waiting command is
  /// discarded.
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

  // For the periodic requests.
  QiWriter angles_question_, stiffness_question_;

  bool connected_ = false;
  bool is_nao_ = false;  // or does not report its model
  bool taken_over_ = false;
  bool angles_asked_ = false, stiffness_asked_ = false;
  std::int64_t angles_asked_us_ = 0, stiffness_asked_us_ = 0, next_takeover_us_ = 0;
  std::int64_t measured_us_ = 0;
  // When nothing was left to receive the last time, and how long that was before the last serve().
  std::int64_t all_heard_us_ = 0, absence_us_ = 0;
  std::optional<PerJoint> stiffness_;
  // Not returned yet; beyond 0.3 s the oldest are dropped.
  base::Ring<geometry::HeadState, 32> states_;
  std::optional<geometry::HeadState> measured_;  // the last one
  std::array<std::optional<geometry::AngleRange>, 2> own_limits_;
  int limits_due_ = 0;          // number of answers
  geometry::HeadAngles order_;  // where the joints are commanded to be
  std::optional<geometry::HeadCommand> last_command_;
  std::optional<Waiting> waiting_;
  std::string angles_fault_, command_fault_, limits_fault_, model_fault_;
  std::int64_t passed_over_ = 0, dropped_ = 0, longest_answer_us_ = 0;
};

}  // namespace gazed::naoqi
