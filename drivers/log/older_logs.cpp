#include "drivers/log/older_logs.hpp"

#include <cerrno>
#include <cstdio>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace gazed::log {

namespace {

std::string numbered(const std::string& path, std::size_t number) {
  return number == 0 ? path : path + "." + std::to_string(number);
}

/// Sizes of FILE.1, FILE.2 and so on, up to the first number that is not there.
std::vector<std::int64_t> sizes_of_older(const std::string& path) {
  std::vector<std::int64_t> sizes;
  struct stat status {};
  while (lstat(numbered(path, sizes.size() + 1).c_str(), &status) == 0)
    sizes.push_back(status.st_size);
  return sizes;
}

}  // namespace

int keep_as_older(const std::string& path) {
  // From the last one on: each name is free when a file gets it.
  for (std::size_t number = sizes_of_older(path).size() + 1; number > 0; --number) {
    if (std::rename(numbered(path, number - 1).c_str(), numbered(path, number).c_str()) != 0)
      return errno;
  }
  return 0;
}

void remove_oldest(const std::string& path, std::int64_t newest_bytes, double most_bytes) {
  const std::vector<std::int64_t> sizes = sizes_of_older(path);
  double bytes = static_cast<double>(newest_bytes);
  for (const std::int64_t size : sizes) bytes += static_cast<double>(size);
  for (std::size_t number = sizes.size(); number > 0 && bytes > most_bytes; --number) {
    if (unlink(numbered(path, number).c_str()) != 0) return;
    bytes -= static_cast<double>(sizes[number - 1]);
  }
}

}  // namespace gazed::log
