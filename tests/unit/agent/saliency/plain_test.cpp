// saliency_plain_test hashes what the plain lanes compute, whatever the compiler's flags offer.
#include "agent/saliency/lanes.hpp"

static_assert(!gazed::saliency::has_simd_lanes);
