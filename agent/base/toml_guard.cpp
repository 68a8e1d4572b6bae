#include "agent/base/toml_guard.hpp"

#include <algorithm>
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

bool is_name(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
}

bool is_word(char c) {
  return is_name(c) || c == '+' || c == '.';
}

/// Where toml++ takes a value that begins with a digit or a sign to end. A date of ten characters
/// may go on behind a space.
std::size_t end_of_number(std::string_view text, std::size_t begin) {
  constexpr std::string_view terminators = " \t\n\v\f\r]},#";
  constexpr std::size_t date_length = 10;
  std::size_t end = std::min(text.find_first_of(terminators, begin), text.size());
  if (end - begin == date_length && end < text.size() && text[end] == ' ')
    end = std::min(text.find_first_of(terminators, end + 1), text.size());
  return end;
}

/// Walks over the text as TOML is read, as far as it is TOML.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    while (at_ < text_.size()) step();
  }

  std::optional<TomlHazard> hazard;
  std::vector<UnclosedString> unclosed;
  std::optional<TextPlace> header;

  [[nodiscard]] TomlEnd end() const {
    TomlEnd end;
    end.header = header;
    for (const Open& open : open_) end.closers.insert(0, 1, open.closer);
    if (open_.empty()) return end;
    end.opener = open_.back().opener;
    end.item = open_.back().item;
    end.item_offset = open_.back().item_offset;
    return end;
  }

 private:
  /// An array or an inline table.
  struct Open {
    char closer;
    TextPlace opener;
    TextPlace item;
    std::size_t item_offset;
  };

  void step() {
    const char c = text_[at_];
    const std::string_view rest = text_.substr(at_);
    if (is_outside_ascii(c)) {
      find_hazard("a letter outside ASCII, outside strings and comments");
      advance();
    } else if (c == '#') {
      while (at_ < text_.size() && text_[at_] != '\n') advance();
    } else if (rest.starts_with("\"\"\"") || rest.starts_with("'''")) {
      skip_multi_line_string(rest.substr(0, 3));
    } else if (c == '"' || c == '\'') {
      skip_string(c);
    } else if (is_word(c)) {
      skip_word();
    } else if (c == '[' && open_.empty() && begins_statement_) {
      skip_header_brackets();
    } else {
      skip_one();
    }
  }

  void find_hazard(const char* what) {
    if (!hazard) hazard = TomlHazard{here(), what};
  }

  [[nodiscard]] TextPlace here() const { return {line_, column_, 1}; }

  /// Over one byte.
  void advance() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
      begins_statement_ = true;
      return;
    }
    if (at_ == text_.size() || (static_cast<unsigned char>(text_[at_]) & 0xC0U) != 0x80U) ++column_;
    if (c != ' ' && c != '\t' && c != '\r') begins_statement_ = false;
  }

  void advance(std::size_t bytes) {
    for (; bytes > 0 && at_ < text_.size(); --bytes) advance();
  }

  /// Of arrays and inline tables, when it is one of their marks.
  void skip_one() {
    const char c = text_[at_];
    const TextPlace place = here();
    advance();
    if (c == '[' || c == '{')
      open_.push_back({c == '[' ? ']' : '}', place, here(), at_});
    else if ((c == ']' || c == '}') && !open_.empty())
      open_.pop_back();
    else if (c == ',' && !open_.empty())
      open_.back() = {open_.back().closer, open_.back().opener, here(), at_};
  }

  /// Both of "[[". A header ends with its line, and its brackets count for nothing.
  void skip_header_brackets() {
    header = here();
    advance(text_.substr(at_).starts_with("[[") ? 2 : 1);
  }

  void skip_string(char quote) {
    const TextPlace begin = here();
    for (advance(); at_ < text_.size() && text_[at_] != '\n'; advance()) {
      if (text_[at_] == quote) return advance();
      if (text_[at_] != '\\' || quote != '"' || at_ + 1 == text_.size()) continue;
      if (is_outside_ascii(text_[at_ + 1])) {
        advance();
        return find_hazard("a letter outside ASCII after a backslash");
      }
      if (text_[at_ + 1] != '\n') advance();
    }
    unclosed.push_back({begin, false});
  }

  /// What is inside is held to the rules outside.
  void skip_multi_line_string(std::string_view quotes) {
    const TextPlace begin = here();
    advance(quotes.size());
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (text_.substr(at_).starts_with(quotes)) {
        advance(quotes.size());
        for (int own = 0; own < 2 && text_.substr(at_).starts_with(quotes[0]); ++own) advance();
        begins_statement_ = false;
        return;
      }
      if (is_outside_ascii(c)) find_hazard("a letter outside ASCII in a multi-line string");
      if (c == '.') count_dots(1);
      const bool is_escape = c == '\\' && quotes[0] == '"' && at_ + 1 < text_.size();
      advance(is_escape && (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\') ? 2 : 1);
    }
    unclosed.push_back({begin, true});
  }

  /// Counts its dots, but not the one of a decimal number.
  void skip_word() {
    const std::size_t start = at_;
    int dots = 0;
    std::size_t dot = 0;
    for (; at_ < text_.size() && is_word(text_[at_]); advance())
      if (text_[at_] == '.') {
        ++dots;
        dot = at_;
      }
    const bool decimal = dots == 1 && dot > start && is_digit(text_[dot - 1]) && dot + 1 < at_ &&
                         is_digit(text_[dot + 1]);
    if (!decimal) count_dots(dots);
    look_through_number(start);
  }

  /// Quotes are a number's letters, and begin no string. What begins inside a number ends with it.
  void look_through_number(std::size_t begin) {
    const char first = text_[begin];
    if (begin < number_end_ || (!is_digit(first) && first != '+' && first != '-')) return;
    number_end_ = end_of_number(text_, begin);
    const std::string_view number = text_.substr(begin, number_end_ - begin);
    if (std::ranges::any_of(number, is_outside_ascii))
      find_hazard("a letter outside ASCII, outside strings and comments");
  }

  void count_dots(int dots) {
    dots_ += dots;
    if (dots_ > most_dotted_names) find_hazard("too many dotted names");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t number_end_ = 0;  // of the last number that was looked through
  std::size_t line_ = 1;
  std::size_t column_ = 1;
  std::vector<Open> open_;
  bool begins_statement_ = true;  // only white space before it on its line
  int dots_ = 0;
};

}  // namespace

std::optional<TomlHazard> toml_hazard(std::string_view text) {
  return Walk(text).hazard;
}

std::vector<UnclosedString> unclosed_strings(std::string_view text) {
  return Walk(text).unclosed;
}

TomlEnd end_of(std::string_view text) {
  return Walk(text).end();
}

}  // namespace gazed::base
