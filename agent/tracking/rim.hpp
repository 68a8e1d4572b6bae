// Where exactly an object ends, and what is to be seen behind its edge.
//
// Of a blurred edge the outer part belongs to the background, which parallax makes slide along
// behind the object. Let s be how far a place lies outside the edge, in units of its blur: it shows
// a share Phi(s) of the background, Phi the normal distribution. What the background is there is
// read a little further outside, in either view, and its change is taken off. Places that show more
// background than object are left out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"
#include "agent/tracking/plane.hpp"

namespace gazed::tracking {

struct RimPoint {
  geometry::Pixel edge;     // where the plane's values change most
  Eigen::Vector2d outward;  // unit length
};

class Rim {
 public:
  static constexpr std::size_t points_max = 128;

  /// Along the mask's outline, where `plane` (in full resolution) has an edge.
  void find(const ObjectMask& object, const PlaneLevel& plane);

  void clear() { count_ = 0; }

  [[nodiscard]] std::span<const RimPoint> points() const {
    return std::span(points_).first(count_);
  }

  /// What a pixel has to do with the outline.
  struct Place {
    std::uint16_t nearest = 0;  // point of the outline
    double share_behind = 0.0;  // of what the pixel shows, 0 to 1
  };
  /// On a level of the plane that has step_px; none far from every point of the outline.
  [[nodiscard]] std::optional<Place> place(const geometry::Pixel& pixel, int step_px) const;

  /// Next to a point, places side by side that show nothing but background on that level: several,
  /// since one has all the camera's noise.
  static constexpr int places_behind = 3;
  [[nodiscard]] geometry::Pixel behind(const RimPoint& point, int place, int step_px) const;

 private:
  bool add(const geometry::Pixel& centre, const Eigen::Vector2d& outward, double reach_px,
           const PlaneLevel& plane);

  std::array<RimPoint, points_max> points_;
  std::array<double, points_max> blurs_px_;
  std::size_t count_ = 0;
  [[nodiscard]] double blur_on_level_px(int step_px) const;

  double blur_px_ = 1.0;     // standard deviation of the edge in full resolution
  double spacing_px_ = 1.0;  // of the points
};

}  // namespace gazed::tracking
