#include "agent/base/toml_guard.hpp"

#include <cstddef>

namespace gazed::base {

namespace {

constexpr int most_dotted_names = 1000;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_outside_ascii(char c) {
  return static_cast<unsigned char>(c) >= 0x80U;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' ||
         c == '+' || c == '.';
}

/// Walks over the text as TOML is read, as far as it is TOML.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
  }

  std::optional<TomlHazard> find() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (is_outside_ascii(c))
        return TomlHazard{line_, "a letter outside ASCII, outside strings and comments"};
      if (c == '#')
        skip_comment();
      else if (text_.substr(at_).starts_with("\"\"\"") || text_.substr(at_).starts_with("'''"))
        at_ += 3;  // what is inside a multi-line string is held to the rules outside
      else if (c == '"' || c == '\'')
        skip_string(c);
      else if (is_word(c))
        skip_word();
      else
        skip_one();
      if (dots_ > most_dotted_names) return TomlHazard{line_, "too many dotted names"};
    }
    return std::nullopt;
  }

 private:
  void skip_one() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  void skip_string(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == quote) {
        ++at_;
        return;
      }
      if (text_[at_] == '\\' && quote == '"') {
        if (at_ + 1 < text_.size() && is_outside_ascii(text_[at_ + 1])) return skip_one();
        if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      }
    }
  }

  /// Counts its dots, but not the one of a decimal number.
  void skip_word() {
    const std::size_t start = at_;
    int dots = 0;
    std::size_t dot = 0;
    for (; at_ < text_.size() && is_word(text_[at_]); ++at_)
      if (text_[at_] == '.') {
        ++dots;
        dot = at_;
      }
    const bool decimal = dots == 1 && dot > start && is_digit(text_[dot - 1]) && dot + 1 < at_ &&
                         is_digit(text_[dot + 1]);
    if (!decimal) dots_ += dots;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int dots_ = 0;
};

}  // namespace

std::optional<TomlHazard> toml_hazard(std::string_view text) {
  return Walk(text).find();
}

}  // namespace gazed::base
