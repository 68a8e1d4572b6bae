// Keeps a second gazed off a device or a socket that the first one uses.
//
// The lock is a file of its own, held by flock(): it can be had before the device is there, for a
// socket as well (which cannot be opened as a file), it tells the holder's process id, and it ends
// with the process, however that ends. It lies in a folder that only its user can open: what others
// can open they can lock, and keep gazed from starting. So it keeps off a second gazed of the same
// user only.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/file_descriptor.hpp"

namespace gazed::drivers {

/// Another gazed has it: nothing is wrong with the configuration, and later it may be free.
class InUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ExclusiveUse {
 public:
  /// `resource` is the path of the device or socket; of a link, what it leads to is meant too.
  /// Throws InUse, with the process id of the holder, when another one uses it. The lock is in
  /// gazed-UID, a folder of this user's own, in the first of `folders` where that can be had; where
  /// there is none nothing is locked, and warning() says so.
  explicit ExclusiveUse(const std::string& resource,
                        const std::vector<std::string>& folders = {"/run/lock", "/tmp"});

  /// Why nothing is locked; empty when all is well.
  [[nodiscard]] const std::string& warning() const { return warning_; }

 private:
  /// 0, or the errno of what failed.
  [[nodiscard]] int lock(const std::string& file, const std::string& resource);

  std::vector<base::FileDescriptor> locks_;
  std::string warning_;
};

}  // namespace gazed::drivers
