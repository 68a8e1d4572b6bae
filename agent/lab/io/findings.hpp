// The winner of each picture, written as it is found.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>

#include "agent/geometry/camera.hpp"

namespace gazed::lab::io {

struct Finding {
  std::string image;
  geometry::Pixel winner_px = geometry::Pixel::Zero();  // in the input picture's pixels
  float saliency = 0.0F;
  float distinctness = 0.0F;
  bool is_small = false;  // below the least frame that gazed takes
};

/// CSV, or columns for a person at a terminal. Distinct is what reaches `distinctness_min`.
class FindingsWriter {
 public:
  /// Writes CSV to the file `csv` or, for "-", to standard output; without a name columns when
  /// standard output is a terminal, else CSV. `images` are all that may come (for the columns'
  /// width). Throws std::invalid_argument when the file cannot be opened.
  FindingsWriter(const std::string& csv, std::span<const std::string> images,
                 double distinctness_min);
  ~FindingsWriter();
  FindingsWriter(const FindingsWriter&) = delete;
  FindingsWriter& operator=(const FindingsWriter&) = delete;

  /// A row appears at once when standard output is read by a person.
  void add(const Finding& finding);
  [[nodiscard]] bool to_terminal() const { return to_terminal_; }
  /// Throws std::runtime_error when something could not be written.
  void finish();

 private:
  std::string name_;
  bool to_terminal_;
  bool columns_;
  std::FILE* file_;
  int image_width_ = 5;
  double distinctness_min_;
};

}  // namespace gazed::lab::io
