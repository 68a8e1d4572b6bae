// What cannot be: settings out of range, frames of a size that the stage does not take.
#pragma once

#include <string>

#include "agent/saliency/settings.hpp"

namespace gazed::saliency {

/// Throws std::invalid_argument with the key, the value found and the values allowed.
void require_settings(const SaliencySettings& settings);

[[nodiscard]] bool size_is_taken(int width_px, int height_px);
/// The smallest and the largest, "160x120 to 2560x1920".
[[nodiscard]] std::string sizes_taken();

/// Throws std::invalid_argument unless frames of this size are taken.
void require_size(int width_px, int height_px);

}  // namespace gazed::saliency
