// What a file that is not what was expected is, in words.
#pragma once

#include <string>
#include <sys/stat.h>

namespace gazed::base {

/// "a FIFO", "a folder", "a device", "a socket", "a regular file".
[[nodiscard]] inline std::string kind_of_file(mode_t mode) {
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  if (S_ISSOCK(mode)) return "a socket";
  return "a regular file";
}

}  // namespace gazed::base
