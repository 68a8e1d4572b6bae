// What an object looks like, so that it can be told from others where it is expected again.
//
// The pattern of a place is 5 x 5 samples of the three planes at the map's level, interpolated
// between them: as many grey levels of intensity above the pattern's mean, and of the two opponents
// above grey. So it has the object's own colour, its contrast to what is around it, and its size.
#pragma once

#include <array>
#include <cstddef>

#include "agent/geometry/camera.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

struct Appearance {
  static constexpr int side = 5;
  static constexpr std::size_t samples = 3 * std::size_t{side} * side;

  std::array<float, samples> pattern{};
};

/// Around a pixel of the frame; its border stands for what is beyond it.
[[nodiscard]] Appearance appearance_at(const FramePlanes& planes, const geometry::Pixel& pixel);

/// 2 a.b / (a.a + b.b + n), n of 2 grey levels of noise: 1 for the same, 0.97 for the same in 1.3
/// times the light, less where contrast, colour or size differ, 0 for a place without pattern or
/// colour, down to -1.
[[nodiscard]] double likeness(const Appearance& a, const Appearance& b);

/// Whether a place of a later frame is the object of an earlier one.
struct Confirmation {
  /// In 327 photographs and canteen frames, turned by the step rule's move, the true place is never
  /// refused and a random place is confirmed in 9 % (33 % by the share alone); see
  /// tests/benchmarks/quality confirm. These pictures were seen when the limits were chosen.
  static constexpr double least_share = 0.3;
  static constexpr double least_likeness = 0.7;

  double share = 0.0;     // of the map's peak, at the place or a sample beside it
  double likeness = 0.0;  // to the earlier appearance

  [[nodiscard]] bool salient() const { return share >= least_share; }
  [[nodiscard]] bool alike() const { return likeness >= least_likeness; }
};

[[nodiscard]] Confirmation confirm(const SaliencyResult& seen, const geometry::Pixel& pixel,
                                   const Appearance& before);

}  // namespace gazed::saliency
