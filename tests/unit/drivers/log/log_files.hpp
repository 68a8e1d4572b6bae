// Log files for the tests of this folder: made byte by byte, so that they can be damaged.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "agent/base/file_descriptor.hpp"

namespace gazed::log {

using Bytes = std::vector<std::uint8_t>;

/// A file in memory with a path: tens of thousands are written and read in a second.
class TemporaryFile {
 public:
  TemporaryFile();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Replaces the content.
  void write(const Bytes& bytes) const;
  [[nodiscard]] Bytes read() const;

 private:
  base::FileDescriptor file_;
  std::string path_;
};

/// One event of a log.
[[nodiscard]] Bytes event(const std::string& channel, const Bytes& message,
                          std::int64_t time_us = 0);

[[nodiscard]] Bytes joined(std::initializer_list<Bytes> parts);

}  // namespace gazed::log
