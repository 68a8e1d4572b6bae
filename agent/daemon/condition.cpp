#include "agent/daemon/condition.hpp"

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"

namespace gazed::daemon {

namespace {

void add(std::string& list, const std::string& item) {
  if (!item.empty()) list += (list.empty() ? "" : "; ") + item;
}

// If a camera or head uses LCM, the connection's fault is reported separately.
std::string missing(const char* name, const char* what, const Condition::Part& part) {
  if (!part.silent) return {};
  const bool has_own_fault = !part.health.ok() && part.health.kind != drivers::HealthKind::no_link;
  return base::text("no %s: ", name) +
         (has_own_fault ? part.health.words
                        : base::text("no %s comes from ", what) + std::string(part.source));
}

}  // namespace

std::string faults(const Condition& condition) {
  std::string all;
  add(all, condition.camera.health.words);
  add(all, condition.head.health.words);
  add(all, condition.lcm_fault);
  add(all, condition.recorder_fault);
  return all;
}

std::string status_line(const Condition& condition) {
  std::string line;
  add(line, missing("camera", "frame", condition.camera));
  add(line, missing("head", "state", condition.head));
  if (!condition.lcm_fault.empty())
    add(line, "no route: LCM cannot send to " + std::string(condition.lcm_url) +
                  " (no network, or no multicast route)");
  if (line.empty()) line = "looking";
  add(line,
      base::counted(condition.fixations, "point") + base::text(", %d located", condition.located));
  add(line, condition.recorder_fault);
  return line;
}

}  // namespace gazed::daemon
