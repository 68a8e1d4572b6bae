// The port of NAOqi.
#pragma once

#include <cstdint>

namespace gazed::naoqi {

/// The same on every robot.
inline constexpr std::uint16_t naoqi_port = 9559;

}  // namespace gazed::naoqi
