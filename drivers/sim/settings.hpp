// What the simulator is told.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::sim {

/// Of simulated time: as fast as the computer can, or in step with the wall clock. Automatic is
/// fast where a number of fixations is to be made.
enum class Pace : std::uint8_t { automatic, fast, real };

struct SimSettings {
  std::string scene;       // file; empty: the scene that is built in
  std::uint32_t seed = 1;  // of everything random
  Pace pace = Pace::automatic;
};

}  // namespace gazed::sim
