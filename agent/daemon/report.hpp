// What gazed prints: a few lines a person wants to read for each fixation, or one JSON object a
// line for a program.
#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include "agent/cycle/fixation.hpp"
#include "agent/settings/settings.hpp"
#include "msgs/gazed/located_point_t.hpp"

namespace gazed::daemon {

/// What the computer spent on a fixation, milliseconds.
struct Effort {
  double saliency_ms = 0.0;  // of the first view
  double locate_ms = 0.0;    // from the last view's arrival to the point
};

/// One line, with the field names of located_point_t, `status` as its name, NaN as null.
[[nodiscard]] std::string to_json(const located_point_t& point);

/// Where, how sure, how long it took.
[[nodiscard]] std::string to_text(const cycle::Fixation& fixation, const Effort& effort);

/// Prints fixations as they come and counts them; the last line sums the statuses. A reader that
/// does not keep up must not stop the loop: lines that would have to wait are dropped, counted, and
/// the count is printed at the end.
class Report {
 public:
  Report(settings::PrintFormat format, std::FILE* out) : format_(format), out_(out) {}

  void begin(const settings::Settings& settings, const std::string& lcm_url);
  void fixation(const cycle::Fixation& fixation, const located_point_t& message,
                const Effort& effort);
  /// A message for a person, to standard error, in every format.
  void note(const std::string& text);
  /// As note(), for what lasts: not the same line again, nor another one within ten seconds.
  /// Empty when all is well.
  void faults(const std::string& line);
  /// `frames`: what became of a log's frames, for the case that nothing was located.
  void end(double elapsed_s, const std::string& frames = {});

  /// True when something for standard output could not be written: the disk is full, the reader is
  /// gone.
  [[nodiscard]] bool lost_output() const { return output_error_ != 0; }

 private:
  void print(std::FILE* out, const std::string& lines);

  settings::PrintFormat format_;
  std::FILE* out_;
  int dropped_ = 0;
  int output_error_ = 0;  // errno of the first line that standard output did not take
  std::string last_line_;
  std::chrono::steady_clock::time_point faults_not_before_{};
  std::array<int, cycle::status_count> counts_{};
  int faults_between_ = 0;  // published, but not the end of any look
};

}  // namespace gazed::daemon
