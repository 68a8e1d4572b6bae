// Where the numbers come from. Instructions: tests/benchmarks/instructions, a look at 640x480 RGB
// on x86-64. Seconds, looks and sigmas: `gazed --fixations 24`, the built-in scene, medians. Bytes:
// the sizes of the messages.
#include "agent/settings/costs.hpp"

#include <algorithm>
#include <array>

namespace gazed::settings {
namespace {

constexpr auto costs = std::to_array<Cost>({
    {"camera.width_px", "saliency's time grows with the number of pixels"},
    {"camera.height_px", "saliency's time grows with the number of pixels"},
    {"head.speed_fraction",
     "slower is longer: 0.1 takes 1.2 s a fixation, 0.3 takes 0.8 s; 1 saves no more than 0.02 s "
     "of it, since the head must settle"},
    {"head.settle_velocity_rad_s",
     "lower waits longer before each look; higher blurs it, and the head's angles with it"},
    {"saliency.profile",
     "millions of instructions a look: surround 5.9, report 5.9, robust 3.5; surround finds what "
     "people look at best, report worst"},
    {"saliency.flicker_weight", "above 0 a look takes 2.4 % more instructions"},
    {"saliency.overexposed_weight",
     "lower finds sooner what is not a window; a white thing that is overexposed is found later"},
    {"saliency.exclude_feet", "what lies within 0.1 m of the toes is not looked at either"},
    {"saliency.distinctness_min",
     "higher refuses more objects, lower takes more clutter for objects; at 0.3, of pictures that "
     "nothing was fitted to, 5 % of objects are refused and 41 % of a canteen's frames taken"},
    {"locate.method", "report: two looks, and no sigma that the background improves"},
    {"locate.looks",
     "each look after the first takes a move, 0.3 to 0.4 s, and 59 million instructions"},
    {"locate.looks_min",
     "each look after the first takes a move, 0.3 to 0.4 s, and 59 million instructions"},
    {"locate.relative_sigma_goal",
     "smaller takes more looks: 0.03 takes 3 and 0.8 s for a sigma of 2.1 %, 0.01 takes 4.4 and "
     "1.4 s for 1.5 %"},
    {"locate.relative_sigma_max",
     "higher publishes worse points as LOCATED; at 0.15, 3.2 % of those from two looks are over "
     "20 % wrong"},
    {"publish.images",
     "614 kB a frame that was used, at 640x480: one a look; as jpeg of quality 80, 17 kB of the "
     "built-in scene"},
    {"publish.saliency", "1.3 kB a look at 640x480"},
    {"run.record", "614 kB a frame at 640x480, used or not: 18 MB/s of disk at 30 frames a second"},
});

}  // namespace

std::span<const Cost> all_costs() {
  return costs;
}

std::string_view cost_of(std::string_view path) {
  const auto found = std::ranges::find(costs, path, &Cost::path);
  return found == costs.end() ? std::string_view{} : found->text;
}

}  // namespace gazed::settings
