// A head that is where a list of frames says at the time of each frame.
//
// Between two frames it rests at the first one's angles, turns evenly, and rests at the second
// one's:
//
//   frame a                                                        frame b
//     |--- rest: 0.4 gap, <= 0.2 s ---|-- turn: 0.2 gap, <= 0.2 s --|------ rest ------|
//
// Sampled every 10 ms, in short gaps 15 times. So at least two still samples stand before every
// frame, one stands exactly on it, and interpolation at the frame's time gives its angles to the
// last bit.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/lab/io/frames_csv.hpp"
#include "drivers/head.hpp"

namespace gazed::lab {

/// The rest of 0.2 s that ends with a state on the first frame's time; no state before time 0.
[[nodiscard]] std::vector<geometry::HeadState> head_states_before(const io::RecordedFrame& first);

/// The motion after frame a, up to and including frame b's time. Ascending in time; velocities are
/// those of the motion, stiffness 1.
[[nodiscard]] std::vector<geometry::HeadState> head_states_between(const io::RecordedFrame& a,
                                                                   const io::RecordedFrame& b);

/// When frame b's picture can be shown before its time, so that no more than 1.5 s pass without a
/// picture: every second back from b, while the head rests at b's angles. Empty for frames that
/// are no farther apart than 1.5 s.
[[nodiscard]] std::vector<std::int64_t> early_showings(const io::RecordedFrame& a,
                                                       const io::RecordedFrame& b);

/// The rest of 0.2 s after the last frame.
[[nodiscard]] std::vector<geometry::HeadState> head_states_after(const io::RecordedFrame& last);

}  // namespace gazed::lab
