// Saliency of frames as they come, for a person who watches.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "agent/lab/live/sources.hpp"
#include "agent/saliency/settings.hpp"

namespace gazed::lab::live {

struct WatchOptions {
  saliency::SaliencySettings settings{};
  std::string csv;                     // a row for each frame; "-": standard output
  std::filesystem::path overlays;      // a PNG for each frame
  std::optional<std::int64_t> frames;  // the most
};

/// Shows each frame with its overlay and the frame rate in a window, until the frames end, q or Esc
/// is pressed or the window closed; with csv or overlays there is no window. At the end a line on
/// standard error says how many frames came, and how fast. Throws
/// std::invalid_argument where a window is wanted and there is no display, std::runtime_error where
/// frames fail to come.
void watch(Frames& frames, const WatchOptions& options);

}  // namespace gazed::lab::live
