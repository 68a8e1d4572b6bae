#include "agent/settings/option_words.hpp"

#include <CLI/Error.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"

namespace gazed::settings {

namespace {

/// As the command line has it: "--seed", or "IMAGE" for an argument by place.
std::string name_of(const CLI::Option& option) {
  return option.get_name();
}

/// The option whose name the error begins with, or has in it: the longest such name; null for none.
const CLI::Option* option_in(const CLI::App& command, std::string_view error) {
  const CLI::Option* found = nullptr;
  for (const CLI::Option* option : command.get_options()) {
    const bool longer = found == nullptr || name_of(*option).size() > name_of(*found).size();
    // CLI11 leaves the dashes out of what it says of flags.
    const std::string name = name_of(*option);
    std::string_view bare = name;
    bare.remove_prefix(std::min(bare.find_first_not_of('-'), bare.size()));
    const bool begins = !bare.empty() && error.starts_with(std::string(bare) + " ");
    const bool has = error.find(name) != std::string_view::npos;
    if (longer && (begins || has)) found = option;
  }
  return found;
}

/// The words of CLI::IsMember's "{table,sweep}".
std::vector<std::string> words_in(std::string_view set) {
  std::vector<std::string> words;
  set = set.substr(1, set.size() - 2);
  while (!set.empty()) {
    const std::size_t comma = std::min(set.find(','), set.size());
    words.emplace_back(set.substr(0, comma));
    set.remove_prefix(std::min(comma + 1, set.size()));
  }
  return words;
}

/// All that could have been written, and what of it is near to what was.
class KnownWords {
 public:
  explicit KnownWords(std::string_view written) : nearest_(written) {}

  void offer(const std::string& word) {
    list_ += (count_++ == 0 ? "" : ", ") + word;
    nearest_.offer(word, word);
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] std::string list() const { return "; allowed: " + list_; }
  [[nodiscard]] std::string nearest() const { return nearest_.clause(); }

 private:
  base::Nearest nearest_;
  std::string list_;
  int count_ = 0;
};

/// "; allowed: 2 to 1000000", "; allowed: table, sweep; the nearest known is table".
std::string allowed_by(const CLI::Option& option, const std::string& found) {
  std::string rule;
  try {
    rule = const_cast<CLI::Option&>(option).get_validator(0)->get_description();
  } catch (const CLI::OptionNotFound&) {
    return "; allowed: a number";  // the only type that CLI11 converts to here
  }
  if (!rule.starts_with('{')) {
    // "INT in [2 - 9]"
    const std::size_t begin = rule.find('['), dash = rule.find(" - "), end = rule.rfind(']');
    if (begin > dash || dash > end || end == std::string::npos) return "; allowed: " + rule;
    return "; allowed: " + rule.substr(begin + 1, dash - begin - 1) + " to " +
           rule.substr(dash + 3, end - dash - 3);
  }
  KnownWords known(found);
  for (const std::string& word : words_in(rule)) known.offer(word);
  return known.list() + known.nearest();
}

std::string wrong_value(const CLI::Option& option) {
  const std::string found = option.results().empty() ? "" : option.results().back();
  return name_of(option) + ": '" + base::excerpt(found) + "' found" + allowed_by(option, found);
}

std::string unknown_argument(const CLI::App& command, const std::string& argument,
                             const std::string& help) {
  const auto commands = command.get_subcommands([](const CLI::App*) { return true; });
  if (commands.empty())
    return "'" + base::excerpt(argument) + "': more arguments than wanted; see " + help;
  KnownWords known(argument);
  for (const CLI::App* one : commands) known.offer(one->get_name());
  return "'" + base::excerpt(argument) + "': unknown command" + known.list() + known.nearest();
}

}  // namespace

std::string unknown_option(const CLI::App& command, const std::string& argument,
                           const std::string& help) {
  const std::string written = argument.substr(0, argument.find('='));
  KnownWords known(written);
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = name_of(*option);
    if (name.starts_with('-')) known.offer(name);
  }
  constexpr int most_listed = 8;
  std::string clause = known.nearest();
  if (clause.empty())
    clause = known.count() <= most_listed ? known.list() : "; " + help + " lists them";
  return base::excerpt(argument) + ": unknown option" + clause;
}

std::string in_words(const CLI::App& command, const CLI::ParseError& error,
                     const std::string& help) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::vector<std::string> rest = command.remaining();
    // CLI11 gives what follows a "--" behind arguments to the program, which has no use for it.
    if (rest.empty() && command.get_parent() != nullptr &&
        !command.get_parent()->remaining().empty())
      return "'" + base::excerpt(command.get_parent()->remaining().front()) +
             "': behind a -- that follows other arguments; allowed: -- before all of them";
    if (rest.empty()) return base::excerpt(text);
    return rest.front().starts_with('-') ? unknown_option(command, rest.front(), help)
                                         : unknown_argument(command, rest.front(), help);
  }
  const CLI::Option* option = option_in(command, text);
  if (option == nullptr) return base::excerpt(text);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    return name_of(*option) + ": nothing found; it is needed, see " + help;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    if (option->get_expected_max() == 0) return name_of(*option) + ": takes no value";
    const std::string type = option->get_type_name();  // "N:UINT in [2 - 9]"
    return name_of(*option) + ": no value found; wanted: " + type.substr(0, type.find(':'));
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr ||
      dynamic_cast<const CLI::ValidationError*>(&error) != nullptr)
    return wrong_value(*option);
  return base::excerpt(text);
}

}  // namespace gazed::settings
