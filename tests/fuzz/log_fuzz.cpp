// Any bytes as an LCM event log.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/log/log_reader.hpp"

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const gazed::fuzz::FileInMemory file;
  file.write({data, size});
  gazed::log::LogReader reader(file.path(), "IMAGE");
  std::size_t given = 0, messages = 0;
  while (const auto message = reader.next_message()) {
    given += message->size();
    // Each event has a header of 28 bytes, and a search goes on a byte further at least.
    if (++messages > size || message->size() > size) std::abort();
  }
  static_cast<void>(given);
  static_cast<void>(reader.notes());
  static_cast<void>(gazed::log::recorded_configuration(file.path(), gazed::lcm::Channels("GAZED")));
  return 0;
}
