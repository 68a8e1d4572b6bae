// The head is taken over from the robot's own motions, and given back as it was found.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drivers/naoqi/motion.hpp"

namespace gazed::naoqi {

/// Breathing and the idle posture of the head are switched off where they are on, and a stiffness
/// that is too low is raised; nothing else of the robot is touched.
class HeadTakeover {
 public:
  /// `motion` must outlive it. `stiffness`, (0, 1], is the least that the head needs.
  HeadTakeover(QiService& motion, float stiffness) : motion_(motion), stiffness_(stiffness) {}

  /// To be called whenever `motion` is ready anew, and to try again.
  void begin();
  /// The head may be moved.
  [[nodiscard]] bool done() const { return answers_due_ == 0 && fault_.empty(); }
  [[nodiscard]] bool under_way() const { return answers_due_ > 0; }
  /// What the head's joints were told.
  [[nodiscard]] float stiffness() const { return stiffness_; }

  /// There is something to give back.
  [[nodiscard]] bool has_changes() const;
  /// Sends what makes the head as it was before begin() changed it; from then on nothing is changed
  /// any more.
  void give_back();

  /// Why the head could not be taken over the last time; empty when it could.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  /// A motion of the robot's own.
  struct OwnMotion {
    MotionMethod is_on, set;
    bool was_on = false;
  };

  void switch_off(OwnMotion& motion);
  void on_own_motion(OwnMotion& motion, const QiResult& result);
  void on_stiffness(const QiResult& result);
  void set(MotionMethod method, bool on);
  void answered();
  void expect_done(MotionMethod method, QiBytes arguments);

  QiService& motion_;
  float stiffness_;
  std::array<OwnMotion, 2> own_motions_{
      {{get_breathing, set_breathing}, {get_idle_posture, set_idle_posture}}};
  std::optional<PerJoint> found_stiffness_;  // before it was raised
  int answers_due_ = 0;
  bool given_back_ = false;
  std::string failed_;  // what has, of what is under way
  std::string fault_;
};

}  // namespace gazed::naoqi
