#include "agent/base/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "agent/base/file_kind.hpp"
#include "agent/base/text.hpp"

namespace gazed::base {

namespace {

std::string words_of_errno() {
  return std::generic_category().message(errno);
}

}  // namespace

RegularFile open_regular_file(const std::string& path) {
  // O_NONBLOCK: it cannot be told before whether it is a FIFO.
  RegularFile file{.descriptor = FileDescriptor(
                       open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK))};
  struct stat status {};
  if (file.descriptor.get() < 0 || fstat(file.descriptor.get(), &status) != 0) {
    file.problem = words_of_errno();
  } else if (!S_ISREG(status.st_mode)) {
    file.problem = kind_of_file(status.st_mode) + "; a regular file is needed";
  }
  if (!file.problem.empty()) file.descriptor = FileDescriptor(-1);
  file.bytes = status.st_size;
  return file;
}

std::string read_text(const std::string& path, std::size_t most_bytes) {
  const auto refuse = [&path](const std::string& problem) {
    throw std::invalid_argument(excerpt(path, longest_file_name) + ": cannot be read: " + problem);
  };
  const RegularFile file = open_regular_file(path);
  if (!file.problem.empty()) refuse(file.problem);
  std::string text(std::min(static_cast<std::size_t>(file.bytes), most_bytes + 1), '\0');
  std::size_t filled = 0;
  while (filled < text.size()) {
    const ssize_t count = read(file.descriptor.get(), text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(words_of_errno());
    if (count == 0) break;  // it has become shorter
    filled += static_cast<std::size_t>(count);
  }
  text.resize(filled);
  return text;
}

}  // namespace gazed::base
