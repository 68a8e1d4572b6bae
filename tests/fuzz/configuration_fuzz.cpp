// Any text as gazed's configuration; what is accepted, written and read again must be the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "agent/settings/doubts.hpp"
#include "agent/settings/settings.hpp"

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  static const fuzz::FileInMemory file, again;
  file.write({data, size});
  fuzz::refusing([&] {
    const settings::Settings settings = settings::load_settings({{}, file.path(), {}}, {});
    static_cast<void>(settings::doubts(settings));
    const std::string written = settings::to_toml(settings);
    again.write({reinterpret_cast<const std::uint8_t*>(written.data()), written.size()});
    if (settings::to_toml(settings::load_settings({{}, again.path(), {}}, {})) != written)
      std::abort();
  });
  return 0;
}
