#include "tests/integration/program.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace gazed::integration {

namespace {

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() / ("gazed_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

const TemporaryFolder& folder() {
  static const TemporaryFolder instance;
  return instance;
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string temporary_file(const std::string& name, const std::string& content) {
  const std::string path = folder().file(name);
  if (!content.empty()) std::ofstream(path, std::ios::binary) << content;
  return path;
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const std::string& standard_output) {
  static int count = 0;
  out_path_ = temporary_file("out" + std::to_string(++count));
  err_path_ = temporary_file("err" + std::to_string(count));
  std::vector<std::string> command{GAZED_LAUNCHER};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& part : command) argv.push_back(part.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  const std::string& output = standard_output.empty() ? out_path_ : standard_output;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_path_.c_str(), flags, 0600);
  const int error = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), arguments.front());
}

RunningProgram::~RunningProgram() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void RunningProgram::send_signal(int signal) const {
  kill(pid_, signal);
}

void RunningProgram::stop() const {
  send_signal(SIGSTOP);
  int status = 0;
  while (waitpid(pid_, &status, WUNTRACED) < 0 && errno == EINTR) {
  }
  if (!WIFSTOPPED(status)) throw std::runtime_error("a program ended that was to be stopped");
}

bool RunningProgram::prints(const std::string& text, double seconds) const {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  const auto printed = [&](const std::string& path) {
    return content(path).find(text) != std::string::npos;
  };
  while (!printed(out_path_) && !printed(err_path_)) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(20ms);
  }
  return true;
}

ProgramResult RunningProgram::finish() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = content(out_path_);
  result.err = content(err_path_);
  return result;
}

ProgramResult run_program(const std::vector<std::string>& arguments) {
  return RunningProgram(arguments).finish();
}

ProgramResult run_without_room_for_output(const std::vector<std::string>& arguments) {
  return RunningProgram(arguments, "/dev/full").finish();
}

}  // namespace gazed::integration
