#include "agent/base/source_text.hpp"

#include <algorithm>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::base {

namespace {

constexpr std::size_t longest_line_shown = 96;
constexpr std::size_t shown_before = 40;  // of a longer one, before the carets
constexpr std::size_t place_width = 5;    // so that two lines stand below each other, mostly

/// The bytes of the first `count` characters of UTF-8, or all that there are.
std::size_t bytes_of(std::string_view line, std::size_t count) {
  const auto begins_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  };
  std::size_t at = 0;
  for (; at < line.size(); ++at)
    if (begins_character(line[at]) && count-- == 0) break;
  return at;
}

}  // namespace

std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

SourceText::SourceText(std::string_view text, std::string name) : name_(std::move(name)) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  text_ = text;
}

std::string SourceText::line_name(const TextPlace& place) const {
  return place.line == 0 ? name_ : name_ + ':' + std::to_string(place.line);
}

std::string SourceText::column_name(const TextPlace& place) const {
  return line_name(place) + ':' + std::to_string(place.column);
}

std::string_view SourceText::line(std::size_t number) const {
  std::string_view rest = text_;
  for (; number > 1; --number) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return {};
    rest.remove_prefix(end + 1);
  }
  rest = rest.substr(0, rest.find('\n'));
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  return rest;
}

std::string_view SourceText::before(const TextPlace& place) const {
  const std::string_view text = text_;
  const std::string_view at = line(place.line);
  if (at.data() == nullptr) return text;
  const auto start = static_cast<std::size_t>(at.data() - text.data());
  return text.substr(0, start + bytes_of(at, place.column - 1));
}

std::string SourceText::excerpt_at(const TextPlace& place, std::string_view note) const {
  if (place.line == 0) return {};
  std::string_view shown = line(place.line);
  std::size_t column = place.column - 1;
  std::string_view left_out;
  if (characters_of(shown) > longest_line_shown && column > shown_before) {
    shown.remove_prefix(bytes_of(shown, column - shown_before));
    column = shown_before;
    left_out = "...";
  }
  const std::size_t width = std::min(characters_of(shown), longest_line_shown);
  column = std::min(column, width);
  const std::size_t carets = std::max<std::size_t>(1, std::min(place.length, width - column));

  std::string number = std::to_string(place.line) + ':' + std::to_string(place.column);
  number.insert(0, place_width - std::min(place_width, number.size()), ' ');
  std::string text = "\n  " + number + " | ";
  std::string printed(shown);
  std::ranges::replace(printed, '\t', ' ');
  text.append(left_out).append(excerpt(printed, bytes_of(shown, longest_line_shown)));
  text.append("\n  ").append(number.size(), ' ').append(" | ");
  text.append(left_out.size() + column, ' ').append(carets, '^');
  if (!note.empty()) text.append(" ").append(note);
  return text;
}

}  // namespace gazed::base
