// Where LCM's messages go.
#pragma once

#include <string>

namespace gazed::lcm {

struct LcmSettings {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";  // LCM's own default
  std::string prefix = "GAZED";                         // of every channel
};

}  // namespace gazed::lcm
