// Prints what each gazed locates that is heard: a robot's channels begin with its own prefix.
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "msgs/gazed/located_point_t.hpp"

constexpr const char* names[] = {"LOCATED",    "NO_SALIENT_OBJECT", "TARGET_LOST",
                                 "DEGENERATE", "BEHIND_CAMERA",     "UNCERTAIN",
                                 "HEAD_FAULT", "CAMERA_FAULT"};

struct Listener {
  void show(const lcm::ReceiveBuffer*, const std::string& channel,
            const gazed::located_point_t* point) {
    const double* at = point->position_m;
    const bool known = point->status >= 0 && point->status < 8;
    std::printf("%s: %s: %.3f m away +- %.3f m, at x %.3f, y %.3f, z %.3f m; %s\n", channel.c_str(),
                known ? names[point->status] : "a later status", point->range_m,
                point->range_sigma_m, at[0], at[1], at[2], point->reason.c_str());
    std::fflush(stdout);
  }
};

int main() {
  lcm::LCM link;
  Listener listener;
  if (!link.good()) return 1;
  link.subscribe(".*_LOCATED_POINT", &Listener::show, &listener);
  while (link.handle() == 0) {
  }
  return 1;
}
