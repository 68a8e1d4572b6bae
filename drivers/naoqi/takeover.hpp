// Takes the head over from the robot's own motions, and gives it back as it was.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drivers/naoqi/motion.hpp"

namespace gazed::naoqi {

/// Switches off the head's breathing and idle posture if they are on, and raises its stiffness if
/// that is too low; nothing else on the robot is changed.
class HeadTakeover {
 public:
  /// `motion` must outlive this object. `stiffness`, (0, 1], is the minimum that the head needs.
  HeadTakeover(QiService& motion, float stiffness) : motion_(motion), stiffness_(stiffness) {}

  /// Call whenever `motion` has become ready, and to try again.
  void begin();
  /// True if the head may be moved.
  [[nodiscard]] bool done() const { return answers_due_ == 0 && fault_.empty(); }
  [[nodiscard]] bool under_way() const { return answers_due_ > 0; }
  /// The stiffness that was set on the head's joints.
  [[nodiscard]] float stiffness() const { return stiffness_; }

  /// True if there is something to give back.
  [[nodiscard]] bool has_changes() const;
  /// Restores what begin() changed; nothing is changed any more after that.
  void give_back();

  /// Why the last attempt failed; empty if it succeeded.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  /// One of the robot's own motions.
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
  std::string failed_;  // what has failed in the attempt under way
  std::string fault_;
};

}  // namespace gazed::naoqi
