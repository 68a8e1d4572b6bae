#include "agent/base/strict_toml.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"
#include "agent/base/toml_guard.hpp"

namespace gazed::base {

namespace {

constexpr std::size_t longest_value_shown = 60;
constexpr std::size_t longest_description = 200;

std::string line_of(const std::string& source_name, const toml::source_region& region) {
  return source_name + ":" + std::to_string(region.begin.line) + ": ";
}

/// In one line; numbers with as many digits as give the same number back.
std::string written(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number->get()).ptr;
    return {digits.data(), end};
  }
  if (const toml::array* array = node.as_array()) {
    std::string elements;
    for (const toml::node& element : *array) {
      elements += (elements.empty() ? " " : ", ") + written(element);
      if (elements.size() > longest_value_shown) break;
    }
    return "[" + elements + " ]";
  }
  std::ostringstream text;
  text << toml::node_view<const toml::node>(node);
  return text.str();
}

std::string shown(const toml::node& node) {
  return excerpt(written(node), longest_value_shown);
}

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string shown(NumberRange range) {
  return shown(range.min) + " to " + shown(range.max);
}

/// An integer counts as a number.
std::optional<double> as_number(const toml::node& node, NumberRange range) {
  if (!node.is_number()) return std::nullopt;
  const std::optional<double> value = node.value<double>();
  if (!value || !(*value >= range.min && *value <= range.max)) return std::nullopt;
  return value;
}

}  // namespace

const toml::node* StrictTable::find(std::string_view key) {
  asked_.emplace_back(key);
  return table_->get(key);
}

bool StrictTable::has(std::string_view key) {
  return find(key) != nullptr;
}

std::optional<double> StrictTable::number(std::string_view key, NumberRange range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const std::optional<double> value = as_number(*node, range);
  if (!value) fail(key, "a number, " + shown(range));
  return value;
}

std::optional<std::int64_t> StrictTable::integer(std::string_view key, NumberRange range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_integer() || !as_number(*node, range)) fail(key, "an integer, " + shown(range));
  return node->as_integer()->get();
}

std::optional<bool> StrictTable::boolean(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) fail(key, "true or false");
  return node->as_boolean()->get();
}

std::optional<std::string> StrictTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) fail(key, "a string");
  return node->as_string()->get();
}

std::optional<std::size_t> StrictTable::choice(std::string_view key,
                                               std::span<const std::string_view> names) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (node->is_string()) {
    const auto found = std::find(names.begin(), names.end(), node->as_string()->get());
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  std::string allowed;
  for (const std::string_view name : names) {
    if (!allowed.empty()) allowed += ", ";
    allowed += '"' + std::string(name) + '"';
  }
  fail(key, allowed);
}

bool StrictTable::read_numbers(std::string_view key, NumberRange range, std::span<double> values) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const std::string allowed =
      "an array of " + std::to_string(values.size()) + " numbers, " + shown(range);
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != values.size()) fail(key, allowed);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = as_number(*array->get(i), range);
    if (!value) fail(key, allowed);
    values[i] = *value;
  }
  return true;
}

bool StrictTable::read_matrix(std::string_view key, NumberRange range, std::size_t columns,
                              std::span<double> values) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const std::size_t rows = values.size() / columns;
  const std::string allowed = std::to_string(rows) + " rows, [[...], ...], each of " +
                              std::to_string(columns) + " numbers, " + shown(range);
  const toml::array* matrix = node->as_array();
  if (matrix == nullptr || matrix->size() != rows) fail(key, allowed);
  for (std::size_t row = 0; row < rows; ++row) {
    const toml::array* numbers = matrix->get(row)->as_array();
    if (numbers == nullptr || numbers->size() != columns) fail(key, allowed);
    for (std::size_t column = 0; column < columns; ++column) {
      const std::optional<double> value = as_number(*numbers->get(column), range);
      if (!value) fail(key, allowed);
      values[row * columns + column] = *value;
    }
  }
  return true;
}

std::optional<StrictTable> StrictTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) fail(key, "a table");
  return StrictTable(*node->as_table(), path_ + std::string(key) + ".", source_name_);
}

std::vector<StrictTable> StrictTable::tables(std::string_view key) {
  std::vector<StrictTable> found;
  const toml::node* node = find(key);
  if (node == nullptr) return found;
  const toml::array* array = node->as_array();
  if (array == nullptr) fail(key, "an array of tables, [[" + std::string(key) + "]]");
  for (const toml::node& element : *array) {
    if (!element.is_table()) fail(key, "an array of tables, [[" + std::string(key) + "]]");
    found.emplace_back(*element.as_table(), path_ + std::string(key) + ".", source_name_);
  }
  return found;
}

void StrictTable::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
    Nearest nearest(key.str());
    std::string allowed;
    for (const std::string& name : asked_) {
      nearest.offer(name, name);
      allowed += (allowed.empty() ? "" : ", ") + name;
    }
    throw std::invalid_argument(line_of(source_name_, key.source()) + path_ + excerpt(key.str()) +
                                ": unknown key; the nearest known is " + nearest.result() +
                                "; allowed: " + allowed);
  }
}

std::string StrictTable::place(std::string_view key) const {
  const toml::node* node = table_->get(key);
  const toml::source_region& region = node != nullptr ? node->source() : table_->source();
  return line_of(source_name_, region) + path_ + std::string(key) + ": ";
}

void StrictTable::fail(std::string_view key, const std::string& allowed) const {
  const toml::node* node = table_->get(key);
  throw std::invalid_argument(place(key) + (node != nullptr ? shown(*node) : "nothing") +
                              " found; allowed: " + allowed);
}

std::string read_text(const std::string& file, std::size_t most_bytes) {
  const auto refuse = [&file] {
    return std::invalid_argument(excerpt(file, longest_file_name) +
                                 ": cannot be read: " + std::generic_category().message(errno));
  };
  const auto close = [](std::FILE* stream) { std::fclose(stream); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(std::fopen(file.c_str(), "rb"), close);
  if (!stream) throw refuse();
  std::string text(most_bytes + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stream.get()));
  if (std::ferror(stream.get()) != 0) throw refuse();
  return text;
}

toml::table parse_toml(std::string_view text, const std::string& source_name,
                       std::size_t most_bytes) {
  if (text.size() > most_bytes) {
    throw std::invalid_argument(source_name + ": longer than " + std::to_string(most_bytes) +
                                " bytes");
  }
  if (const std::optional<TomlHazard> hazard = toml_hazard(text)) {
    throw std::invalid_argument(source_name + ":" + std::to_string(hazard->line) +
                                ": not TOML: " + hazard->what);
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(line_of(source_name, error.source()) +
                                "not TOML: " + excerpt(error.description(), longest_description));
  }
}

}  // namespace gazed::base
