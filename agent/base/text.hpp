// Sentences with numbers in them, and with what somebody wrote.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace gazed::base {

/// printf's format, checked by the compiler; any length.
[[nodiscard]] [[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// "top, bottom"
[[nodiscard]] std::string listed(std::span<const std::string_view> words);

/// "640x480"
[[nodiscard]] std::string size_text(int width, int height);

/// UTF-8 without control characters: what a TOML file and a line of a message can hold.
[[nodiscard]] bool is_printable(std::string_view text);

inline constexpr std::size_t longest_file_name = 4096;  // in a message, PATH_MAX

/// Somebody's text for a message: short and printable.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t longest_bytes = 80);

}  // namespace gazed::base
