// The appearance of an object, to recognise it where it is expected again.
//
// The pattern of a place is 5 x 5 samples of the three planes at the map's level, interpolated:
// intensity as grey levels above the pattern's mean, the two opponents as levels above grey. So it
// contains the object's colour, its size, and its contrast to the surroundings.
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

/// The pattern around a pixel of the frame. Beyond the frame, border samples are repeated.
[[nodiscard]] Appearance appearance_at(const FramePlanes& planes, const geometry::Pixel& pixel);

/// 2 a.b / (a.a + b.b + n), with n for 2 grey levels of noise: 1 for equal patterns, 0.97 under 1.3
/// times the light, less if contrast, colour or size differ, 0 for a place without pattern or
/// colour; at least -1.
[[nodiscard]] double likeness(const Appearance& a, const Appearance& b);

/// Whether a place in a later frame shows the object of an earlier one.
struct Confirmation {
  /// On 327 photographs and canteen frames, turned by the step rule's move, the true place is never
  /// refused and a random place is confirmed in 9 % (33 % with the share alone); see
  /// tests/benchmarks/quality confirm. The limits were chosen on these pictures.
  static constexpr double least_share = 0.3;
  static constexpr double least_likeness = 0.7;

  double share = 0.0;     // of the map's peak, at the place or a neighbouring sample
  double likeness = 0.0;  // similarity to the earlier appearance

  [[nodiscard]] bool salient() const { return share >= least_share; }
  [[nodiscard]] bool alike() const { return likeness >= least_likeness; }
};

[[nodiscard]] Confirmation confirm(const SaliencyResult& seen, const geometry::Pixel& pixel,
                                   const Appearance& before);

}  // namespace gazed::saliency
