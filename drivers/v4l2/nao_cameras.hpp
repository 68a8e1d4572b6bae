// Where a NAO's cameras are.
#pragma once

#include <string>
#include <string_view>

#include "agent/geometry/robot.hpp"

namespace gazed::v4l2 {

/// V6: the names that its udev rules give (B-Human 2024, 99-nao.rules). V3 to V5: in the order in
/// which they are connected, the top one first (B-Human 2017).
[[nodiscard]] inline std::string nao_camera_device(std::string_view robot,
                                                   geometry::CameraPosition position) {
  const bool top = position == geometry::CameraPosition::top;
  if (robot == "nao-v6") return top ? "/dev/video-top" : "/dev/video-bottom";
  return top ? "/dev/video0" : "/dev/video1";
}

}  // namespace gazed::v4l2
