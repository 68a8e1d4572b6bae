// LCM's providers beside udpm: mpudpm, tcpq, memq and file, for workstations, as liblcm has them.
//
// A robot needs none of them, and does without liblcm and GLib: there without_liblcm.cpp stands in
// for liblcm_connection.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "drivers/lcm/connection.hpp"

namespace gazed::lcm {

/// Their names; none where this program does without liblcm.
[[nodiscard]] std::span<const std::string_view> other_providers();

/// None where liblcm cannot connect. `subscriptions` must outlive the connection.
[[nodiscard]] std::unique_ptr<Connection> open_other_provider(const std::string& url,
                                                              Subscriptions& subscriptions);

}  // namespace gazed::lcm
