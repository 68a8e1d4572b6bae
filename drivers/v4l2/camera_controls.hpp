// What a camera's own controls are set to.
#pragma once

#include <optional>

namespace gazed::v4l2 {

/// One that is not set stays as the camera has it.
struct CameraControls {
  std::optional<bool> auto_exposure = std::nullopt;
  std::optional<int> exposure = std::nullopt;  // in the camera's own unit
  std::optional<int> gain = std::nullopt;      // in the camera's own unit
  std::optional<bool> auto_white_balance = std::nullopt;
  std::optional<int> white_balance = std::nullopt;  // K
  std::optional<bool> auto_focus = std::nullopt;
  std::optional<int> focus = std::nullopt;  // in the camera's own unit, 0 is infinity
  std::optional<bool> flip_horizontal = std::nullopt;
  std::optional<bool> flip_vertical = std::nullopt;
};

}  // namespace gazed::v4l2
