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
#include <utility>
#include <vector>

#include "agent/base/range.hpp"
#include "agent/base/toml.hpp"

namespace gazed::base {

/// One table of a document that outlives it. Every read gives none when the value is not there or
/// is not allowed; of the latter, the document has an error, "table.key: value found; allowed:
/// ...", for its check(). Of more than one error about a key the first counts.
class StrictTable {
 public:
  /// The root of `document`.
  explicit StrictTable(TomlDocument& document) : StrictTable(document, document.root(), {}, "") {}

  [[nodiscard]] bool has(std::string_view key);
  [[nodiscard]] std::optional<double> number(std::string_view key, Range range);
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, Range range);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// Which of `names` the value is.
  [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                  std::span<const std::string_view> names);
  /// `allowed` is what an error says of the numbers, when their range says too little.
  template <std::size_t size>
  [[nodiscard]] std::optional<std::array<double, size>> numbers(std::string_view key, Range range,
                                                                std::string_view allowed = {}) {
    std::array<double, size> values{};
    if (!read_numbers(key, range, allowed, values)) return std::nullopt;
    return values;
  }
  /// The same of assign_with_zeros(): at least `fewest` numbers, zeros behind them.
  template <std::size_t size>
  [[nodiscard]] std::optional<std::array<double, size>> numbers_and_zeros(
      std::string_view key, Range range, std::size_t fewest, std::string_view allowed) {
    std::array<double, size> values{};
    if (!read_numbers_and_zeros(key, range, fewest, allowed, values)) return std::nullopt;
    return values;
  }
  /// An array of `rows` arrays, each of `columns` numbers; row by row.
  template <std::size_t rows, std::size_t columns>
  [[nodiscard]] std::optional<std::array<double, rows * columns>> matrix(std::string_view key,
                                                                         Range range) {
    std::array<double, rows * columns> values{};
    if (!read_matrix(key, range, columns, values)) return std::nullopt;
    return values;
  }
  [[nodiscard]] std::optional<StrictTable> table(std::string_view key);
  /// An array of tables; empty when it is not there.
  [[nodiscard]] std::vector<StrictTable> tables(std::string_view key);

  /// Refuses keys that were never asked for; call it when all are read.
  void finish();
  /// Refuses a value that is there, or one that is missing.
  void fail(std::string_view key, const std::string& allowed);
  /// The same in words of the caller's own.
  void refuse(std::string_view key, const std::string& why);
  /// "file:line: table.key: ", for what only the reader of the table knows to say.
  [[nodiscard]] std::string place(std::string_view key) const;

 private:
  StrictTable(TomlDocument& document, const TomlTable& table, const TextPlace& place,
              std::string path)
      : document_(&document), table_(&table), place_(place), path_(std::move(path)) {}

  [[nodiscard]] const TomlNode* find(std::string_view key);
  [[nodiscard]] TextPlace place_of(std::string_view key) const;
  [[nodiscard]] bool read_numbers(std::string_view key, Range range, std::string_view allowed,
                                  std::span<double> values);
  [[nodiscard]] bool read_numbers_and_zeros(std::string_view key, Range range, std::size_t fewest,
                                            std::string_view allowed, std::span<double> values);
  [[nodiscard]] bool read_matrix(std::string_view key, Range range, std::size_t columns,
                                 std::span<double> values);

  TomlDocument* document_;
  const TomlTable* table_;
  TextPlace place_;  // nowhere for the root
  std::string path_;
  std::vector<std::string> asked_;
  std::vector<std::string> refused_;
};

}  // namespace gazed::base
