#include "drivers/lcm/channels.hpp"

#include <algorithm>
#include <stdexcept>

namespace gazed::lcm {

namespace {

constexpr std::size_t longest_prefix = 40;

const std::string& checked(const std::string& prefix) {
  const auto allowed = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (prefix.empty() || prefix.size() > longest_prefix || !std::ranges::all_of(prefix, allowed)) {
    throw std::invalid_argument("LCM prefix \"" + prefix +
                                "\" found; allowed: 1 to 40 letters, digits and underscores");
  }
  return prefix;
}

}  // namespace

Channels::Channels(const std::string& prefix)
    : image(checked(prefix) + "_IMAGE"),
      head_state(prefix + "_HEAD_STATE"),
      head_command(prefix + "_HEAD_COMMAND"),
      located_point(prefix + "_LOCATED_POINT"),
      fixation(prefix + "_FIXATION"),
      saliency(prefix + "_SALIENCY"),
      status(prefix + "_STATUS"),
      configuration(prefix + "_CONFIGURATION") {}

}  // namespace gazed::lcm
