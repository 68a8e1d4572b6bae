// The joints of a robot that are not the head's.
#pragma once

#include <cstdint>

namespace gazed::lola {

/// What a driver that must tell all joints something tells these.
enum class OtherJoints : std::uint8_t {
  hold,  // the position and stiffness they were found with, to the end: who stands goes on standing
  release  // no stiffness
};

}  // namespace gazed::lola
