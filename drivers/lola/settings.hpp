// What the driver of LoLA's socket is told.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::lola {

/// What a driver that must tell all joints something tells those that are not the head's.
enum class OtherJoints : std::uint8_t {
  hold,  // the position and stiffness they were found with, to the end: who stands goes on standing
  release  // no stiffness
};

struct LolaSettings {
  std::string socket = "/tmp/robocup";
  OtherJoints other_joints = OtherJoints::hold;
};

}  // namespace gazed::lola
