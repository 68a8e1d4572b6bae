// The most salient place of a frame: fixed-point colour-opponent pyramid, centre-surround, N,
// winner (agent/saliency/README.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/saliency/settings.hpp"

namespace gazed::saliency {

/// A sample of the map, at level 4 of the pyramid, is centred on pixel 16 (column, row).
inline constexpr int saliency_cell_px = 16;

/// A sample is centred on pixel saliency_cell_px (column, row) of the frame. S is in Q8: 65280 is
/// the 255 that N scales to. Valid until the Saliency object examines another frame.
struct SaliencyMap {
  std::span<const std::uint16_t> samples;  // row by row
  int width = 0;
  int height = 0;
};

/// A plane at the map's level, sample by sample in the map's places. Valid as long as the map.
struct FramePlane {
  const std::int16_t* samples = nullptr;
  int width = 0;
  int height = 0;
  int stride = 0;  // samples from one row to the next
  float samples_per_grey_level = 1.0F;

  [[nodiscard]] const std::int16_t* row(int y) const {
    return samples + static_cast<std::ptrdiff_t>(stride) * y;
  }
};

/// Intensity, red-green, blue-yellow; a pure colour counts as 255 grey levels.
using FramePlanes = std::array<FramePlane, 3>;

/// What is known about a frame beforehand; by default nothing.
struct FrameContext {
  /// The head did not move between the previously examined frame and this one, nor during either:
  /// whatever differs has moved by itself.
  bool head_is_still = false;
  /// Where the last winner should be now, possibly outside the frame.
  std::optional<geometry::Pixel> previous_winner_px = std::nullopt;
  /// A factor on S, in Q15, for every sample of the map; empty: 1 everywhere.
  std::span<const std::uint16_t> kept = {};
  /// The same, 0 where the robot sees itself (own_parts.hpp). Applied before judging whether
  /// anything stands out; inhibition is applied after.
  std::span<const std::uint16_t> without_own_parts = {};
};

struct SaliencyResult {
  SaliencyMap map;
  FramePlanes planes;  // the planes from which the map was made
  geometry::Pixel peak_px =
      geometry::Pixel::Zero();  // the winner, refined between samples, in the frame's pixels
  float saliency = 0.0F;        // of the peak, absolute, [0, 1] (README.md here)
  float distinctness = 0.0F;    // how far the winner stands out, [0, 1]
};

/// Owns all working memory for frames of one size, so that examining a frame allocates nothing.
class Saliency {
 public:
  /// Frames may be 160x120 to 2560x1920. Throws std::invalid_argument for another size or a setting
  /// out of range.
  Saliency(const SaliencySettings& settings, int width_px, int height_px);
  ~Saliency();
  Saliency(Saliency&&) noexcept;
  Saliency& operator=(Saliency&&) noexcept;

  /// The frame must have the size given at construction, and be rgb24, grey, or yuyv of even width;
  /// throws std::invalid_argument otherwise. The same pixels give the same bits on every target.
  SaliencyResult examine(const base::ImageView& frame, const FrameContext& context = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed::saliency
