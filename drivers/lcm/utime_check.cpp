#include "drivers/lcm/utime_check.hpp"

#include <utility>

namespace gazed::lcm {

namespace {

constexpr std::int64_t longest_step_us = 3'600'000'000;

// A time before 0 is none. Both others are at least 0, so that the difference cannot overflow.
bool follows(std::int64_t utime_us, std::int64_t before_us) {
  return before_us >= 0 && utime_us > before_us && utime_us - before_us <= longest_step_us;
}

}  // namespace

std::string UtimeCheck::refusal(std::int64_t utime_us) {
  if (utime_us < 0) return "utime " + std::to_string(utime_us) + " us, before 1970";
  const std::int64_t jumped_to_us = std::exchange(jumped_to_us_, none);
  const bool goes_on_after_jump = jumped_to_us != none && follows(utime_us, jumped_to_us);
  const bool late = newest_us_ != none && utime_us < newest_us_;
  late_run_ = late && follows(utime_us, late_us_) ? late_run_ + 1 : (late ? 1 : 0);
  late_us_ = late ? utime_us : none;
  if (late_run_ == 1) first_late_us_ = utime_us;
  const bool set_back =
      late_run_ >= late_run_believed ||
      (late_run_ >= slow_late_run_believed && utime_us - first_late_us_ >= slow_late_run_us);
  if (set_back) set_back_us_ += newest_us_ - first_late_us_;
  if (newest_us_ == none || follows(utime_us, newest_us_) || goes_on_after_jump || set_back) {
    newest_us_ = utime_us;
    late_us_ = none;
    late_run_ = 0;
    return {};
  }
  const std::string times = "utime " + std::to_string(utime_us) + " us after " +
                            std::to_string(newest_us_) + " us: time ";
  if (utime_us == newest_us_) return times + "stands still";
  if (utime_us < newest_us_) return times + "goes backwards";
  jumped_to_us_ = utime_us;
  return times + "jumps by more than an hour";
}

}  // namespace gazed::lcm
