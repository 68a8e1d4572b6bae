// Whether a frame in profile surround contains an object that stands out.
//
// A frame without one is either bland (a wall, turf, the part of a photograph beside its subject)
// or busy (a desk, a canteen). A statistic that counts against one often counts for the other, so
// each has its own weights in a logistic regression with three classes:
//
// share = 1 / (1 + 2^bland + 2^busy)
//
// where bland and busy are weighted sums of the frame's statistics.
#pragma once

#include <array>
#include <bitset>

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/surroundedness.hpp"

namespace gazed::saliency {

/// Intensity, red-green, blue-yellow at the map's level.
using PlanesAtMapLevel = std::array<ConstPlane, 3>;

/// Logarithms are coarse_log2(). Levels are grey levels; a pure colour counts as 255.
struct FrameStatistics {
  double attention = 0.0;   // log of the mean attention (surroundedness.hpp)
  double apart = 0.0;       // log of 1 and how far the mean colour where S is above half of the
                            // winner's is from that of the border, in units of its spread
  double colours = 0.0;     // log of the number of different colours, in steps of 21 and 16 levels
  double contrast = 0.0;    // log of 1 and the standard deviation of intensity
  double at_border = 0.0;   // [0, 1] mean of S there, as a share of the winner's
  double border_mix = 0.0;  // log of 1 and the standard deviation of the border's colours
};

/// Base-2 logarithm of x > 0, linear between powers of two: at most 0.09 too small. Has the same
/// bits everywhere, which no library guarantees.
[[nodiscard]] double coarse_log2(double x);
/// The inverse of coarse_log2, for |y| < 1000.
[[nodiscard]] double coarse_exp2(double y);

/// [0, 1]: how much the statistics resemble those of frames with an object.
[[nodiscard]] double object_share(const FrameStatistics& statistics);

class ObjectOrNone {
 public:
  /// The map is as it was before anything was inhibited, and not 0 everywhere.
  [[nodiscard]] FrameStatistics statistics(const SaliencyPlane& map, const Attention& attention,
                                           const PlanesAtMapLevel& planes);

 private:
  static constexpr int intensity_steps_log2 = 4, opponent_steps_log2 = 5;

  [[nodiscard]] std::size_t count_colours(const PlanesAtMapLevel& planes);

  std::bitset<1U << (intensity_steps_log2 + 2 * opponent_steps_log2)> colours_;
};

}  // namespace gazed::saliency
