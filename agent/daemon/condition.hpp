// What gazed is connected to and what it lacks, as text: for status_t.fault, the terminal and the
// service manager.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/driver.hpp"

namespace gazed::daemon {

/// Its string views point to strings that live longer, so creating one allocates nothing while all
/// is well.
struct Condition {
  /// The camera or the head.
  struct Part {
    std::string_view source;  // as configured
    bool silent = false;      // nothing has arrived yet, or not for too long
    drivers::Health health;   // of the driver, and why its data cannot be used
  };
  Part camera, head;
  std::string_view lcm_url;
  std::string lcm_fault;  // may be empty, as the next one
  std::string recorder_fault;
  std::int32_t fixations = 0;
  std::int32_t located = 0;
};

/// All faults; empty if there is none.
[[nodiscard]] std::string faults(const Condition& condition);

/// One line: what is missing (camera, head, route) or that gazed is looking, and the results so
/// far. It contains no counts of seconds or lost messages, so it does not change while nothing
/// happens.
[[nodiscard]] std::string status_line(const Condition& condition);

}  // namespace gazed::daemon
