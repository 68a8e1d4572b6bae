// Counts frames that the camera's driver had no buffer for, from the numbers of the others.
#pragma once

#include <cstdint>
#include <optional>

namespace gazed::v4l2 {

class SequenceGaps {
 public:
  /// A stream begins, and its numbers with it.
  void restart() { last_.reset(); }

  /// How many numbers were left out before this one. They wrap at 2^32; numbers that go back or
  /// stand still (old drivers number every frame 0) leave none out.
  std::int64_t before(std::uint32_t sequence) {
    const std::uint32_t step = last_ ? sequence - *last_ : 1;
    last_ = sequence;
    const bool forward = step != 0 && step < (std::uint32_t{1} << 31);
    return forward ? step - 1 : 0;
  }

 private:
  std::optional<std::uint32_t> last_;
};

}  // namespace gazed::v4l2
