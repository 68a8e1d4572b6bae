// In place of liblcm_connection.cpp, in programs that do without liblcm.
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "drivers/lcm/other_providers.hpp"

namespace gazed::lcm {

std::span<const std::string_view> other_providers() {
  return {};
}

std::unique_ptr<Connection> open_other_provider(const std::string& /*url*/,
                                                Subscriptions& /*subscriptions*/) {
  return nullptr;
}

}  // namespace gazed::lcm
