#include "agent/settings/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"
#include "agent/base/toml.hpp"
#include "agent/base/trailing_zeros.hpp"

namespace gazed::settings {
namespace {

bool in_range(const Key& key, double number) {
  return std::get<Range>(key.allowed).contains(number);
}

std::string_view flag_word(bool flag) {
  return flag ? "true" : "false";
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
    if (found == nullptr || (fields.fewest == 0 && found->size() != fields.count)) return false;
    if (!std::ranges::all_of(*found, [this](double n) { return in_range(key, n); })) return false;
    std::array<double, std::tuple_size_v<decltype(fields.at)>> numbers{};
    const auto own = std::span(numbers).first(fields.count);
    if (!base::assign_with_zeros(*found, fields.fewest, own)) return false;
    for (std::size_t i = 0; i < fields.count; ++i) *fields.at[i] = numbers[i];
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
    const auto* flag = std::get_if<bool>(&value);
    if (found == nullptr && flag == nullptr) return false;
    const Choices choices = std::get<Choices>(key.allowed);
    const std::string_view word = found != nullptr ? std::string_view(*found) : flag_word(*flag);
    const auto choice = std::ranges::find(choices, word);
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
    const std::string_view word = std::get<Choices>(key.allowed)[static_cast<std::size_t>(*field)];
    if (word == flag_word(true)) return true;
    if (word == flag_word(false)) return false;
    return std::string(word);
  }
};

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

/// A value, and how a message shows it.
struct ShownValue {
  Value value;
  std::string text;
};

ShownValue shown(Value value) {
  std::string text = base::excerpt(toml_text(value));
  return {std::move(value), std::move(text)};
}

/// A value as in TOML. Text without quotes is text, where the key takes text and where it is
/// nothing else.
ShownValue value_from_toml(const Key& key, const Assignment& assignment) {
  const std::string& text = assignment.text;
  if (!base::is_printable(text) || (takes_text(key) && !is_quoted(text))) return shown(text);
  try {
    const base::TomlDocument document(assignment.key + " = " + text, assignment.where,
                                      base::longest_written_toml);
    const base::TomlNode* node = &document.root().front().node;
    for (auto tables = std::ranges::count(assignment.key, '.'); tables > 0; --tables)
      node = &std::get<base::TomlTable>(node->value).front().node;
    return {value_of(*node), shown_text(*node)};
  } catch (const std::invalid_argument& error) {
    if (takes_text(key)) throw SettingsError(error.what());
    return shown(text);
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
  // A key in another table than its own is that key, whatever table is spelt like the one written.
  const std::string_view last = path.substr(path.rfind('.') + 1);
  const auto same = std::ranges::find(all_keys(), last, &Key::name);
  if (same != all_keys().end()) return std::string(same->path);
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
    throw SettingsError(where + ": " + base::excerpt(path) + ": unknown key" +
                        base::nearest_clause(nearest_key(path)));
  }
  auto [value, shown_value] = written == Written::as_toml ? value_from_toml(*key, assignment)
                                                          : shown(value_from_text(*key, text));
  return {key, std::move(value), std::move(shown_value), where};
}

bool is_allowed(const Key& key, const Value& value) {
  Settings scratch;
  return std::visit(Writer{key, value}, key.slot(scratch));
}

void assign(Settings& settings, const Entry& entry) {
  if (std::visit(Writer{*entry.key, entry.value}, entry.key->slot(settings))) return;
  throw SettingsError(entry.where + ": " + refusal(entry) + entry.excerpt);
}

Value read(Settings settings, const Key& key) {
  return std::visit(Reader{key}, key.slot(settings));
}

}  // namespace gazed::settings
