// Who gazed is to a robot's NAOqi.
#pragma once

#include <string>

namespace gazed::naoqi {

/// For a robot that asks; else empty.
struct NaoqiLogin {
  std::string user;
  std::string token;
};

}  // namespace gazed::naoqi
