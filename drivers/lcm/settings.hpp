// Where LCM's messages go.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace gazed::lcm {

/// LCM's providers beside udpm (1.3.1), which a program has that links liblcm
/// (other_providers.hpp).
inline constexpr std::array<std::string_view, 4> liblcm_providers{"mpudpm", "tcpq", "memq", "file"};

struct LcmSettings {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";  // LCM's own default
  std::string prefix = "GAZED";                         // of every channel
};

}  // namespace gazed::lcm
