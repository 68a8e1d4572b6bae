// bash's completion of gazed's command line, of the table of keys.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gazed::settings {

/// An option of the command line, and the key that its argument is for; empty for none.
struct CompletedOption {
  std::string flag;
  std::string_view key{};
};

/// A script for bash that completes the options, the keys of --set and --help, and what each may
/// be: words, drivers, or the names of files.
[[nodiscard]] std::string bash_completion(std::span<const CompletedOption> options);

}  // namespace gazed::settings
