// Where exactly an object ends, and what its edge hides.
//
// The outer part of a blurred edge belongs to the background, which parallax moves behind the
// object. A place that lies s outside the edge, in units of the edge's blur, shows a share Phi(s)
// of the background, Phi being the normal distribution. The background's value is read a little
// further outside in both views, and its change is subtracted. Places that show mostly background
// are left out.
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

  /// Traces the mask's outline wherever `plane` (full resolution) has an edge.
  void find(const ObjectMask& object, const PlaneLevel& plane);

  void clear() { count_ = 0; }

  [[nodiscard]] std::span<const RimPoint> points() const {
    return std::span(points_).first(count_);
  }

  /// How a pixel relates to the outline.
  struct Place {
    std::uint16_t nearest = 0;  // index of the nearest outline point
    double share_behind = 0.0;  // share of the background in the pixel, 0 to 1
  };
  /// On a level of the plane with this step; none if the pixel is far from every outline point.
  [[nodiscard]] std::optional<Place> place(const geometry::Pixel& pixel, int step_px) const;

  /// Places side by side near an outline point that show only background on that level. There are
  /// several, to average the camera's noise.
  static constexpr int places_behind = 3;
  [[nodiscard]] geometry::Pixel behind(const RimPoint& point, int place, int step_px) const;

 private:
  bool add(const geometry::Pixel& centre, const Eigen::Vector2d& outward, double reach_px,
           const PlaneLevel& plane);

  std::array<RimPoint, points_max> points_;
  std::array<double, points_max> blurs_px_;
  std::size_t count_ = 0;
  [[nodiscard]] double blur_on_level_px(int step_px) const;

  double blur_px_ = 1.0;     // standard deviation of the edge at full resolution
  double spacing_px_ = 1.0;  // between the outline points
};

}  // namespace gazed::tracking
