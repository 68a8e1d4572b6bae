// Login for a robot's NAOqi.
#pragma once

#include <string>

namespace gazed::naoqi {

/// Only needed if the robot requires authentication; otherwise empty.
struct NaoqiLogin {
  std::string user;
  std::string token;
};

}  // namespace gazed::naoqi
