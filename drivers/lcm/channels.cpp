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

Channels::Channels(const LcmSettings& settings) : Channels(settings.prefix) {
  const auto take = [](std::string& channel, const std::string& name) {
    if (!is_channel_name(name)) {
      throw std::invalid_argument("LCM channel \"" + name +
                                  "\" found; allowed: " + std::string(channel_name_rule));
    }
    if (!name.empty()) channel = name;
  };
  take(image, settings.image_channel);
  take(head_state, settings.head_state_channel);
  take(head_command, settings.head_command_channel);
}

}  // namespace gazed::lcm
