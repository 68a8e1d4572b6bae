// How the help of gazed and of gazelab looks.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gazed::settings {

/// What --help and --version say of themselves.
inline constexpr const char* help_description = "print this and exit";
inline constexpr const char* version_description = "print the version and exit";

/// CLI11's help with one empty line between sections, an option's argument without its type, and
/// its default behind its description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(24); }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = CLI::Formatter::make_usage(app, std::move(name));
    replace(usage, "[OPTIONS]", "[OPTION...]");
    replace(usage, "[SUBCOMMAND]", "COMMAND");
    const std::size_t begin = usage.find_first_not_of('\n');
    return '\n' + usage.substr(begin, usage.find_last_not_of('\n') + 1 - begin) + "\n\n";
  }
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    // It begins with an empty line; CLI11 ends other groups with one, and not that of arguments.
    if (is_positional) group = "Arguments";
    const std::string text =
        CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
    return text.substr(1) + (is_positional ? "\n" : "");
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0 || option->get_positional()) return "";
    const std::string type = option->get_type_name();
    return ' ' + type.substr(0, type.find(':'));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string& value = option->get_default_str();
    return option->get_description() + (value.empty() ? "" : " (default " + value + ')');
  }

 private:
  static void replace(std::string& text, const std::string& what, const char* by) {
    if (const std::size_t at = text.find(what); at != std::string::npos)
      text.replace(at, what.size(), by);
  }
};

}  // namespace gazed::settings
