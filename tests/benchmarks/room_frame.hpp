// The frame that benchmarks look at unless they are given another: a room, drawn here.
#pragma once

#include "agent/base/image.hpp"

namespace gazed::benchmarks {

/// A wall with a poster and a shelf, a tiled floor, two objects that stand out, texture and camera
/// noise everywhere. rgb24, by integer arithmetic alone: the same bytes on every target. The room
/// fills the frame at every size. Sides of 1 to 8192 px.
[[nodiscard]] base::Image room_frame(int width_px, int height_px);

}  // namespace gazed::benchmarks
