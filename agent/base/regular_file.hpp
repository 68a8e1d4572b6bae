// Files that somebody names to be read. To open a FIFO would wait for who writes it, and a device
// may never end: neither is opened here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "agent/base/file_descriptor.hpp"

namespace gazed::base {

/// Open for reading, or why it is not.
struct RegularFile {
  FileDescriptor descriptor{-1};
  std::int64_t bytes = 0;
  std::string problem{};  // "No such file or directory"; "a FIFO; a regular file is needed"
};

/// Never waits.
[[nodiscard]] RegularFile open_regular_file(const std::string& path);

/// What a file holds, of one longer than `most_bytes` one byte more than that. Throws
/// std::invalid_argument when it cannot be read.
[[nodiscard]] std::string read_text(const std::string& path, std::size_t most_bytes);

}  // namespace gazed::base
