// Any words as gazed's command line, separated by line feeds.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "agent/settings/options.hpp"

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  std::istringstream lines(std::string(data, data + size));
  std::vector<std::string> words{"gazed"};
  for (std::string word; std::getline(lines, word);) words.push_back(word.c_str());
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const auto parsed = settings::parse_options(static_cast<int>(arguments.size()), arguments.data());
  const auto* options = std::get_if<settings::Options>(&parsed);
  // What stands in files is the other fuzzers'.
  if (options == nullptr || options->layers.file) return 0;
  fuzz::refusing([&] { static_cast<void>(settings::load_settings(options->layers, {})); });
  return 0;
}
