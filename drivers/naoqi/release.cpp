#include "drivers/naoqi/release.hpp"

#include "drivers/clocks.hpp"
#include "drivers/naoqi/motion.hpp"
#include "drivers/naoqi/wake_up.hpp"

namespace gazed::naoqi {

std::string release_head(const QiRobot& robot, std::chrono::milliseconds at_most) {
  const drivers::Clocks clocks = drivers::computers_clocks();
  WakeUp wake_up;
  QiService motion(wake_up, robot, "ALMotion", motion_methods);
  std::string trouble = "NAOqi has not answered";
  bool asked = false, answered = false;
  const auto on_answer = [&](const QiResult& result) {
    trouble = result.error.empty() ? std::string() : trouble_of(set_stiffnesses, result);
    answered = true;
  };
  await_answers(wake_up, at_most, [&] {
    motion.serve(clocks.monotonic_us());
    if (motion.ready() && !asked) {
      asked = true;
      QiWriter arguments;
      write_joints(arguments, PerJoint{0.0F, 0.0F});
      motion.call(set_stiffnesses, arguments.bytes(), on_answer);
    }
    wake_up.at(motion.due_us());
    return answered;
  });
  return answered || motion.fault().empty() ? trouble : motion.fault();
}

}  // namespace gazed::naoqi
