// toml++ behind a door: its headers are dear to compile and are included in toml_parser.cpp alone.
#pragma once

#include "agent/base/source_text.hpp"
#include "agent/base/toml.hpp"

namespace gazed::base {

/// The tree of a text. Throws std::invalid_argument, "name:line: not TOML: ...", with the lines
/// that this is about.
[[nodiscard]] TomlTable parse_toml(const SourceText& source);

}  // namespace gazed::base
