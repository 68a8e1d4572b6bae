#include "agent/base/endpoint.hpp"

#include <arpa/inet.h>
#include <charconv>
#include <system_error>

#include "agent/base/text.hpp"

namespace gazed::base {

namespace {

std::optional<std::uint16_t> parse_port(std::string_view digits) {
  std::uint16_t port = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, port);
  if (error != std::errc() || stop != end || port == 0) return std::nullopt;
  return port;
}

}  // namespace

std::optional<Endpoint> parse_endpoint(std::string_view text, std::uint16_t default_port) {
  const std::size_t colon = text.find(':');
  std::string host(text.substr(0, colon));
  if (host == "localhost") host = "127.0.0.1";
  in_addr address{};
  if (inet_pton(AF_INET, host.c_str(), &address) != 1) return std::nullopt;
  const auto port = colon == std::string_view::npos ? std::optional(default_port)
                                                    : parse_port(text.substr(colon + 1));
  if (!port) return std::nullopt;
  return Endpoint{ntohl(address.s_addr), *port};
}

std::string to_string(const Endpoint& endpoint) {
  return text("%u.%u.%u.%u:%u", endpoint.address >> 24, endpoint.address >> 16 & 0xff,
              endpoint.address >> 8 & 0xff, endpoint.address & 0xff, endpoint.port);
}

}  // namespace gazed::base
