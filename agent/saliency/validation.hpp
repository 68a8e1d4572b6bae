// Checks of settings and frame sizes.
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
/// The smallest and largest size, "160x120 to 2560x1920".
[[nodiscard]] std::string sizes_taken();

/// Throws std::invalid_argument if frames of this size are not supported.
void require_size(int width_px, int height_px);
/// The same for a frame, which must be readable, and for the number of factors.
void require_frame(const base::ImageView& frame, int width_px, int height_px);
void require_context(const FrameContext& context, std::size_t map_samples);

}  // namespace gazed::saliency
