// Runs a program as a user would, and gives back what it printed and how it ended.
#pragma once

#include <string>
#include <vector>

namespace gazed::integration {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal when one ended it
  std::string out;
  std::string err;
};

/// Throws std::system_error when the program cannot be started.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& arguments);
/// With its standard output going to /dev/full, where every write fails.
[[nodiscard]] ProgramResult run_without_room_for_output(const std::vector<std::string>& arguments);

/// A program that runs while the test goes on.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments,
                          const std::string& standard_output = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send_signal(int signal) const;
  /// Stops it, and waits until it stands still; SIGCONT lets it go on.
  void stop() const;
  /// Waits until it has printed `text`; false when it has not within `seconds`.
  [[nodiscard]] bool prints(const std::string& text, double seconds) const;
  /// Waits for its end.
  [[nodiscard]] ProgramResult finish();

 private:
  std::string out_path_, err_path_;
  int pid_ = -1;
};

/// A file in a folder of this test process's own, removed with it.
[[nodiscard]] std::string temporary_file(const std::string& name, const std::string& content = {});

}  // namespace gazed::integration
