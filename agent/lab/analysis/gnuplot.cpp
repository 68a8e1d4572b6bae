#include "agent/lab/analysis/gnuplot.hpp"

#include <array>
#include <cerrno>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace gazed::lab::analysis {

Gnuplot run_gnuplot(const std::filesystem::path& folder, const std::filesystem::path& script) {
  std::string program = "gnuplot";
  std::string argument = script.string();
  const std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) return Gnuplot::failed;
  pid_t child = 0;
  int error = posix_spawn_file_actions_addchdir_np(&actions, folder.empty() ? "." : folder.c_str());
  if (error == 0) {
    error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  }
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return Gnuplot::not_installed;
  if (error != 0) return Gnuplot::failed;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return Gnuplot::failed;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Gnuplot::drawn : Gnuplot::failed;
}

}  // namespace gazed::lab::analysis
