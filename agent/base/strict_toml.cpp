#include "agent/base/strict_toml.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <variant>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"
#include "agent/base/trailing_zeros.hpp"

namespace gazed::base {

namespace {

constexpr std::size_t longest_value_shown = 60;

/// With as many digits as give the same number back.
std::string written(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string written(const TomlNode& node);

/// As much as is shown.
std::string written(const TomlArray& array) {
  std::string elements;
  for (const TomlNode& element : array) {
    elements += (elements.empty() ? " " : ", ") + written(element);
    if (elements.size() > longest_value_shown) break;
  }
  return "[" + elements + " ]";
}

struct Written {
  std::string operator()(std::monostate) const { return "a date or time"; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t whole) const { return std::to_string(whole); }
  std::string operator()(double number) const { return written(number); }
  std::string operator()(const std::string& text) const { return "'" + text + "'"; }
  std::string operator()(const TomlArray& array) const { return written(array); }
  std::string operator()(const TomlTable&) const { return "a table"; }
};

std::string written(const TomlNode& node) {
  return std::visit(Written{}, node.value);
}

std::string shown(const TomlNode& node) {
  return excerpt(written(node), longest_value_shown);
}

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string shown(Range range) {
  return shown(range.min) + " to " + shown(range.max);
}

/// An integer counts as a number.
std::optional<double> as_number(const TomlNode& node, Range range) {
  std::optional<double> value;
  if (const auto* number = std::get_if<double>(&node.value)) value = *number;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value))
    value = static_cast<double>(*whole);
  if (value && !range.contains(*value)) value.reset();
  return value;
}

/// False when it is no array of as many numbers.
bool read_array(const TomlNode& node, Range range, std::span<double> values) {
  const auto* array = std::get_if<TomlArray>(&node.value);
  if (array == nullptr || array->size() != values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = as_number((*array)[i], range);
    if (!value) return false;
    values[i] = *value;
  }
  return true;
}

}  // namespace

const TomlNode* StrictTable::find(std::string_view key) {
  if (std::ranges::find(asked_, key) == asked_.end()) asked_.emplace_back(key);
  const TomlMember* member = find_member(*table_, key);
  return member == nullptr ? nullptr : &member->node;
}

bool StrictTable::has(std::string_view key) {
  return find(key) != nullptr;
}

std::optional<double> StrictTable::number(std::string_view key, Range range) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<double> value = as_number(*node, range);
  if (!value) fail(key, "a number, " + shown(range));
  return value;
}

std::optional<std::int64_t> StrictTable::integer(std::string_view key, Range range) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* whole = std::get_if<std::int64_t>(&node->value); whole && as_number(*node, range))
    return *whole;
  fail(key, "an integer, " + shown(range));
  return std::nullopt;
}

std::optional<bool> StrictTable::boolean(std::string_view key) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* flag = std::get_if<bool>(&node->value)) return *flag;
  fail(key, "true or false");
  return std::nullopt;
}

std::optional<std::string> StrictTable::text(std::string_view key) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* text = std::get_if<std::string>(&node->value)) return *text;
  fail(key, "a string");
  return std::nullopt;
}

std::optional<std::size_t> StrictTable::choice(std::string_view key,
                                               std::span<const std::string_view> names) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* text = std::get_if<std::string>(&node->value)) {
    const auto found = std::ranges::find(names, *text);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  std::string allowed;
  for (const std::string_view name : names) {
    if (!allowed.empty()) allowed += ", ";
    allowed += '"' + std::string(name) + '"';
  }
  fail(key, allowed);
  return std::nullopt;
}

bool StrictTable::read_numbers(std::string_view key, Range range, std::string_view allowed,
                               std::span<double> values) {
  const TomlNode* node = find(key);
  if (node == nullptr) return false;
  if (read_array(*node, range, values)) return true;
  fail(key, "an array of " + std::to_string(values.size()) + " numbers, " +
                (allowed.empty() ? shown(range) : std::string(allowed)));
  return false;
}

bool StrictTable::read_numbers_and_zeros(std::string_view key, Range range, std::size_t fewest,
                                         std::string_view allowed, std::span<double> values) {
  const TomlNode* node = find(key);
  if (node == nullptr) return false;
  const auto* array = std::get_if<TomlArray>(&node->value);
  std::vector<double> found(array == nullptr ? 0 : array->size());
  if (read_array(*node, range, found) && assign_with_zeros(found, fewest, values)) return true;
  fail(key, std::string(allowed));
  return false;
}

bool StrictTable::read_matrix(std::string_view key, Range range, std::size_t columns,
                              std::span<double> values) {
  const TomlNode* node = find(key);
  if (node == nullptr) return false;
  const std::size_t rows = values.size() / columns;
  const auto* matrix = std::get_if<TomlArray>(&node->value);
  bool is_read = matrix != nullptr && matrix->size() == rows;
  for (std::size_t row = 0; is_read && row < rows; ++row)
    is_read = read_array((*matrix)[row], range, values.subspan(row * columns, columns));
  if (!is_read) {
    fail(key, std::to_string(rows) + " rows, [[...], ...], each of " + std::to_string(columns) +
                  " numbers, " + shown(range));
  }
  return is_read;
}

std::optional<StrictTable> StrictTable::table(std::string_view key) {
  const TomlNode* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* table = std::get_if<TomlTable>(&node->value))
    return StrictTable(*document_, *table, node->place, path_ + std::string(key) + ".");
  fail(key, "a table");
  return std::nullopt;
}

std::vector<StrictTable> StrictTable::tables(std::string_view key) {
  std::vector<StrictTable> found;
  const TomlNode* node = find(key);
  if (node == nullptr) return found;
  const std::string allowed = "an array of tables, [[" + std::string(key) + "]]";
  const auto* array = std::get_if<TomlArray>(&node->value);
  if (array == nullptr) {
    fail(key, allowed);
    return found;
  }
  for (const TomlNode& element : *array) {
    if (const auto* table = std::get_if<TomlTable>(&element.value))
      found.push_back({*document_, *table, element.place, path_ + std::string(key) + "."});
    else
      fail(key, allowed);
  }
  return found;
}

void StrictTable::finish() {
  for (const TomlMember& member : *table_) {
    if (std::ranges::find(asked_, member.name) != asked_.end()) continue;
    Nearest nearest(member.name);
    std::string allowed;
    for (const std::string& name : asked_) {
      nearest.offer(name, name);
      allowed += (allowed.empty() ? "" : ", ") + name;
    }
    document_->refuse(member.name_place, path_ + excerpt(member.name) + ": unknown key" +
                                             nearest.clause() + "; allowed: " + allowed);
  }
}

TextPlace StrictTable::place_of(std::string_view key) const {
  const TomlMember* member = find_member(*table_, key);
  return member == nullptr ? place_ : member->node.place;
}

std::string StrictTable::place(std::string_view key) const {
  return document_->source().line_name(place_of(key)) + ": " + path_ + std::string(key) + ": ";
}

void StrictTable::fail(std::string_view key, const std::string& allowed) {
  const TomlMember* member = find_member(*table_, key);
  refuse(key,
         (member == nullptr ? "nothing" : shown(member->node)) + " found; allowed: " + allowed);
}

void StrictTable::refuse(std::string_view key, const std::string& why) {
  if (std::ranges::find(refused_, key) != refused_.end()) return;
  refused_.emplace_back(key);
  document_->refuse(place_of(key), path_ + std::string(key) + ": " + why);
}

}  // namespace gazed::base
