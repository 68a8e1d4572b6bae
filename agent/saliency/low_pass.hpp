// The pyramid's filter without its decimation: [1 4 6 4 1]/16 along rows and columns, borders
// reflected.
#pragma once

#include <cstdint>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

/// In place. |samples| stay below 2^27; each direction rounds once. `scratch` has the plane's size.
void low_pass(const PlaneView<std::int32_t>& plane, const PlaneView<std::int32_t>& scratch);

}  // namespace gazed::saliency
