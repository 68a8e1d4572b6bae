#include "agent/base/toml_parser.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "agent/base/text.hpp"
#include "agent/base/toml_guard.hpp"

// toml++ takes for granted what some texts break, "[$x]", "[}" and "1979-05-27 x" among them: an
// assertion, which without assertions clang is told to rely on. Here it is an exception, in every
// build.
namespace gazed::base {
struct BrokenAssertion {};
constexpr void assert_or_throw(bool holds) {
  if (!holds) throw BrokenAssertion();
}
}  // namespace gazed::base
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(holds) gazed::base::assert_or_throw(static_cast<bool>(holds))
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace gazed::base {

namespace {

constexpr std::size_t longest_description = 200;

TextPlace place_of(const SourceText& source, const toml::source_region& region) {
  const toml::source_position& begin = region.begin;
  const toml::source_position& end = region.end;
  TextPlace place{begin.line, begin.column, 1};
  if (end.line == begin.line && end.column > begin.column) {
    place.length = end.column - begin.column;
  } else if (end.line > begin.line) {  // to the end of its first line, without a comment
    const std::string_view line = source.line(begin.line);
    const std::string_view shown = line.substr(0, line.find('#'));
    const std::size_t last = shown.find_last_not_of(" \t");
    if (last != std::string_view::npos && last >= begin.column)
      place.length = last + 2 - begin.column;
  }
  return place;
}

TomlNode node_of(const SourceText& source, const toml::node& node);

TomlTable table_of(const SourceText& source, const toml::table& table) {
  TomlTable members;
  for (const auto& [name, node] : table) {
    TomlMember member{std::string(name.str()), place_of(source, name.source()),
                      node_of(source, node)};
    const bool has_header = member.node.place < member.name_place;
    if (has_header) member.node.place = member.name_place;
    members.push_back(std::move(member));
  }
  std::ranges::sort(members, {}, &TomlMember::name_place);
  return members;
}

TomlNode node_of(const SourceText& source, const toml::node& node) {
  TomlNode result{{}, place_of(source, node.source())};
  if (const auto* flag = node.as_boolean()) result.value = flag->get();
  if (const auto* whole = node.as_integer()) result.value = whole->get();
  if (const auto* number = node.as_floating_point()) result.value = number->get();
  if (const auto* text = node.as_string()) result.value = text->get();
  if (const auto* table = node.as_table()) result.value = table_of(source, *table);
  if (const auto* array = node.as_array()) {
    TomlArray elements;
    for (const toml::node& element : *array) elements.push_back(node_of(source, element));
    result.value = std::move(elements);
  }
  return result;
}

std::string not_toml(const SourceText& source, const TextPlace& place, const std::string& what) {
  return source.line_name(place) + ": not TOML: " + what;
}

std::string shown_not_toml(const SourceText& source, const TextPlace& place,
                           const std::string& what) {
  return not_toml(source, place, what) + source.excerpt_at(place);
}

bool breaks_assertion(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
    return false;
  } catch (const toml::parse_error&) {
    return false;
  } catch (const BrokenAssertion&) {
    return true;
  }
}

/// The character on which an assertion breaks: the last of the shortest text that breaks it.
TextPlace broken_at(const SourceText& source) {
  const std::string_view text = source.text();
  std::size_t good = 0;
  std::size_t bad = text.size();
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    (breaks_assertion(text.substr(0, middle)) ? bad : good) = middle;
  }
  const std::string_view before = text.substr(0, good);
  const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
  const std::size_t line_begin = before.rfind('\n') + 1;  // 0 when there is none
  return {line, characters_of(before.substr(line_begin)) + 1, 1};
}

/// Throws toml::parse_error, and std::invalid_argument for what toml++ must not be given.
TomlTable tree_of(const SourceText& source) {
  if (const std::optional<TomlHazard> hazard = toml_hazard(source.text()))
    throw std::invalid_argument(shown_not_toml(source, *hazard, hazard->what));
  try {
    return table_of(source, toml::parse(source.text()));
  } catch (const BrokenAssertion&) {
    throw std::invalid_argument(
        shown_not_toml(source, broken_at(source), "this cannot stand here"));
  }
}

/// A string that nothing ends and that begins on the line of `place`, or before it.
std::optional<TextPlace> unclosed_string(const SourceText& source, const TextPlace& place) {
  for (const UnclosedString& string : unclosed_strings(source.text())) {
    const bool is_before = string.is_multi_line && string.begin < place;
    if (is_before || string.begin.line == place.line) return string.begin;
  }
  return std::nullopt;
}

/// The last table of an array of tables, of which TOML continues the last.
const TomlTable* table_in(const TomlNode& node) {
  const auto* array = std::get_if<TomlArray>(&node.value);
  return std::get_if<TomlTable>(array != nullptr && !array->empty() ? &array->back().value
                                                                    : &node.value);
}

