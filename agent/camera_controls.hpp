// What a camera's own controls are set to.
#pragma once

#include <optional>

namespace gazed {

/// One that is not set stays as the camera has it.
struct CameraControls {
  std::optional<bool> auto_exposure;
  std::optional<int> exposure;  // in the camera's own unit
  std::optional<int> gain;      // in the camera's own unit
  std::optional<bool> auto_white_balance;
  std::optional<int> white_balance;  // K
  std::optional<bool> auto_focus;
  std::optional<int> focus;  // in the camera's own unit, 0 is infinity
  std::optional<bool> flip_horizontal;
  std::optional<bool> flip_vertical;
};

}  // namespace gazed
