// Keeps a second gazed off a device or a socket that the first one uses.
//
// The lock is a file of its own, held by flock(): it can be had before the device is there, for a
// socket as well (which cannot be opened as a file), it tells the holder's process id, and it ends
// with the process, however that ends.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gazed {

class ExclusiveUse {
 public:
  /// `resource` is the path of the device or socket; of a link, where it leads to. Throws
  /// std::invalid_argument, with the process id of the holder, when another one uses it. The lock
  /// is in the first of `folders` where a file can be made; where there is none nothing is locked,
  /// and warning() says so.
  explicit ExclusiveUse(const std::string& resource,
                        const std::vector<std::string>& folders = {"/run/lock", "/tmp"});
  ~ExclusiveUse();

  ExclusiveUse(ExclusiveUse&& other) noexcept;
  ExclusiveUse& operator=(ExclusiveUse&& other) = delete;
  ExclusiveUse(const ExclusiveUse&) = delete;

  /// Why nothing is locked; empty when all is well.
  [[nodiscard]] const std::string& warning() const { return warning_; }

 private:
  [[nodiscard]] bool lock(const std::string& file, const std::string& resource);

  int descriptor_ = -1;
  std::string warning_;
};

}  // namespace gazed
