// The lines of a text that may be longer than memory: a file, or standard input.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace gazed::lab::io {

/// Reads one line at a time, and holds no more than that.
class LineReader {
 public:
  static constexpr std::size_t longest_line = 65536;  // bytes

  /// `file` is "-" for standard input. Throws std::runtime_error when it cannot be opened.
  explicit LineReader(const std::string& file);

  /// Whether there was one more; then line() is that one without its end (LF or CR LF), and without
  /// a byte order mark. Throws std::runtime_error for a line longer than longest_line and for what
  /// cannot be read; each names the file and, where there is one, the line.
  [[nodiscard]] bool next();

  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }  // of line(), from 1
  /// The file as messages name it: "standard input" for "-".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// "pairs.csv:12: " for messages on line().
  [[nodiscard]] std::string place() const;

  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }
  /// None for what has no length, as a pipe.
  [[nodiscard]] std::optional<std::size_t> bytes_in_all() const { return bytes_in_all_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };

  std::string name_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::optional<std::size_t> bytes_in_all_;
  std::string line_;
  std::size_t number_ = 0;
  std::size_t bytes_read_ = 0;
};

}  // namespace gazed::lab::io
