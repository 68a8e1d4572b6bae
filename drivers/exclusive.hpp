// Keeps a second gazed away from a device or socket that the first one uses.
//
// The lock is a separate file, held by flock(). It can be taken before the device exists, works for
// sockets (which cannot be opened as files), contains the holder's process id, and ends with the
// process however that ends. It is in a folder that only its user can open, because others could
// otherwise lock it and keep gazed from starting. So it only protects against a second gazed of the
// same user.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/file_descriptor.hpp"

namespace gazed::drivers {

/// Another gazed uses the resource: the configuration is valid, and the resource may be free later.
class InUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ExclusiveUse {
 public:
  /// `resource` is the path of the device or socket; a symbolic link stands for its target, too.
  /// Throws InUse, with the holder's process id, if another process holds it. The lock file is in
  /// gazed-UID, this user's private folder, in the first of `folders` where it can be created; if
  /// there is none, nothing is locked, and warning() says so.
  explicit ExclusiveUse(const std::string& resource,
                        const std::vector<std::string>& folders = {"/run/lock", "/tmp"});

  /// Why nothing is locked; empty if all is well.
  [[nodiscard]] const std::string& warning() const { return warning_; }

 private:
  /// Returns 0, or the errno of what failed.
  [[nodiscard]] int lock(const std::string& file, const std::string& resource);

  std::vector<base::FileDescriptor> locks_;
  std::string warning_;
};

}  // namespace gazed::drivers
