// How the help of gazed and of gazelab looks.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <vector>

namespace gazed::settings {

/// What --help and --version say of themselves.
inline constexpr const char* help_description = "print this and exit";
inline constexpr const char* version_description = "print the version and exit";

/// CLI11's help with one empty line between sections, an option's argument without its type, and
/// its default behind its description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace gazed::settings
