// Areas of a picture that may be the object, and which of them is.
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
  int cell_shift = 0;        // the window in which it was found
  ColourArea area;           // of one colour
  float contrast = 0.0F;     // colour difference to what is around it
  float clearness = 0.0F;    // log of the ratio of that to what it and its surroundings have inside
  float area_px = 0.0F;      // of its convex hull
  float solid_share = 1.0F;  // of the hull, what belongs to the area
  Eigen::Vector2f salient_px = Eigen::Vector2f::Zero();  // the place that stands out
  Eigen::AlignedBox2f box_px;
  std::size_t number = 0;  // in the order of finding
};

class Candidates {
 public:
  void clear() { count_ = 0; }

  /// Left out when there is no room: there are never as many that differ.
  void add(const Candidate& candidate);

  /// From small to large: an area around one that was taken is taken instead when the smaller is a
  /// mark on it; of areas side by side the clearer. Sorts.
  [[nodiscard]] std::optional<Candidate> best();

  /// Leaves nothing but what is around this area and larger: the area itself is a mark.
  void keep_around(const Candidate& mark);

 private:
  std::array<Candidate, 64> all_;
  std::size_t count_ = 0;
};

}  // namespace gazed::tracking