/// What the statement that begins line `number` gives a value, alone under its table's header: a
/// tree of one key, whose columns are those of the line. Throws as tree_of() does.
TomlTable statement_alone(const SourceText& source, std::size_t number) {
  const std::string_view line = source.line(number);
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin != std::string_view::npos && line[begin] == '[')
    return tree_of(SourceText(line, source.name()));
  std::string header;
  if (const auto place = end_of(source.before({number, 1})).header)
    header = source.line(place->line);
  for (std::size_t equals = line.find('='); equals != std::string_view::npos;
       equals = line.find('=', equals + 1)) {
    try {
      std::string item = header + '\n';
      item.append(line.substr(0, equals + 1)).append(" 0");
      return tree_of(SourceText(item, source.name()));
    } catch (const toml::parse_error&) {
      continue;  // an equals sign in a quoted name
    }
  }
  throw std::invalid_argument("no statement");
}

struct GivenTwice {
  std::string path;
  TextPlace first;
  TextPlace second;  // in the tree of it alone
};

/// The one key of `alone`, when `there` has it already.
std::optional<GivenTwice> given_in_both(const TomlTable& alone, const TomlTable& earlier) {
  GivenTwice twice;
  const TomlTable* there = &earlier;
  for (const TomlTable* here = &alone; here != nullptr && there != nullptr && !here->empty();) {
    const TomlMember& given = here->front();
    const TomlMember* found = find_member(*there, given.name);
    if (found == nullptr) return std::nullopt;
    twice = {twice.path + (twice.path.empty() ? "" : ".") + given.name, found->name_place,
             given.name_place};
    here = table_in(given.node);
    there = table_in(found->node);
  }
  return twice;
}

std::optional<GivenTwice> statement_given_twice(const SourceText& source, std::size_t number) {
  const TomlTable alone = statement_alone(source, number);
  auto twice = given_in_both(alone, tree_of(SourceText(source.before({number, 1}), source.name())));
  if (twice) twice->second.line = number;
  return twice;
}

/// The inline table that begins at `begin`, with the path to it; null when it is not in `node`.
const TomlTable* find_table_at(const TomlNode& node, const TextPlace& begin, std::string& path) {
  if (const auto* array = std::get_if<TomlArray>(&node.value)) {
    for (const TomlNode& element : *array)
      if (const TomlTable* found = find_table_at(element, begin, path)) return found;
  }
  const auto* table = std::get_if<TomlTable>(&node.value);
  if (table == nullptr) return nullptr;
  if (node.place.line == begin.line && node.place.column == begin.column) return table;
  for (const TomlMember& member : *table) {
    if (const TomlTable* found = find_table_at(member.node, begin, path)) {
      path.insert(0, member.name + ".");
      return found;
    }
  }
  return nullptr;
}

/// A key of an inline table, whose value begins at `place`.
std::optional<GivenTwice> item_given_twice(const SourceText& source, const TextPlace& place) {
  const std::string before(source.before(place));
  const TomlEnd end = end_of(before);
  if (!end.closers.starts_with('}')) return std::nullopt;
  std::string text = before.substr(0, end.item_offset);
  if (text.ends_with(',')) text.pop_back();
  const TomlNode earlier{tree_of(SourceText(text + end.closers, source.name())), {}};
  std::string path;
  const TomlTable* table = find_table_at(earlier, end.opener, path);
  if (table == nullptr) return std::nullopt;
  const std::string item = before.substr(end.item_offset) + "0";
  auto twice = given_in_both(tree_of(SourceText(item, source.name())), *table);
  if (!twice) return std::nullopt;
  twice->path.insert(0, path);
  twice->second.line = end.item.line;
  twice->second.column += end.item.column - 1;
  return twice;
}

/// The key that is given at `place`, when it is right by itself and what comes before has it
/// already.
std::optional<GivenTwice> given_twice(const SourceText& source, const TextPlace& place) {
  try {
    if (const auto twice = item_given_twice(source, place)) return twice;
    return statement_given_twice(source, place.line);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::string explained(const SourceText& source, const toml::parse_error& error) {
  const toml::source_position& at = error.source().begin;
  const TextPlace place{at.line, at.column, 1};
  const auto string = unclosed_string(source, place);
  const std::string no_end =
      string ? "the string that begins at " + source.column_name(*string) + " has no closing quote"
             : "";
  if (string && *string < place) return shown_not_toml(source, *string, no_end);
  if (const auto twice = given_twice(source, place)) {
    return shown_not_toml(source, twice->second,
                          excerpt(twice->path) + " is given twice; first given at " +
                              source.column_name(twice->first)) +
           source.excerpt_at(twice->first, "first");
  }
  const std::string description = excerpt(error.description(), longest_description);
  return shown_not_toml(source, place, string ? description + "; " + no_end : description);
}

}  // namespace

TomlTable parse_toml(const SourceText& source) {
  try {
    return tree_of(source);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(explained(source, error));
  }
}

}  // namespace gazed::base
