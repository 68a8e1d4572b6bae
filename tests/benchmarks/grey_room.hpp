// The rooms of the calm rows: red things before near-grey textures, as the literature on pop-out
// and on structure from motion likes them.
#pragma once

#include <Eigen/Core>

#include "agent/base/random.hpp"
#include "drivers/sim/scene.hpp"

#include "tests/benchmarks/accuracy_placing.hpp"

namespace gazed::benchmarks {

/// A leaves texture, nearly grey.
[[nodiscard]] sim::Texture photographic(base::Random& random, double range_m);

/// The report's printed disc up close, from 0.5 m on as large as the ball of RoboCup's standard
/// platform league.
[[nodiscard]] double object_size_m(double range_m);
[[nodiscard]] sim::Appearance draw_red_object(base::Random& random, double range_m);

/// Floor, ceiling, walls to both sides and ahead.
void add_room(sim::Scene& scene, base::Random& random, double ahead_m);

/// Six dull things, and another that stands out, none in front of the target.
void add_clutter(sim::Scene& scene, base::Random& random, const Camera1& camera,
                 const Eigen::Vector3d& target_direction, double target_radius_rad, double ahead_m);

}  // namespace gazed::benchmarks
