// What gazed has to work with and what it lacks, as text: for status_t.fault, the terminal and the
// service manager.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/driver.hpp"

namespace gazed::daemon {

/// Its string views point to longer-lived strings, so that making one allocates nothing while all
/// is well.
struct Condition {
  /// The camera or the head.
  struct Part {
    std::string_view source;  // as configured
    bool silent = false;      // nothing has come yet, or nothing for too long
    drivers::Health health;   // the driver's, and why what came cannot be used
  };
  Part camera, head;
  std::string_view lcm_url;
  std::string lcm_fault;  // may be empty, as the next one
  std::string recorder_fault;
  std::int32_t fixations = 0;
  std::int32_t located = 0;
};

/// All faults; empty when there is none.
[[nodiscard]] std::string faults(const Condition& condition);

/// One line: what is missing (camera, head, route), or that gazed is looking; and what came of it.
/// Nothing in it counts seconds or lost messages, so that it stays the same while nothing happens.
[[nodiscard]] std::string status_line(const Condition& condition);

}  // namespace gazed::daemon
