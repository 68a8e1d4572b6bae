// Areas of a picture that may be the object, and the choice among them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>

#include "agent/tracking/own_colour.hpp"

namespace gazed::tracking {

struct Candidate {
  bool of_one_colour = false;
  int cell_shift = 0;     // the window in which it was found
  ColourArea area;        // an area of one colour
  float contrast = 0.0F;  // colour difference from the surroundings
  // log of contrast / (contrast within the area and within its surroundings)
  float clearness = 0.0F;
  float area_px = 0.0F;      // area of the convex hull
  float solid_share = 1.0F;  // share of the hull that belongs to the area
  Eigen::Vector2f salient_px = Eigen::Vector2f::Zero();  // the most salient place
  Eigen::AlignedBox2f box_px;
  std::size_t number = 0;  // in the order in which they were found
};

class Candidates {
 public:
  void clear() { count_ = 0; }

  /// Ignored when there is no room; there are never that many different ones.
  void add(const Candidate& candidate);

  /// Goes from small to large. An area around the chosen one replaces it when the smaller is a mark
  /// on it; of areas side by side the clearer wins. Sorts the list.
  [[nodiscard]] std::optional<Candidate> best();

  /// The mark that best()'s last answer replaced.
  [[nodiscard]] const std::optional<Candidate>& mark() const { return mark_; }

  /// Keeps only larger areas around this one, which has turned out to be a mark.
  void keep_around(const Candidate& mark);

 private:
  std::array<Candidate, 64> all_;
  std::size_t count_ = 0;
  std::optional<Candidate> mark_;
};

}  // namespace gazed::tracking
