// TOML tables read strictly: a key that nobody asked for, a value of the wrong type and a value out
// of range are errors that name the place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

namespace gazed::base {

struct NumberRange {
  double min = 0.0;
  double max = 0.0;
};

/// One table of a TOML document that outlives it. Every read throws std::invalid_argument with
/// "file:line: table.key: value found; allowed: ..." when the value is there and is not allowed,
/// and gives none when it is not there.
class StrictTable {
 public:
  StrictTable(const toml::table& table, std::string path, std::string source_name)
      : table_(&table), path_(std::move(path)), source_name_(std::move(source_name)) {}

  [[nodiscard]] bool has(std::string_view key);
  [[nodiscard]] std::optional<double> number(std::string_view key, NumberRange range);
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, NumberRange range);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// Which of `names` the value is.
  [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                  std::span<const std::string_view> names);
  template <std::size_t size>
  [[nodiscard]] std::optional<std::array<double, size>> numbers(std::string_view key,
                                                                NumberRange range) {
    std::array<double, size> values{};
    if (!read_numbers(key, range, values)) return std::nullopt;
    return values;
  }
  /// An array of `rows` arrays, each of `columns` numbers; row by row.
  template <std::size_t rows, std::size_t columns>
  [[nodiscard]] std::optional<std::array<double, rows * columns>> matrix(std::string_view key,
                                                                         NumberRange range) {
    std::array<double, rows * columns> values{};
    if (!read_matrix(key, range, columns, values)) return std::nullopt;
    return values;
  }
  [[nodiscard]] std::optional<StrictTable> table(std::string_view key);
  /// An array of tables; empty when it is not there.
  [[nodiscard]] std::vector<StrictTable> tables(std::string_view key);

  /// Throws for a key that was never asked for; call it when all are read.
  void finish() const;
  /// Throws for a value that is there, or for one that is missing.
  [[noreturn]] void fail(std::string_view key, const std::string& allowed) const;
  /// "file:line: table.key: ", for what only the reader of the table knows to say.
  [[nodiscard]] std::string place(std::string_view key) const;

 private:
  [[nodiscard]] const toml::node* find(std::string_view key);
  [[nodiscard]] bool read_numbers(std::string_view key, NumberRange range,
                                  std::span<double> values);
  [[nodiscard]] bool read_matrix(std::string_view key, NumberRange range, std::size_t columns,
                                 std::span<double> values);

  const toml::table* table_;
  std::string path_;
  std::string source_name_;
  std::vector<std::string> asked_;
};

constexpr std::size_t longest_file_name = 4096;  // in a message, PATH_MAX

/// What a file holds, of one longer than `most_bytes` one byte more than that. Throws
/// std::invalid_argument when it cannot be read.
[[nodiscard]] std::string read_text(const std::string& file, std::size_t most_bytes);

/// Throws std::invalid_argument, "file:line: not TOML: ...", for text that is not, and for one
/// longer than `most_bytes`.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& source_name,
                                     std::size_t most_bytes);

}  // namespace gazed::base
