// The most salient place of a frame: fixed-point colour-opponent pyramid, centre-surround, N,
// winner (SPEC 1).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "agent/geometry/camera.hpp"
#include "agent/image.hpp"

namespace gazed {

/// A sample of the map, at scale 4 of the pyramid, is centred on pixel 16 times its column and row.
inline constexpr int saliency_cell_px = 16;

enum class SaliencyProfile : std::uint8_t {
  report,  // SPEC 1.1: the 2011 report, sums of opponents as printed
  robust,  // SPEC 1.2: differences, border ramp, reduction before N, late colour
};

struct SaliencySettings {
  SaliencyProfile profile = SaliencyProfile::robust;
  bool clamp_negative = false;    // report profile: R, G, B, Y below 0 become 0
  double intensity_weight = 1.0;  // of the conspicuity maps, 0 to 10
  double colour_weight = 1.0;
  double distinctness_min = 0.0;  // below it there is no salient object; [0, 1]
  double intensity_noise_floor =
      0.0;  // a centre-surround map whose maximum is below has no say; grey levels, 0 to 255
  double colour_noise_floor = 0.0;  // likewise, of the opponent planes' full scale
};

/// Borrowed from the
/// Saliency that made it.
struct SaliencyMap {
  std::span<const std::uint16_t> samples;  // row by row
  int width = 0;
  int height = 0;
};

struct SaliencyResult {
  SaliencyMap map;
  Pixel peak_px = Pixel::Zero();  // the winner, refined between samples, in the frame's pixels
  float saliency = 0.0F;          // unscaled peak of S over 255
  float distinctness = 0.0F;      // how far the winner stands out, [0, 1]
};

/// Frame sizes that are taken.
inline constexpr int kSmallestWidth_px = 160, kSmallestHeight_px = 120;
inline constexpr int kLargestWidth_px = 2560, kLargestHeight_px = 1920;

/// Keeps all working state for frames of one size, so that looking at a frame allocates nothing.
class Saliency {
 public:
  /// Sizes from 160x120 to 2560x1920. Throws std::invalid_argument for another size or a setting
  /// out of range.
  Saliency(const SaliencySettings& settings, int width_px, int height_px);
  ~Saliency();
  Saliency(Saliency&&) noexcept;
  Saliency& operator=(Saliency&&) noexcept;

  /// The frame must have the size given at construction and be rgb24 or yuyv (grey frames have no
  /// colour and are accepted); throws std::invalid_argument otherwise. The same pixels give the
  /// same bits on every target.
  SaliencyResult look(const ImageView& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed
