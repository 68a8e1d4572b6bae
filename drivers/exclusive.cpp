#include "drivers/exclusive.hpp"

#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gazed::drivers {

namespace {

/// Turns "/dev/video0" into a file name: "lock-dev-video0".
std::string lock_name(const std::string& path) {
  std::string name = "lock";
  for (const char c : path) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  constexpr std::size_t longest = 200;  // a file name has at most 255 bytes
  return name.substr(0, longest);
}

/// A symbolic link is locked under its own name, which exists even before the device does, and
/// under its target's.
std::vector<std::string> names_of(const std::string& resource) {
  std::error_code not_there;
  const std::string path = std::filesystem::weakly_canonical(resource, not_there).string();
  std::vector<std::string> names{lock_name(resource)};
  if (!not_there && lock_name(path) != names.front()) names.push_back(lock_name(path));
  return names;
}

/// Do not truncate another file that happens to have this name.
bool is_a_lock(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink <= 1;
}

/// Creates this user's private folder. Returns 0, or the errno of what failed; EPERM if it belongs
/// to, or is accessible to, somebody else.
int make_private(const std::string& folder) {
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) return errno;
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0) return errno;
  const bool is_ours = S_ISDIR(status.st_mode) && status.st_uid == ::geteuid();
  return is_ours && (status.st_mode & (S_IRWXG | S_IRWXO)) == 0 ? 0 : EPERM;
}

std::string holder(int descriptor) {
  std::array<char, 16> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string pid;
  for (ssize_t i = 0; i < size && std::isdigit(static_cast<unsigned char>(text[i])) != 0; ++i)
    pid += text[i];
  return pid.empty() ? "another process" : "process " + pid;
}

}  // namespace

ExclusiveUse::ExclusiveUse(const std::string& resource, const std::vector<std::string>& folders) {
  const std::vector<std::string> names = names_of(resource);
  std::string tried;
  for (const std::string& shared : folders) {
    const std::string folder = shared + "/gazed-" + std::to_string(::geteuid());
    int error = make_private(folder);
    std::string file = folder;
    for (auto name = names.begin(); error == 0 && name != names.end(); ++name) {
      file = folder + "/" + *name;
      error = lock(file, resource);
    }
    if (error == 0) return;
    tried += (tried.empty() ? "" : ", ") + file + ": " + std::strerror(error);
  }
  warning_ = "a second gazed on " + resource + " would not be noticed; no lock file can be made (" +
             tried + ")";
}

int ExclusiveUse::lock(const std::string& file, const std::string& resource) {
  constexpr int flags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
  base::FileDescriptor lock(::open(file.c_str(), flags, S_IRUSR | S_IWUSR));
  if (lock.get() < 0) return errno;
  if (!is_a_lock(lock.get())) return EMLINK;
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return errno;
    throw InUse(resource + " is used by " + holder(lock.get()) + ", another gazed (" + file + ")");
  }
  const std::string pid = std::to_string(::getpid()) + "\n";
  // If it cannot be written, the lock still works, but without the holder's id.
  static_cast<void>(::ftruncate(lock.get(), 0) == 0 &&
                    ::pwrite(lock.get(), pid.data(), pid.size(), 0) > 0);
  locks_.push_back(std::move(lock));
  return 0;
}

}  // namespace gazed::drivers
