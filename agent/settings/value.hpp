// What a key of the configuration can be set to, and how it is written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "agent/base/move_only_variant.hpp"
#include "agent/base/toml.hpp"

namespace gazed::settings {

/// Nothing (an optional field that is not set, or something that no key takes), or one of the
/// values that TOML and the fields have in common.
using Value = base::MoveOnlyVariant<std::monostate, bool, std::int64_t, double, std::string,
                                    std::vector<double>>;

/// For a visit of a variant: one function for each of its types.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// Nothing for what no key takes.
[[nodiscard]] Value value_of(const base::TomlNode& node);

/// None for what is no number; a whole one is one.
[[nodiscard]] std::optional<double> as_number(const Value& value);

/// For a message: the value, or what else the node is, "a table".
[[nodiscard]] std::string shown_text(const base::TomlNode& node);

/// A value as TOML: text quoted and escaped, numbers with as many digits as give the same number
/// back. Empty for nothing.
[[nodiscard]] std::string toml_text(const Value& value);

/// A number for a message, a whole one without a point or an exponent: "1048575".
[[nodiscard]] std::string plain_number(double number);

}  // namespace gazed::settings
