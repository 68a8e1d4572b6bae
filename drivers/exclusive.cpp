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

constexpr mode_t everybody = 0666;  // whoever runs gazed next must be able to lock and write it

/// "/dev/video0" as a file's name: "gazed-dev-video0.lock".
std::string lock_name(const std::string& path) {
  std::string name = "gazed";
  for (const char c : path) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  constexpr std::size_t longest = 200;  // a file's name has at most 255 bytes
  return name.substr(0, longest) + ".lock";
}

/// A link is locked by its own name, which it has before it is there, and as what it leads to.
std::vector<std::string> names_of(const std::string& resource) {
  std::error_code not_there;
  const std::string path = std::filesystem::weakly_canonical(resource, not_there).string();
  std::vector<std::string> names{lock_name(resource)};
  if (!not_there && lock_name(path) != names.front()) names.push_back(lock_name(path));
  return names;
}

/// Another's file that was given this name must not be emptied.
bool is_a_lock(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink <= 1;
}

/// Without O_CREAT at first: root may not open another's file in a sticky folder with it
/// (fs.protected_regular).
int open_lock(const std::string& file) {
  constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
  const int there = ::open(file.c_str(), flags);
  if (there >= 0 || errno != ENOENT) return there;
  const int made = ::open(file.c_str(), flags | O_CREAT, everybody);
  if (made >= 0) static_cast<void>(::fchmod(made, everybody));  // whatever the umask
  return made;
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
  for (const std::string& folder : folders) {
    int error = 0;
    std::string file;
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
  base::FileDescriptor lock(open_lock(file));
  if (lock.get() < 0) return errno;
  if (!is_a_lock(lock.get())) return EMLINK;
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return errno;
    throw InUse(resource + " is used by " + holder(lock.get()) + ", another gazed (" + file + ")");
  }
  const std::string pid = std::to_string(::getpid()) + "\n";
  // Where it cannot be written the lock holds all the same, without a name.
  static_cast<void>(::ftruncate(lock.get(), 0) == 0 &&
                    ::pwrite(lock.get(), pid.data(), pid.size(), 0) > 0);
  locks_.push_back(std::move(lock));
  return 0;
}

}  // namespace gazed::drivers
