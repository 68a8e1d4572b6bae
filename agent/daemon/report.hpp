// What gazed prints: for each fixation, either a few lines for people or one JSON object per line
// for programs.
#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include "agent/cycle/fixation.hpp"
#include "agent/settings/settings.hpp"
#include "msgs/gazed/located_point_t.hpp"

namespace gazed::daemon {

/// Computing time of a fixation, milliseconds.
struct Effort {
  double saliency_ms = 0.0;  // of the first view
  double locate_ms = 0.0;    // from the last view's arrival to the point
};

/// One line, with the field names of located_point_t; `status` is its name, NaN becomes null.
[[nodiscard]] std::string to_json(const located_point_t& point);

/// Where the object is, how certain that is, and how long it took.
[[nodiscard]] std::string to_text(const cycle::Fixation& fixation, const Effort& effort);

/// Prints fixations as they come and counts them; the last line sums up the statuses. A slow reader
/// must not stop the loop: lines that would block are dropped, and their number is printed at the
/// end.
class Report {
 public:
  Report(settings::PrintFormat format, std::FILE* out) : format_(format), out_(out) {}

  void begin(const settings::Settings& settings, const std::string& lcm_url);
  void fixation(const cycle::Fixation& fixation, const located_point_t& message,
                const Effort& effort);
  /// A message for a person, to standard error, in every format.
  void note(const std::string& text);
  /// Like note(), for conditions that last: never repeats the same line, and prints another at most
  /// every ten seconds. Empty if all is well.
  void faults(const std::string& line);
  /// `frames`: what happened to a log's frames, in case nothing was located.
  void end(double elapsed_s, const std::string& frames = {});

  /// True if standard output could not be written: the disk is full, or the reader is gone.
  [[nodiscard]] bool lost_output() const { return output_error_ != 0; }

 private:
  void print(std::FILE* out, const std::string& lines);

  settings::PrintFormat format_;
  std::FILE* out_;
  int dropped_ = 0;
  int output_error_ = 0;  // errno of the first failed write to standard output
  std::string last_line_;
  std::chrono::steady_clock::time_point faults_not_before_{};
  std::array<int, cycle::status_count> counts_{};
  int faults_between_ = 0;  // published outside any look
};

}  // namespace gazed::daemon
