// The channels of one gazed: a prefix that the configuration gives, and a fixed ending; those of a
// camera and a head that other programs drive may have any name.
#pragma once

#include <string>

#include "drivers/lcm/settings.hpp"

namespace gazed::lcm {

struct Channels {
  /// Throws std::invalid_argument unless the prefix is 1 to 40 letters, digits and underscores
  /// (LCM reads a channel that is subscribed to as a regular expression, and ends one at 63 bytes).
  explicit Channels(const std::string& prefix);
  /// With the names that are set beside the prefix, which may have -, . and / as well.
  explicit Channels(const LcmSettings& settings);

  std::string image;          // bot_core.image_t
  std::string head_state;     // gazed.head_state_t
  std::string head_command;   // gazed.head_command_t
  std::string located_point;  // gazed.located_point_t
  std::string fixation;       // gazed.fixation_t
  std::string saliency;       // gazed.saliency_map_t
  std::string status;         // gazed.status_t
  std::string configuration;  // TOML; in recordings only
};

}  // namespace gazed::lcm
