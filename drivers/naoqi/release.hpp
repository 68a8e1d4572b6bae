// Releases a head that a killed gazed left stiff.
#pragma once

#include <chrono>
#include <string>

#include "drivers/naoqi/service.hpp"

namespace gazed::naoqi {

/// Sets the head's stiffness to 0. Returns why that failed; empty if the robot has confirmed it.
[[nodiscard]] std::string release_head(const QiRobot& robot, std::chrono::milliseconds at_most);

}  // namespace gazed::naoqi
