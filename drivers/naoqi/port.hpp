// Where NAOqi listens.
#pragma once

#include <cstdint>

namespace gazed::naoqi {

/// On every robot.
inline constexpr std::uint16_t naoqi_port = 9559;

}  // namespace gazed::naoqi
