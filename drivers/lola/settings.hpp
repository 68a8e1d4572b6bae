// Settings of LoLA's driver.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::lola {

/// What to do with the joints that are not the head's; LoLA needs a value for every joint.
enum class OtherJoints : std::uint8_t {
  hold,  // keeps the position and stiffness found at the start, so a standing robot keeps standing
  release  // no stiffness
};

struct LolaSettings {
  std::string socket = "/tmp/robocup";
  OtherJoints other_joints = OtherJoints::hold;
};

}  // namespace gazed::lola
