// What CLI11 finds wrong with a command line, in the words of the keys' messages: what was found,
// what is allowed, which known word is near.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace gazed::settings {

/// One line without a program's name. `command`: the program, or the subcommand that the error is
/// about, before or after the error was thrown. `help`: the command that lists all options, "gazed
/// --help".
[[nodiscard]] std::string in_words(const CLI::App& command, const CLI::ParseError& error,
                                   const std::string& help);

/// "--looks: unknown option; the nearest known is --look".
[[nodiscard]] std::string unknown_option(const CLI::App& command, const std::string& argument,
                                         const std::string& help);

}  // namespace gazed::settings
