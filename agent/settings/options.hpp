// The command line of gazed.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "agent/settings/settings.hpp"

namespace gazed::settings {

/// What the command line and the environment ask for.
struct Options {
  SettingsLayers layers;
  bool check = false;             // read configuration and scene, open no device, end
  bool print_config = false;      // write the complete configuration, end
  bool print_completion = false;  // write bash's completion, end
  bool release_head = false;      // make a head limp that a killed gazed has left stiff, end
};

/// The program ends: code 0 with a text for standard output, else one for standard error.
struct Exit {
  int code = 0;
  std::string text;
};

/// Reads the command line, argv[0] being the program, and LCM_DEFAULT_URL. Every option but
/// --config, --check, --print-config and --release-head sets its key; a value that its key does not
/// allow is refused here already.
[[nodiscard]] std::variant<Options, Exit> parse_options(int argc, const char* const* argv);

/// What follows a --set: KEY=VALUE, the value as TOML has it. Throws SettingsError for anything
/// else.
[[nodiscard]] Assignment set_assignment(std::string_view written);

}  // namespace gazed::settings
