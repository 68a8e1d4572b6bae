// Copies the agent's vectors and angles to the arrays of messages.
#pragma once

#include <algorithm>

#include "agent/geometry/head.hpp"

namespace gazed::daemon {

template <typename Matrix>
void copy(const Matrix& from, double* to) {
  std::copy_n(from.data(), from.size(), to);
}

inline void copy(geometry::HeadAngles from, double* to) {
  to[0] = from.yaw_rad;
  to[1] = from.pitch_rad;
}

}  // namespace gazed::daemon
