// A text that somebody wrote, and the lines of it that an error shows.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <string_view>

namespace gazed::base {

/// Characters of one line; line and column count from 1. Line 0: nowhere in the text.
struct TextPlace {
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t length = 1;

  friend auto operator<=>(const TextPlace&, const TextPlace&) = default;
};

/// Of UTF-8.
[[nodiscard]] std::size_t characters_of(std::string_view text);

class SourceText {
 public:
  /// `name` is what messages call it.
  SourceText(std::string_view text, std::string name);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// "robot.toml:4", and "robot.toml" for nowhere.
  [[nodiscard]] std::string line_name(const TextPlace& place) const;
  /// "robot.toml:4:12".
  [[nodiscard]] std::string column_name(const TextPlace& place) const;

  /// The line of `place` with a caret under each of its characters, to go behind a message; empty
  /// for nowhere:
  ///    4:12 | width_px = 12
  ///         |            ^^ note
  /// Of a long line only what is around `place`.
  [[nodiscard]] std::string excerpt_at(const TextPlace& place, std::string_view note = {}) const;

  /// Without its line break; empty for a line that is not there.
  [[nodiscard]] std::string_view line(std::size_t number) const;
  /// What comes before `place`.
  [[nodiscard]] std::string_view before(const TextPlace& place) const;

 private:
  std::string text_;
  std::string name_;
};

}  // namespace gazed::base
