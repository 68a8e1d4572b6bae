// What `gazed --help KEY` prints.
#pragma once

#include <string>
#include <string_view>

namespace gazed::settings {

/// All that is known of a key: what it is, what it may be, its default (of each robot where they
/// differ), its cost, and how it is set. Of a table ("saliency") a line for each of its keys. A
/// key's name without its table will do where no other key has it ("looks"). Throws SettingsError
/// for what is neither.
[[nodiscard]] std::string key_help(std::string_view path);

}  // namespace gazed::settings
