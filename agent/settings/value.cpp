#include "agent/settings/value.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "agent/base/text.hpp"

namespace gazed::settings {
namespace {

/// The shortest decimal that reads back as the same number.
std::string digits(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number < 0 ? "-inf" : "inf";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

std::string toml_number(double number) {
  std::string text = digits(number);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // else it is an integer
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// Nothing for an array of anything else.
Value numbers_of(const base::TomlArray& array) {
  std::vector<double> result;
  for (const base::TomlNode& element : array) {
    if (const auto* number = std::get_if<double>(&element.value))
      result.push_back(*number);
    else if (const auto* whole = std::get_if<std::int64_t>(&element.value))
      result.push_back(static_cast<double>(*whole));
    else
      return {};
  }
  return result;
}

}  // namespace

Value value_of(const base::TomlNode& node) {
  return std::visit(Overloaded{[](const base::TomlArray& array) { return numbers_of(array); },
                               [](const base::TomlTable&) { return Value(); },
                               [](const auto& found) { return Value(found); }},
                    node.value);
}

std::optional<double> as_number(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

std::string shown_text(const base::TomlNode& node) {
  std::string text = base::excerpt(toml_text(value_of(node)));
  if (!text.empty()) return text;
  if (std::holds_alternative<base::TomlTable>(node.value)) return "a table";
  return std::holds_alternative<base::TomlArray>(node.value) ? "an array" : "a date or time";
}

std::string plain_number(double number) {
  const bool whole = std::abs(number) < 1e15 && number == std::trunc(number);
  return whole ? std::to_string(static_cast<std::int64_t>(number)) : digits(number);
}

std::string toml_text(const Value& value) {
  return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                               [](bool found) { return std::string(found ? "true" : "false"); },
                               [](std::int64_t found) { return std::to_string(found); },
                               [](double found) { return toml_number(found); },
                               [](const std::string& found) { return '"' + escaped(found) + '"'; },
                               [](const std::vector<double>& found) {
                                 std::string text;
                                 for (const double number : found) {
                                   text += (text.empty() ? "" : ", ") + toml_number(number);
                                 }
                                 return '[' + text + ']';
                               }},
                    value);
}

}  // namespace gazed::settings
