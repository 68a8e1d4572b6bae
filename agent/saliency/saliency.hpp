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

/// One set of defaults serves both profiles.
struct SaliencySettings {
  SaliencyProfile profile = SaliencyProfile::robust;
  bool clamp_negative = false;    // report profile: R, G, B, Y below 0 become 0
  double intensity_weight = 1.0;  // of the conspicuity maps, 0 to 10; only their ratio counts
  double colour_weight = 1.0;

  /// Below it there is no salient object; [0, 1]. Share of pictures at or above 0.3, robust /
  /// report profile (tests/unit/saliency: distinctness_test, photographs_test):
  ///   86 photographs of one object (ECSSD)                   0.95 / 0.83
  ///     where the winner is on the object / is not           0.97, 0.92 / 0.98, 0.52
  ///   5 photographs with red objects                         1 / 1, lowest 0.37 / 0.37
  ///   100 drawn discs of 16 to 120 px on a shaded wall       1 / 0.95
  ///   5 pictures of turf from a NAO's bottom camera          0 / 0, highest 0.26 / 0.17
  ///   54 empty walls, shaded by 15 to 70 %, and noise        0 / 0, highest 0.03 / 0.04
  ///   grey with noise of up to 3 grey levels                 0 / 0
  /// An untidy desk is not told from a single object: what lies on it does stand out.
  double distinctness_min = 0.3;

  /// A centre-surround map whose maximum is below has no say; grey levels, 0 to 255. White noise of
  /// standard deviation 2, the same in r, g and b, leaves under 0.5 in robust maps, 4 leaves under
  /// 1. In the report profile, whose finest maps are not reduced before N, 2 leaves about 1: such a
  /// map has many equal maxima, and N and the distinctness put it down. NSS on OSIE is the same to
  /// four digits without the two floors and with twice their values.
  double intensity_noise_floor = 1.0;

  /// Likewise; full scale of an opponent plane, a pure colour, counts as 255. The same noise,
  /// independent in r, g and b, leaves under 0.5 in robust maps, 4 leaves under 1. In the report
  /// profile it is divided by the intensity: 2 leaves under 2 at grey level 128, under 8 where
  /// r + g + b is hardly enough for a hue.
  double colour_noise_floor = 2.5;
};

/// One sample is centred on pixel saliency_cell_px (column, row) of the frame. S in Q8: 65280 is
/// the 255 that N scales to. Borrowed from the Saliency that made it.
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

/// Keeps all working state for frames of one size, so that looking at a frame allocates nothing.
class Saliency {
 public:
  /// Sizes from 160x120 to 2560x1920. Throws std::invalid_argument for another size or a setting
  /// out of range.
  Saliency(const SaliencySettings& settings, int width_px, int height_px);
  ~Saliency();
  Saliency(Saliency&&) noexcept;
  Saliency& operator=(Saliency&&) noexcept;

  /// The frame must have the size given at construction and be rgb24 or yuyv of even width (grey
  /// frames have no colour and are accepted); throws std::invalid_argument otherwise. The same
  /// pixels give the same bits on every target.
  SaliencyResult look(const ImageView& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gazed
