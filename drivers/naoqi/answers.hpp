// What a robot answers before its services can be used, and what is in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "agent/endpoint.hpp"
#include "drivers/naoqi/value.hpp"

namespace gazed {

/// "{sm}", to an authentication: true when it is done, false when the robot wants more, or other.
[[nodiscard]] bool authentication_is_done(const QiValue& answer);

/// Where a service lives.
struct QiPlace {
  std::uint32_t service = 0;
  Endpoint endpoint;
};
inline constexpr std::string_view qi_service_info = "(sIsI[s]s)";
/// `answer` has the signature above; what may follow is left. Of the service's addresses the one
/// that was `reached` already, else the first that can be; or why there is none.
[[nodiscard]] std::variant<QiPlace, std::string> place_in(const QiValue& answer,
                                                          const Endpoint& reached);

/// A method as it is asked for.
struct QiMethod {
  std::string_view name, parameters;  // "getAngles", "(mb)"
  bool required = true;               // without it the service is of no use
};
/// And as the robot has it, if it has it.
struct QiFoundMethod {
  std::uint32_t action = 0;
  std::string returns;
};
/// `meta_object` begins with the methods; what follows is left. `found` has a place for each of
/// `methods`. False when it cannot be understood.
[[nodiscard]] bool find_methods(QiBytes meta_object, std::span<const QiMethod> methods,
                                std::span<std::optional<QiFoundMethod>> found);

}  // namespace gazed
