// The rooms of the real rows: painted and papered walls, posters, books, furniture, a table with
// things on it, and objects of any hue among them.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "agent/base/random.hpp"
#include "drivers/sim/scene.hpp"

#include "tests/benchmarks/accuracy_placing.hpp"

namespace gazed::benchmarks {

using Photographs = std::span<const std::shared_ptr<const sim::MipMap>>;

/// The hues of a room lie around one; that of its object, which stands out, across from it.
struct Palette {
  double hue = 0.0;  // in turns, from red over yellow
};

/// The object to be located, and where it is.
struct Target {
  sim::PlacedPlane object;
  Eigen::Vector3d direction;  // from camera 1
  double range_m = 0.0;
  double radius_rad = 0.0;
};

/// A third of them are pale.
[[nodiscard]] sim::Appearance draw_colourful_object(base::Random& random, const Palette& palette,
                                                    double range_m);

/// A wall that the object hangs on, and posters beside it. Papered with a photograph if there are
/// any.
void add_wall_behind(sim::Scene& scene, base::Random& random, const Palette& palette,
                     const Target& target, Photographs photographs);

/// A room around the object: furniture, shelves, posters. Walls are papered with photographs if
/// there are any.
void add_colourful_room(sim::Scene& scene, base::Random& random, const Palette& palette,
                        double ahead_m, Photographs photographs);

/// A table below the object, where there is room for one, and things in front of the object, beside
/// it and, unless it hangs on a wall, behind it, up to `ahead_m`. They hide nothing of the object
/// from wherever the head turns the camera.
void add_things(sim::Scene& scene, base::Random& random, const Palette& palette,
                const Camera1& camera, const Target& target, bool on_wall, double ahead_m);

}  // namespace gazed::benchmarks
