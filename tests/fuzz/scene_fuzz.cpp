// Any text as a simulator's scene, and any bytes as the picture of a texture.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/sim/mipmap.hpp"
#include "drivers/sim/scene.hpp"

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::refusing([&] { static_cast<void>(sim::parse_scene(text, "fuzz.toml")); });
  static const fuzz::FileInMemory file;
  file.write({data, size});
  fuzz::refusing([&] { static_cast<void>(sim::load_pnm(file.path())); });
  return 0;
}
