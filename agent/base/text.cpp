#include "agent/base/text.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <optional>

namespace gazed::base {

namespace {

/// The character that `text` begins with in UTF-8: its number and its bytes; none when it is not
/// UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};
std::optional<Character> first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return Character{lead, 1};
  const std::size_t bytes = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC0U || lead > 0xF4U || text.size() < bytes) return std::nullopt;
  char32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return std::nullopt;
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800U && code <= 0xDFFFU;
  if (code < least[bytes] || code > 0x10FFFFU || is_surrogate) return std::nullopt;
  return Character{code, bytes};
}

bool is_control(char32_t code) {
  return code < 0x20U || (code >= 0x7FU && code < 0xA0U);
}

}  // namespace

std::string text(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  std::string result(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(result.data(), result.size() + 1, format, again);
  va_end(again);
  return result;
}

std::string listed(std::span<const std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) {
    if (!list.empty()) list += ", ";
    list += word;
  }
  return list;
}

std::string size_text(int width, int height) {
  return text("%dx%d", width, height);
}

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const std::optional<Character> c = first_character(text);
    if (!c || is_control(c->code)) return false;
    text.remove_prefix(c->bytes);
  }
  return true;
}

std::string excerpt(std::string_view text, std::size_t longest_bytes) {
  std::string result;
  while (!text.empty() && result.size() < longest_bytes) {
    const std::optional<Character> c = first_character(text);
    const bool is_shown = c && !is_control(c->code);
    result += is_shown ? text.substr(0, c->bytes) : "?";
    text.remove_prefix(c ? c->bytes : 1);
  }
  if (!text.empty()) result += "...";
  return result;
}

}  // namespace gazed::base
