// Any bytes as an LCM event log.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/log/log_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = memfd_create("log", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (ftruncate(file, 0) != 0 || pwrite(file, data, size, 0) != static_cast<ssize_t>(size))
    std::abort();
  gazed::log::LogReader reader(path, "IMAGE");
  std::size_t given = 0, messages = 0;
  while (const auto message = reader.next_message()) {
    given += message->size();
    // Each event has a header of 28 bytes, and a search goes on a byte further at least.
    if (++messages > size || message->size() > size) std::abort();
  }
  static_cast<void>(given);
  static_cast<void>(reader.notes());
  static_cast<void>(gazed::log::recorded_configuration(path, gazed::lcm::Channels("GAZED")));
  return 0;
}
