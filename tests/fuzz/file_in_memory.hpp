// For readers of files: a file with a path that is on no disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace gazed::fuzz {

class FileInMemory {
 public:
  [[nodiscard]] const std::string& path() const { return path_; }
  void write(std::span<const std::uint8_t> bytes) const {
    if (ftruncate(file_, 0) != 0 ||
        pwrite(file_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      std::abort();
  }

 private:
  int file_ = memfd_create("fuzz", 0);
  std::string path_ = "/proc/self/fd/" + std::to_string(file_);
};

/// Runs what may refuse its input; any other exception is a finding.
template <class Read>
void refusing(const Read& read) {
  try {
    read();
  } catch (const std::invalid_argument&) {
  } catch (const std::runtime_error&) {
  }
}

}  // namespace gazed::fuzz
