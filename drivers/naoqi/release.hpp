// For a head that a gazed which was killed has left stiff.
#pragma once

#include <chrono>
#include <string>

#include "drivers/naoqi/service.hpp"

namespace gazed::naoqi {

/// Takes the head its stiffness. Why not, in words; empty when the robot has said that it did.
[[nodiscard]] std::string release_head(const QiRobot& robot, std::chrono::milliseconds at_most);

}  // namespace gazed::naoqi
