// Image points of the same scene points in two pictures, read from CSV one row at a time.
#pragma once

#include <optional>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/lab/io/line_reader.hpp"

namespace gazed::lab {

struct Correspondence {
  std::string id;                    // as it was written; may be empty, may come again
  geometry::Pixel pixel_1, pixel_2;  // may be nan or infinite
};

/// Rows under the header id,x1,y1,x2,y2; empty lines count but say nothing.
class CorrespondenceReader {
 public:
  /// `file` is "-" for standard input. Throws std::runtime_error when there is no such file or it
  /// does not begin with the header.
  explicit CorrespondenceReader(const std::string& file);

  /// None at the end. Throws std::runtime_error with the line, what was read and what was expected.
  [[nodiscard]] std::optional<Correspondence> next();

  [[nodiscard]] const io::LineReader& lines() const { return lines_; }

 private:
  [[nodiscard]] bool next_line();

  io::LineReader lines_;
};

}  // namespace gazed::lab
