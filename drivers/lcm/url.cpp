#include "drivers/lcm/url.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace gazed::lcm {

namespace {

constexpr std::string_view default_url = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::string_view option_name = "recv_buf_size=";
constexpr std::string_view image_buffer_bytes = "4000000";
constexpr std::array<std::string_view, 5> providers = {"udpm", "mpudpm", "tcpq", "memq", "file"};

[[noreturn]] void refuse(std::string_view url, std::string_view found, std::string_view allowed) {
  throw std::invalid_argument("LCM URL \"" + std::string(url) + "\": " + std::string(found) +
                              " found; allowed: " + std::string(allowed));
}

// The udpm network: "", "ADDRESS" or "ADDRESS:PORT"; what is left out has LCM's default.
void check_multicast_address(std::string_view url, std::string_view network) {
  const std::string address(network.substr(0, network.find(':')));
  in_addr ip{};
  const bool is_ip = inet_pton(AF_INET, address.c_str(), &ip) == 1;
  if (!network.empty() && (!is_ip || !IN_MULTICAST(ntohl(ip.s_addr)))) {
    refuse(url, "address \"" + address + "\"", "a multicast address, 224.0.0.0 to 239.255.255.255");
  }
  if (address.size() == network.size()) return;
  const std::string_view port = network.substr(address.size() + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc{} || end != port.data() + port.size() || number < 1 || number > 65535) {
    refuse(url, "port \"" + std::string(port) + "\"", "1 to 65535");
  }
}

std::optional<std::int64_t> requested_buffer_bytes(std::string_view url) {
  const std::size_t option = url.find(option_name);
  if (option == std::string_view::npos) return std::nullopt;
  const std::string_view value = url.substr(option + option_name.size());
  std::int64_t bytes = 0;
  if (std::from_chars(value.data(), value.data() + value.size(), bytes).ec != std::errc{}) {
    return std::nullopt;
  }
  return bytes;
}

}  // namespace

std::string effective_lcm_url(const std::string& configured, bool receives_images) {
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  std::string url = configured;
  if (url.empty() && from_environment != nullptr) url = from_environment;
  if (url.empty()) url = default_url;

  const std::size_t separator = url.find("://");
  const std::string_view provider = std::string_view(url).substr(0, separator);
  if (separator == std::string::npos || std::ranges::find(providers, provider) == providers.end()) {
    refuse(url, "provider \"" + std::string(provider) + "\"",
           "udpm://ADDRESS:PORT?ttl=N, mpudpm://, tcpq://, memq://, file://");
  }
  if (provider != "udpm") return url;

  const std::size_t network = separator + 3;
  const std::size_t options = url.find('?', network);
  check_multicast_address(url, std::string_view(url).substr(network, options - network));
  if (receives_images && url.find(option_name) == std::string::npos) {
    url += options == std::string::npos ? '?' : '&';
    url += option_name;
    url += image_buffer_bytes;
  }
  return url;
}

std::string receive_buffer_warning(const std::string& url, const std::string& rmem_max_file) {
  const std::optional<std::int64_t> requested = requested_buffer_bytes(url);
  std::int64_t limit = 0;
  if (!requested || !(std::ifstream(rmem_max_file) >> limit) || limit >= *requested) return {};
  const std::string bytes = std::to_string(*requested);
  return "the kernel gives a receive buffer of at most " + std::to_string(limit) + " bytes, not " +
         bytes + ": camera frames will be lost. As root: sysctl -w net.core.rmem_max=" + bytes;
}

}  // namespace gazed::lcm
