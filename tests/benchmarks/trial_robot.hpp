// The robot of a trial: what it measures and how it behaves, and what the agent is told of it.
#pragma once

#include <cstdint>

#include "tests/benchmarks/accuracy_rows.hpp"

namespace gazed::benchmarks {

/// Draws the robot's errors, and sets how joints and camera behave, by the trial's seed. The agent
/// believes the nao-v6's profile at the row's image size.
void draw_robot(Trial& trial, const Row& row);

}  // namespace gazed::benchmarks
