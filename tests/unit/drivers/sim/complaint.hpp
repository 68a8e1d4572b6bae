// What the scene reader says.
#pragma once

#include <stdexcept>
#include <string>

#include "drivers/sim/scene.hpp"

namespace gazed::sim {

/// What parsing says against a text; "nothing" of a scene.
inline std::string complaint(const std::string& text) {
  try {
    (void)parse_scene(text, "room.toml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace gazed::sim
