#include "agent/cycle/frame_counts.hpp"

#include <array>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"

namespace gazed::cycle {

namespace {

/// Of logs: a live head's states are compared as they come.
std::string apart(const FrameCounts& counts) {
  if (!counts.first_frame_us || !counts.first_state_us) return {};
  const double before_s = base::seconds_between(*counts.last_frame_us, *counts.first_state_us);
  const double after_s = base::seconds_between(*counts.last_state_us, *counts.first_frame_us);
  if (before_s <= 0.0 && after_s <= 0.0) return {};
  return base::text("; the frames' times lie %.1f s %s the head states': their clocks differ",
                    before_s > 0.0 ? before_s : after_s, before_s > 0.0 ? "before" : "after");
}

}  // namespace

std::string in_words(const FrameCounts& counts) {
  struct Part {
    std::int64_t count;
    const char* what;
  };
  const std::array parts{
      Part{counts.no_angles, "had no head states from before and after them"},
      Part{counts.moving, "came while the head moved"},
      Part{counts.turning, "came on the way to the next look or after a fault"},
      Part{counts.other_first, "came while an earlier one waited for its head angles"},
      Part{counts.refused, "had another size or an impossible time"},
      Part{counts.looked_at, "were looked at"},
  };
  std::string text = "of " + base::counted(counts.all(), "frame");
  const char* separator = " ";
  for (const auto& [count, what] : parts) {
    if (count == 0) continue;
    text += separator + std::to_string(count) + " " + what;
    separator = ", ";
  }
  return text + apart(counts);
}

}  // namespace gazed::cycle
