// Where LCM's messages go.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace gazed::lcm {

/// LCM's providers beside udpm (1.3.1), which a program has that links liblcm
/// (other_providers.hpp).
inline constexpr std::array<std::string_view, 4> liblcm_providers{"mpudpm", "tcpq", "memq", "file"};

inline constexpr std::string_view channel_name_rule =
    "up to 63 letters, digits and any of _ - . /, or empty for that of the prefix";
/// By that rule: LCM ends a name at 63 bytes, and reads one that is subscribed to as a regular
/// expression.
inline bool is_channel_name(std::string_view name) {
  constexpr std::size_t longest = 63;
  const auto fits = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  return name.size() <= longest && std::ranges::all_of(name, fits);
}

struct LcmSettings {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";  // LCM's own default
  std::string prefix = "GAZED";                         // of every channel
  // Of a camera and a head that other programs drive, where their names are others; empty: by the
  // prefix.
  std::string image_channel;
  std::string head_state_channel;
  std::string head_command_channel;
};

}  // namespace gazed::lcm
