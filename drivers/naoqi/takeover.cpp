#include "drivers/naoqi/takeover.hpp"

#include <algorithm>

#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

constexpr std::string_view head_chain = "Head";

bool is_stiffness(float value) {
  return value >= 0.0F && value <= 1.0F;  // false for NaN
}

}  // namespace

void HeadTakeover::begin() {
  failed_.clear();
  answers_due_ = 1;
  for (OwnMotion& motion : own_motions_) switch_off(motion);
  QiWriter joints;
  write_joints(joints);
  motion_.call(get_stiffnesses, joints.bytes(), [this](const QiResult& result) {
    on_stiffness(result);
    answered();
  });
}

void HeadTakeover::switch_off(OwnMotion& motion) {
  // NAOqi before 2.0 has neither method.
  if (!motion_.has(motion.is_on) || !motion_.has(motion.set)) return;
  ++answers_due_;
  QiWriter chain;
  chain.text(head_chain);
  motion_.call(motion.is_on, chain.bytes(), [this, &motion](const QiResult& result) {
    on_own_motion(motion, result);
    answered();
  });
}

void HeadTakeover::on_own_motion(OwnMotion& motion, const QiResult& result) {
  if (given_back_) return;
  const auto is_on = result.value.number();
  if (!is_on) {
    failed_ = trouble_of(motion.is_on, result);
  } else if (*is_on != 0.0) {
    motion.was_on = true;
    set(motion.set, false);
  }
}

void HeadTakeover::on_stiffness(const QiResult& result) {
  if (given_back_) return;
  const auto found = per_joint(result);
  if (!found) {
    failed_ = trouble_of(get_stiffnesses, result);
    return;
  }
  if (!std::ranges::all_of(*found, is_stiffness)) {
    failed_ = base::text("the robot says the head's stiffness is (%g, %g)",
                         static_cast<double>((*found)[0]), static_cast<double>((*found)[1]));
    return;
  }
  PerJoint wanted = *found;
  for (float& joint : wanted) joint = std::max(joint, stiffness_);
  if (wanted == *found) return;
  if (!found_stiffness_) found_stiffness_ = *found;
  QiWriter arguments;
  write_joints(arguments, wanted);
  expect_done(set_stiffnesses, arguments.bytes());
}

void HeadTakeover::set(MotionMethod method, bool on) {
  QiWriter arguments;
  arguments.text(head_chain).integer(on ? 1 : 0, 1);
  expect_done(method, arguments.bytes());
}

void HeadTakeover::expect_done(MotionMethod method, QiBytes arguments) {
  ++answers_due_;
  motion_.call(method, arguments, [this, method](const QiResult& result) {
    if (!result.value) failed_ = trouble_of(method, result);
    answered();
  });
}

void HeadTakeover::answered() {
  if (--answers_due_ == 0) fault_ = failed_;
}

bool HeadTakeover::has_changes() const {
  return found_stiffness_ || std::ranges::any_of(own_motions_, &OwnMotion::was_on);
}

void HeadTakeover::give_back() {
  given_back_ = true;
  for (const OwnMotion& motion : own_motions_)
    if (motion.was_on) set(motion.set, true);
  if (!found_stiffness_) return;
  QiWriter arguments;
  write_joints(arguments, *found_stiffness_);
  expect_done(set_stiffnesses, arguments.bytes());
}

}  // namespace gazed::naoqi
