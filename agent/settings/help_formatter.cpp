#include "agent/settings/help_formatter.hpp"

#include <cstddef>
#include <utility>

namespace gazed::settings {

namespace {

constexpr std::size_t descriptions_begin_at = 24;  // column

void replace(std::string& text, const std::string& what, const char* by) {
  if (const std::size_t at = text.find(what); at != std::string::npos)
    text.replace(at, what.size(), by);
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(descriptions_begin_at);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = CLI::Formatter::make_usage(app, std::move(name));
  replace(usage, "[OPTIONS]", "[OPTION...]");
  replace(usage, "[SUBCOMMAND]", "COMMAND");
  const std::size_t begin = usage.find_first_not_of('\n');
  return '\n' + usage.substr(begin, usage.find_last_not_of('\n') + 1 - begin) + "\n\n";
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  // It begins with an empty line; CLI11 ends other groups with one, and not that of arguments.
  if (is_positional) group = "Arguments";
  const std::string text =
      CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  return text.substr(1) + (is_positional ? "\n" : "");
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0 || option->get_positional()) return "";
  const std::string type = option->get_type_name();
  return ' ' + type.substr(0, type.find(':'));
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  const std::string& value = option->get_default_str();
  return option->get_description() + (value.empty() ? "" : " (default " + value + ')');
}

}  // namespace gazed::settings
