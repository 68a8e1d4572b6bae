// What makes an object hard to locate, each of the rows that have one such thing.
#pragma once

#include "agent/base/random.hpp"
#include "drivers/sim/scene.hpp"

#include "tests/benchmarks/accuracy_placing.hpp"
#include "tests/benchmarks/accuracy_rows.hpp"
#include "tests/benchmarks/colourful_room.hpp"

namespace gazed::benchmarks {

[[nodiscard]] bool is_ball(Strain strain);

/// Changes the object, or adds what stands before or beside it.
void add_hard_things(sim::Scene& scene, base::Random& random, Strain strain, const Camera1& camera,
                     Target& target);

}  // namespace gazed::benchmarks
