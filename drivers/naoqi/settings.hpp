// Where a robot's NAOqi is, and who gazed is to it.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::naoqi {

/// Where NAOqi listens, on every robot.
inline constexpr std::uint16_t naoqi_port = 9559;

/// For a robot that asks; else empty.
struct NaoqiLogin {
  std::string user;
  std::string token;
};

}  // namespace gazed::naoqi
