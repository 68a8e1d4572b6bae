// Plays the camera and the head of a robot: for gazed --camera lcm --head lcm --robot nao-v3.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/head_command_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

#include "disc_on_wall.hpp"

void obey(const lcm::ReceiveBuffer*, const std::string&, const gazed::head_command_t* command,
          gazed::head_command_t* goal) {
  *goal = *command;
}

int main() {
  lcm::LCM link;
  gazed::head_state_t head{0, 0.0, 0.0, NAN, NAN, 0.7F, NAN};  // velocities are not measured
  gazed::head_command_t goal{};
  bot_core::image_t image{0, 640, 480, 640, 0, 640 * 480, {}, 0, {}};
  image.pixelformat = bot_core::image_t::PIXEL_FORMAT_GREY;
  image.data.resize(640 * 480);
  link.subscribeFunction("GAZED_HEAD_COMMAND", obey, &goal);
  while (link.handleTimeout(10) >= 0) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    head.utime = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    head.yaw_rad += std::clamp(goal.yaw_rad - head.yaw_rad, -0.02, 0.02);  // 2 rad/s
    head.pitch_rad += std::clamp(goal.pitch_rad - head.pitch_rad, -0.02, 0.02);
    link.publish("GAZED_HEAD_STATE", &head);
    if (head.utime < image.utime + 100'000) continue;  // ten frames a second
    image.utime = head.utime;
    paint_disc_on_wall(head.yaw_rad, head.pitch_rad, image.data);
    link.publish("GAZED_IMAGE", &image);
  }
  return 1;  // without a network
}
