#include "agent/settings/completion.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "agent/settings/table.hpp"

namespace gazed::settings {
namespace {

constexpr std::array<std::string_view, 2> keys_of_files{"run.record", "sim.scene"};

// bash breaks words at = and at :, so that a value and its key are two words with one between them.
constexpr std::string_view rest_of_script = R"(
_gazed_complete() {
  local i=$COMP_CWORD current=${COMP_WORDS[COMP_CWORD]} key= words= IFS=$' \t\n'
  COMPREPLY=()
  case $current in = | :) current= i=$((i + 1)) ;; esac
  local before=${COMP_WORDS[i - 1]}
  if [ "$before" = : ]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    compopt -o filenames
    return
  fi
  if [ "$before" = = ]; then
    before=${COMP_WORDS[i - 2]}
    [[ $before == -* ]] || key=$before
  fi
  if [ -z "$key" ]; then
    case $before in
      --set) words=$(printf '%s= ' $_gazed_keys) ;;
      -h | --help) words="$_gazed_keys $_gazed_tables" ;;
      --config) key=sim.scene ;;
      *)
        key=$(_gazed_key_of "$before")
        [ -n "$key" ] || words=$_gazed_options
        ;;
    esac
  fi
  if [ -n "$key" ]; then
    words=$(_gazed_values "$key")
    if [ "$words" = FILE ]; then
      mapfile -t COMPREPLY < <(compgen -f -- "$current")
      compopt -o filenames
      return
    fi
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  case ${COMPREPLY[0]-} in *= | *:) compopt -o nospace ;; esac
}
complete -F _gazed_complete gazed
)";

std::string joined(std::string_view so_far, std::string_view word) {
  return std::string(so_far).append(so_far.empty() ? "" : " ").append(word);
}

/// What can stand for a key, for the shell: words, FILE, or nothing where it is a number or a text.
std::string values_of(const Key& key) {
  if (std::ranges::find(keys_of_files, key.path) != keys_of_files.end()) return "FILE";
  if (std::holds_alternative<std::monostate>(key.allowed)) return "true false";
  std::string words;
  if (const auto* choices = std::get_if<Choices>(&key.allowed)) {
    for (const std::string_view word : *choices) words = joined(words, word);
  }
  if (const auto* part = std::get_if<drivers::Part>(&key.allowed)) {
    for (const drivers::DriverRow& driver : drivers::all_drivers()) {
      if (!driver.has(*part)) continue;
      words = joined(words, driver.name);
      if (driver.argument.need == drivers::Argument::Need::required) words += ':';
    }
  }
  return words;
}

/// A shell function that says for each of `cases` what belongs to it.
std::string function(std::string_view name, const std::string& cases) {
  return std::string(name) + "() {\n  case $1 in\n" + cases + "  esac\n}\n";
}

std::string one_case(std::string_view pattern, std::string_view answer) {
  return std::string("    ").append(pattern).append(") echo '").append(answer).append("' ;;\n");
}

}  // namespace

std::string bash_completion(std::span<const CompletedOption> options) {
  std::string flags, keys, tables, keys_of_options, values;
  for (const CompletedOption& option : options) {
    flags = joined(flags, option.flag);
    if (!option.key.empty()) keys_of_options += one_case(option.flag, option.key);
  }
  std::string_view table;
  for (const Key& key : all_keys()) {
    keys = joined(keys, key.path);
    if (key.table() != table) tables = joined(tables, table = key.table());
    if (const std::string words = values_of(key); !words.empty()) {
      values += one_case(key.path, words);
    }
  }
  return "# gazed's completion for bash: source <(gazed --print-completion)\n_gazed_options='" +
         flags + "'\n_gazed_keys='" + keys + "'\n_gazed_tables='" + tables + "'\n\n" +
         function("_gazed_key_of", keys_of_options) + function("_gazed_values", values) +
         std::string(rest_of_script);
}

}  // namespace gazed::settings
