#include "agent/settings/table.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <utility>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"
#include "agent/base/toml.hpp"

namespace gazed::settings {
namespace {

std::string join(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

bool in_range(const Key& key, double number) {
  return std::get<Range>(key.allowed).contains(number);
}

std::optional<double> as_number(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

/// Writes `value` through one kind of slot; false when it is of the wrong type or not allowed.
struct Writer {
  const Key& key;
  const Value& value;

  bool operator()(bool* field) const {
    const auto* found = std::get_if<bool>(&value);
    if (found != nullptr) *field = *found;
    return found != nullptr;
  }

  bool operator()(double* field) const {
    const std::optional<double> found = as_number(value);
    if (!found || !in_range(key, *found)) return false;
    *field = *found;
    return true;
  }

  bool operator()(std::string* field) const {
    const auto* found = std::get_if<std::string>(&value);
    if (found == nullptr || !base::is_printable(*found)) return false;
    if (const auto* choices = std::get_if<Choices>(&key.allowed)) {
      if (std::ranges::find(*choices, *found) == choices->end()) return false;
    } else if (!std::get<TextRule>(key.allowed).accepts(*found)) {
      return false;
    }
    *field = *found;
    return true;
  }

  bool operator()(drivers::Source* field) const {
    const auto* found = std::get_if<std::string>(&value);
    if (found == nullptr || !base::is_printable(*found)) return false;
    const auto source = drivers::Source::parse(std::get<drivers::Part>(key.allowed), *found);
    if (source) *field = *source;
    return source.has_value();
  }

  bool operator()(const Numbers& fields) const {
    const auto* found = std::get_if<std::vector<double>>(&value);
    if (found == nullptr || found->size() != fields.count) return false;
    if (!std::ranges::all_of(*found, [this](double n) { return in_range(key, n); })) return false;
    for (std::size_t i = 0; i < fields.count; ++i) *fields.at[i] = (*found)[i];
    return true;
  }

  template <class T>
  bool operator()(std::optional<T>* field) const {
    T found{};
    if (!(*this)(&found)) return false;
    *field = found;
    return true;
  }

  template <class Integer>
  requires std::is_integral_v<Integer>
  bool operator()(Integer* field) const {
    const auto* found = std::get_if<std::int64_t>(&value);
    if (found == nullptr || !in_range(key, static_cast<double>(*found))) return false;
    *field = static_cast<Integer>(*found);
    return true;
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  bool operator()(Enum* field) const {
    const auto* found = std::get_if<std::string>(&value);
    if (found == nullptr) return false;
    const Choices choices = std::get<Choices>(key.allowed);
    const auto choice = std::ranges::find(choices, *found);
    if (choice == choices.end()) return false;
    *field = static_cast<Enum>(choice - choices.begin());
    return true;
  }
};

/// Reads through one kind of slot.
struct Reader {
  const Key& key;

  Value operator()(const bool* field) const { return *field; }
  Value operator()(const double* field) const { return *field; }
  Value operator()(const std::string* field) const { return *field; }
  Value operator()(const drivers::Source* field) const { return field->text(); }

  Value operator()(const Numbers& fields) const {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < fields.count; ++i) numbers.push_back(*fields.at[i]);
    return numbers;
  }

  template <class T>
  Value operator()(const std::optional<T>* field) const {
    return *field ? (*this)(&**field) : Value{};
  }

  template <class Integer>
  requires std::is_integral_v<Integer> Value operator()(const Integer* field) const {
    return static_cast<std::int64_t>(*field);
  }

  template <class Enum>
  requires std::is_enum_v<Enum> Value operator()(const Enum* field) const {
    return std::string(std::get<Choices>(key.allowed)[static_cast<std::size_t>(*field)]);
  }
};

bool takes_integer(const Key& key) {
  Settings settings;
  const Slot slot = key.slot(settings);
  return std::holds_alternative<int*>(slot) || std::holds_alternative<std::uint32_t*>(slot) ||
         std::holds_alternative<std::optional<int>*>(slot);
}

/// How many numbers a key takes as an array; 0 for a key that takes none.
std::size_t list_length(const Key& key) {
  Settings settings;
  const Slot slot = key.slot(settings);
  const auto* numbers = std::get_if<Numbers>(&slot);
  return numbers == nullptr ? 0 : numbers->count;
}

/// What `value` should have been, when its type is wrong and the allowed values do not show it.
std::string_view missing_type(const Key& key, const Value& value) {
  if (!std::holds_alternative<Range>(key.allowed) || list_length(key) > 0) return "";
  if (takes_integer(key)) return std::holds_alternative<std::int64_t>(value) ? "" : "an integer, ";
  return as_number(value) ? "" : "a number, ";
}

bool takes_text(const Key& key) {
  return std::holds_alternative<Choices>(key.allowed) ||
         std::holds_alternative<TextRule>(key.allowed);
}

/// Text from outside a file: a whole number where a number is wanted and it reads as one, else text
/// as it is.
Value value_from_text(const Key& key, const std::string& text) {
  std::int64_t whole = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, whole);
  const bool is_whole = error == std::errc{} && stop == end;
  if (is_whole && std::holds_alternative<Range>(key.allowed)) return whole;
  return text;
}

bool is_quoted(std::string_view text) {
  return text.starts_with('"') || text.starts_with('\'');
}

/// A value as in TOML. Text without quotes is text, where the key takes text and where it is
/// nothing else.
base::TomlNode node_from_toml(const Key& key, const Assignment& assignment) {
  const std::string& text = assignment.text;
  if (!base::is_printable(text) || (takes_text(key) && !is_quoted(text))) return {text, {}};
  try {
    const base::TomlDocument document(assignment.key + " = " + text, assignment.where,
                                      base::longest_written_toml);
    const base::TomlNode* node = &document.root().front().node;
    for (auto tables = std::ranges::count(assignment.key, '.'); tables > 0; --tables)
      node = &std::get<base::TomlTable>(node->value).front().node;
    return *node;
  } catch (const std::invalid_argument& error) {
    if (takes_text(key)) throw SettingsError(error.what());
    return {text, {}};
  }
}

}  // namespace

std::string_view Key::table() const {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

std::string_view Key::name() const {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

const Key* find_key(std::string_view path) {
  const auto key = std::ranges::find(all_keys(), path, &Key::path);
  return key == all_keys().end() ? nullptr : &*key;
}

bool is_table(std::string_view path) {
  return std::ranges::any_of(all_keys(), [path](const Key& key) {
    return key.path.starts_with(path) && key.path.substr(path.size()).starts_with('.');
  });
}

std::string nearest_key(std::string_view path) {
  base::Nearest nearest(path);
  for (const Key& key : all_keys()) {
    nearest.offer(key.path, key.path);
    nearest.offer(key.name(), key.path);
  }
  return nearest.result();
}

std::string nearest_table(std::string_view path) {
  base::Nearest nearest(path);
  for (const Key& key : all_keys()) nearest.offer(key.table(), key.table());
  return nearest.result();
}

Entry entry_of(const Assignment& assignment) {
  const auto& [path, text, where, written] = assignment;
  const Key* key = find_key(path);
  if (key == nullptr) {
    throw SettingsError(where + ": " + base::excerpt(path) +
                        ": unknown key; the nearest known is " + nearest_key(path));
  }
  if (written == Written::as_toml) {
    const base::TomlNode node = node_from_toml(*key, assignment);
    return {key, value_of(node), shown_text(node), where};
  }
  Value value = value_from_text(*key, text);
  std::string shown = base::excerpt(toml_text(value));
  return {key, std::move(value), std::move(shown), where};
}

std::string refusal(const Entry& entry) {
  Settings scratch;
  const Key& key = *entry.key;
  if (std::visit(Writer{key, entry.value}, key.slot(scratch))) return "";
  std::string message(key.path);
  message.append(": ").append(entry.text).append(" found; allowed: ");
  return message.append(missing_type(key, entry.value)).append(allowed_text(key));
}

void assign(Settings& settings, const Entry& entry) {
  if (std::visit(Writer{*entry.key, entry.value}, entry.key->slot(settings))) return;
  throw SettingsError(entry.where + ": " + refusal(entry) + entry.excerpt);
}

Value read(Settings settings, const Key& key) {
  return std::visit(Reader{key}, key.slot(settings));
}

std::string allowed_text(const Key& key) {
  const auto range_text = [](const Range& range) {
    if (range.min == range.max) return plain_number(range.min);
    return plain_number(range.min) + " to " + plain_number(range.max);
  };
  const std::size_t count = list_length(key);
  return std::visit(Overloaded{[](std::monostate) { return std::string("true or false"); },
                               [&](const Range& range) {
                                 if (count == 0) return range_text(range);
                                 return std::to_string(count) + " numbers, each " +
                                        range_text(range);
                               },
                               [](const Choices& choices) { return join(choices); },
                               [](const TextRule& rule) { return std::string(rule.allowed); },
                               [](drivers::Part part) { return drivers::allowed_sources(part); }},
                    key.allowed);
}

}  // namespace gazed::settings
