// What a key allows, in words, and why a value is not allowed.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/settings/table.hpp"

namespace gazed::settings {
namespace {

/// Of a lens, the only list that programs write with more or fewer numbers.
constexpr std::string_view rule_of_zeros =
    " (the last one may be missing, zeros may follow; the rational model is not gazed's: calibrate "
    "with 5)";

bool takes_integer(const Key& key) {
  Settings settings;
  const Slot slot = key.slot(settings);
  return std::holds_alternative<int*>(slot) || std::holds_alternative<std::uint32_t*>(slot) ||
         std::holds_alternative<std::optional<int>*>(slot);
}

/// The numbers that a key takes as an array; none of them for a key that takes no array.
Numbers list_of(const Key& key) {
  Settings settings;
  const Slot slot = key.slot(settings);
  const auto* numbers = std::get_if<Numbers>(&slot);
  return numbers == nullptr ? Numbers{} : *numbers;
}

/// What `value` should have been, when its type is wrong and the allowed values do not show it.
std::string_view missing_type(const Key& key, const Value& value) {
  if (!std::holds_alternative<Range>(key.allowed) || list_of(key).count > 0) return "";
  if (takes_integer(key)) return std::holds_alternative<std::int64_t>(value) ? "" : "an integer, ";
  return as_number(value) ? "" : "a number, ";
}

/// A unit that people write a quantity in, where gazed has another.
struct OtherUnit {
  std::string_view unit;  // gazed's
  double factor;          // from theirs
  std::string_view question;
};
constexpr std::array other_units{
    OtherUnit{"rad", std::numbers::pi / 180.0, "degrees? in radians"},
    OtherUnit{"rad/s", std::numbers::pi / 180.0, "degrees a second? in radians a second"},
    OtherUnit{"m", 1e-3, "millimetres? in metres"},
    OtherUnit{"s", 1e-3, "milliseconds? in seconds"},
};

/// "; degrees? in radians it is 0.0698" where that would be allowed.
std::string guess_at_unit(const Key& key, const Value& value) {
  const auto other = std::ranges::find(other_units, key.unit, &OtherUnit::unit);
  if (other == other_units.end()) return {};
  std::vector<double> numbers;
  const std::optional<double> one = as_number(value);
  if (one) numbers = {*one};
  if (const auto* list = std::get_if<std::vector<double>>(&value)) numbers = *list;
  std::string shown;
  for (double& number : numbers) {
    number *= other->factor;
    shown += (shown.empty() ? "" : ", ") + base::text("%.4g", number);
  }
  if (!is_allowed(key, one ? Value(numbers.front()) : Value(numbers))) return {};
  return "; " + std::string(other->question) +
         (one ? " it is " + shown : " they are [" + shown + "]");
}

/// "; the nearest is v4l2:/dev/video0" for a device's file, and the like for a log's.
std::string guess_at_source(const Key& key, const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || !std::holds_alternative<drivers::Part>(key.allowed)) return {};
  for (const char* driver : {"v4l2:", "log:"}) {
    const bool is_its_file =
        driver[0] == 'v' ? text->starts_with("/dev/") : text->ends_with(".lcm");
    if (is_its_file && is_allowed(key, driver + *text)) {
      return "; the nearest is " + (driver + *text);
    }
  }
  return {};
}

/// " K" where the key's name does not end in its unit.
std::string unit_after(const Key& key) {
  std::string ending = "_" + std::string(key.unit);
  std::ranges::replace(ending, '/', '_');
  return key.unit.empty() || key.name().ends_with(ending) ? "" : " " + std::string(key.unit);
}

}  // namespace

std::string refusal(const Entry& entry) {
  const Key& key = *entry.key;
  if (is_allowed(key, entry.value)) return "";
  std::string message(key.path);
  message.append(": ").append(entry.text).append(" found; allowed: ");
  message.append(missing_type(key, entry.value)).append(allowed_text(key));
  message.append(unit_after(key)).append(guess_at_unit(key, entry.value));
  return message.append(guess_at_source(key, entry.value));
}

std::string allowed_text(const Key& key) {
  const auto range_text = [](const Range& range) {
    if (range.min == range.max) return plain_number(range.min);
    return plain_number(range.min) + " to " + plain_number(range.max);
  };
  const Numbers list = list_of(key);
  const std::size_t count = list.count, fewest = list.fewest;
  return std::visit(Overloaded{[](std::monostate) { return std::string("true or false"); },
                               [&](const Range& range) {
                                 if (count == 0) return range_text(range);
                                 std::string text =
                                     std::to_string(count) + " numbers, each " + range_text(range);
                                 return text + (fewest > 0 ? std::string(rule_of_zeros) : "");
                               },
                               [](const Choices& choices) { return base::listed(choices); },
                               [](const TextRule& rule) { return std::string(rule.allowed); },
                               [](drivers::Part part) { return drivers::allowed_sources(part); }},
                    key.allowed);
}

}  // namespace gazed::settings
