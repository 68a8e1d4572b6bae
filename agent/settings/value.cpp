#include "agent/settings/value.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

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

}  // namespace

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
