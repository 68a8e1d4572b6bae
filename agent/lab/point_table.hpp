// Triangulated points, written as they come.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>

#include "agent/triangulation/two_view.hpp"

namespace gazed::lab {

/// A line of columns for a person; any number takes about the same place.
[[nodiscard]] std::string column_row(const std::string& id,
                                     const triangulation::PointEstimate& point);

/// CSV, or columns for a person at a terminal.
class PointTable {
 public:
  /// Writes CSV to the file `csv` or, for "-", to standard output; without a name columns when
  /// standard output is a terminal, else CSV. A file takes its name only when it is complete: until
  /// finish() the rows stand in a new file of the same folder, which goes away when finish() is not
  /// reached. What is there and no regular file (a pipe, a device) is written as it is. Throws
  /// std::invalid_argument when it cannot be opened.
  explicit PointTable(const std::string& csv);
  ~PointTable();
  PointTable(const PointTable&) = delete;
  PointTable& operator=(const PointTable&) = delete;

  void add(const std::string& id, const triangulation::PointEstimate& point);
  [[nodiscard]] bool to_terminal() const { return to_terminal_; }
  /// Throws std::runtime_error when something could not be written.
  void finish();

  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// "1000 correspondences: 940 LOCATED, 60 UNCERTAIN".
  [[nodiscard]] std::string summary() const;

 private:
  [[nodiscard]] bool is_to_stdout() const { return file_ == stdout; }

  std::string name_;
  bool to_terminal_;
  bool columns_;
  std::FILE* file_ = nullptr;
  std::filesystem::path target_, part_;  // empty: written under its own name
  std::size_t rows_ = 0;
  std::array<std::size_t, triangulation::status_count> rows_by_status_{};
};

}  // namespace gazed::lab
