// Any text as TOML: what the guard lets through, toml++ must survive, and errors must find their
// places.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "agent/base/toml.hpp"
#include "agent/base/toml_guard.hpp"

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(base::unclosed_strings(text));
  static_cast<void>(base::end_of(text));
  fuzz::refusing([&] {
    base::TomlDocument document(text, "fuzz.toml", base::longest_written_toml);
    for (const base::TomlMember& member : document.root())
      document.refuse(member.name_place, member.name);
    document.check();
  });
  return 0;
}
