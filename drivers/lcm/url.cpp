#include "drivers/lcm/url.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "drivers/lcm/other_providers.hpp"

namespace gazed::lcm {

namespace {

constexpr std::string_view default_url = "udpm://239.255.76.67:7667?ttl=0";
// LCM's own group (lcm_udpm.c).
constexpr const char* default_address = "239.255.76.67";
constexpr std::uint16_t default_port = 7667;
constexpr std::string_view buffer_option = "recv_buf_size=";
constexpr std::string_view image_buffer_bytes = "4000000";

[[noreturn]] void refuse(std::string_view url, std::string_view found, std::string_view allowed) {
  throw std::invalid_argument("LCM URL \"" + std::string(url) + "\": " + std::string(found) +
                              " found; allowed: " + std::string(allowed));
}

/// A whole number within limits; refuses anything else.
int read_number(std::string_view url, std::string_view name, std::string_view text, int least,
                int most) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < least || number > most) {
    refuse(url, std::string(name) + " \"" + std::string(text) + "\"",
           std::to_string(least) + " to " + std::to_string(most));
  }
  return number;
}

/// "", "ADDRESS" or "ADDRESS:PORT"; what is left out has LCM's default.
sockaddr_in read_group(std::string_view url, std::string_view network) {
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(default_port);
  inet_pton(AF_INET, default_address, &group.sin_addr);
  if (network.empty()) return group;
  const std::string address(network.substr(0, network.find(':')));
  const bool is_ip = inet_pton(AF_INET, address.c_str(), &group.sin_addr) == 1;
  if (!is_ip || !IN_MULTICAST(ntohl(group.sin_addr.s_addr))) {
    refuse(url, "address \"" + address + "\"", "a multicast address, 224.0.0.0 to 239.255.255.255");
  }
  if (address.size() < network.size()) {
    const std::string_view port = network.substr(address.size() + 1);
    group.sin_port = htons(static_cast<std::uint16_t>(read_number(url, "port", port, 1, 65535)));
  }
  return group;
}

void read_option(std::string_view url, std::string_view option, UdpmUrl& out) {
  const std::size_t equals = option.find('=');
  const std::string_view name = option.substr(0, equals);
  const std::string_view value =
      equals == std::string_view::npos ? std::string_view() : option.substr(equals + 1);
  if (name == "ttl") {
    out.ttl = read_number(url, name, value, 0, 255);
  } else if (name == "recv_buf_size") {
    out.receive_buffer_bytes = read_number(url, name, value, 1, std::numeric_limits<int>::max());
  } else {
    refuse(url, "option \"" + std::string(option) + "\"", "ttl=0 to 255, recv_buf_size=BYTES");
  }
}

}  // namespace

std::string effective_lcm_url(const std::string& configured, bool receives_images) {
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  std::string url = configured;
  if (url.empty() && from_environment != nullptr) url = from_environment;
  if (url.empty()) url = default_url;

  const std::size_t separator = url.find("://");
  const std::string_view provider = std::string_view(url).substr(0, separator);
  const auto others = other_providers();
  if (separator == std::string::npos ||
      (provider != "udpm" && std::ranges::find(others, provider) == others.end())) {
    std::string allowed = "udpm://ADDRESS:PORT?ttl=N";
    for (const std::string_view one : others) allowed += ", " + std::string(one) + "://";
    refuse(url, "provider \"" + std::string(provider) + "\"", allowed);
  }
  if (provider != "udpm") return url;

  if (receives_images && !parse_udpm_url(url)->receive_buffer_bytes) {
    url += url.find('?') == std::string::npos ? '?' : '&';
    url += buffer_option;
    url += image_buffer_bytes;
  }
  static_cast<void>(parse_udpm_url(url));
  return url;
}

std::optional<UdpmUrl> parse_udpm_url(const std::string& url) {
  constexpr std::string_view prefix = "udpm://";
  if (!url.starts_with(prefix)) return std::nullopt;
  const std::string_view rest = std::string_view(url).substr(prefix.size());
  const std::size_t question = std::min(rest.find('?'), rest.size());
  UdpmUrl out{.group = read_group(url, rest.substr(0, question)),
              .ttl = 0,
              .receive_buffer_bytes = std::nullopt};
  std::string_view options = rest.substr(std::min(question + 1, rest.size()));
  while (!options.empty()) {
    const std::size_t end = std::min(options.find('&'), options.size());
    read_option(url, options.substr(0, end), out);
    options.remove_prefix(std::min(end + 1, options.size()));
  }
  return out;
}

std::string receive_buffer_warning(const std::string& url, const std::string& rmem_max_file) {
  const auto udpm = parse_udpm_url(url);
  const auto requested = udpm ? udpm->receive_buffer_bytes : std::nullopt;
  std::int64_t limit = 0;
  if (!requested || !(std::ifstream(rmem_max_file) >> limit) || limit >= *requested) return {};
  const std::string bytes = std::to_string(*requested);
  return "the kernel gives a receive buffer of at most " + std::to_string(limit) + " bytes, not " +
         bytes + ": camera frames will be lost. As root: sysctl -w net.core.rmem_max=" + bytes;
}

}  // namespace gazed::lcm
