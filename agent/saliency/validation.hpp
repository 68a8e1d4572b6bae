// What cannot be: settings out of range, frames of a size that the stage does not take.
#pragma once

#include <cstddef>
#include <string>

#include "agent/base/image.hpp"
#include "agent/saliency/saliency.hpp"
#include "agent/saliency/settings.hpp"

namespace gazed::saliency {

/// Throws std::invalid_argument with the key, the value found and the values allowed.
void require_settings(const SaliencySettings& settings);

[[nodiscard]] bool size_is_taken(int width_px, int height_px);
/// The smallest and the largest, "160x120 to 2560x1920".
[[nodiscard]] std::string sizes_taken();

/// Throws std::invalid_argument unless frames of this size are taken.
void require_size(int width_px, int height_px);
/// Likewise for a frame of this size that can be read, and for factors of so many samples.
void require_frame(const base::ImageView& frame, int width_px, int height_px);
void require_context(const FrameContext& context, std::size_t map_samples);

}  // namespace gazed::saliency
