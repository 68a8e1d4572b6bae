#include "agent/settings/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/settings/completion.hpp"
#include "agent/settings/help.hpp"
#include "agent/settings/help_formatter.hpp"
#include "agent/settings/option_words.hpp"
#include "agent/settings/table.hpp"

namespace gazed::settings {
namespace {

constexpr std::string_view about =
    "gazed finds the object that stands out in a NAO's head camera, turns the head, looks again,\n"
    "and says where the object is and how sure that is: on standard output and over LCM.";

constexpr std::string_view examples = R"(Examples:
  gazed --fixations 2                              the report's two tests on a simulated robot
  gazed --fixations 8 --seed 7 --print json        one JSON object a located point
  gazed --camera lcm --head lcm --robot nao-v5     somebody else's camera and head
  gazed --camera lcm --head lcm --record walk.lcm  ... and keep what they sent
  gazed --set locate.relative_sigma_goal=0.02      any key, here for a surer point by more looks
  gazed --set locate.method=report                 two looks, as the report has them, and its answer
  gazed --help locate.looks                        what a key is, may be, and costs
  gazed --camera v4l2 --head lcm                   the robot's own camera, V4L2's default device
  gazed --camera v4l2 --head lola                  a V6 with its own camera and joints
  gazed --camera naoqi --head naoqi                any NAO, through its NAOqi
  gazed --camera log:walk.lcm --head log:walk.lcm  the same points again, from the record
  gazed --camera lcm --head lcm --print-config > robot.toml    every key of a robot that nobody
                                                   calibrated, with what it may be; edit, then
  gazed --config robot.toml --check                see whether it is right

Every option is a key of the configuration file as well; the command line wins, and on it what
comes later.
Exit: 0 done or stopped, 1 a fault ended the run, 2 bad arguments or configuration.
)";

constexpr const char* devices_group = "Robot";
constexpr const char* run_group = "Run";
constexpr const char* simulation_group = "Simulation";
constexpr const char* configuration_group = "Configuration";

constexpr const char* set_flag = "--set";
constexpr const char* help_flags = "-h,--help";

/// An option that sets a key.
struct KeyOption {
  const char* flag;
  const char* group;
  const char* argument;  // as the help names it
  std::string_view key;
  const char* help;
};

constexpr auto key_options = std::to_array<KeyOption>({
    {"--robot", devices_group, "NAME", "robot", "which NAO"},
    {"--camera", devices_group, "SOURCE", "camera.source", "where frames come from"},
    {"--head", devices_group, "SOURCE", "head.source", "what moves and measures the head"},
    {"--fixations", run_group, "N", "run.fixations", "end after N points, 0 is never"},
    {"--profile", run_group, "NAME", "saliency.profile", "model of saliency"},
    {"--lcm-url", run_group, "URL", "lcm.url", "where messages go"},
    {"--record", run_group, "FILE.lcm", "run.record",
     "log of every frame and head state used, and of every fixation; an older one is kept as "
     "FILE.lcm.1"},
    {"--print", run_group, "FORMAT", "run.print", "how points are printed"},
    {"--scene", simulation_group, "FILE.toml", "sim.scene", "room and target"},
    {"--seed", simulation_group, "N", "sim.seed", "of everything random"},
});

/// The text of a default for the help; empty for one that is empty.
std::string default_text(const Key& key) {
  const Value value = read(default_settings(), key);
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : toml_text(value);
}

std::string help_text(const KeyOption& option) {
  const Key& key = *find_key(option.key);
  std::string text = option.help;
  if (std::holds_alternative<Choices>(key.allowed) ||
      std::holds_alternative<drivers::Part>(key.allowed)) {
    text += ": " + allowed_text(key);
  }
  const std::string_view environment = option.key == "lcm.url" ? "LCM_DEFAULT_URL, else " : "";
  const std::string value = default_text(key);
  if (!value.empty()) text.append(" (default ").append(environment).append(value).append(")");
  return text;
}

Exit refusal(std::string_view text) {
  return {2, "gazed: " + std::string(text) + '\n'};
}

constexpr const char* help_command = "gazed --help";

Exit refuse_unknown(const CLI::App& app, const std::string& argument) {
  if (!argument.starts_with('-')) {
    return refusal(base::excerpt(argument) + ": no option; gazed --help lists them");
  }
  return refusal(unknown_option(app, argument, help_command));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// What one option of `key_options`, or --set, says; none for another option.
std::optional<Assignment> assignment_of(const std::string& flag, const std::string& value) {
  if (flag == set_flag) return set_assignment(value);
  for (const KeyOption& option : key_options) {
    if (flag == option.flag) return Assignment{std::string(option.key), value, option.flag};
  }
  return std::nullopt;
}

/// What the options say that set keys, in the order of the command line, each allowed by its key;
/// throws SettingsError otherwise.
std::vector<Assignment> assignments_of(const CLI::App& app) {
  std::vector<Assignment> assignments;
  std::map<const CLI::Option*, std::size_t> seen;
  for (const CLI::Option* option : app.parse_order()) {
    const std::size_t occurrence = seen[option]++;
    if (occurrence >= option->results().size()) continue;
    const auto assignment = assignment_of(option->get_name(), option->results()[occurrence]);
    if (!assignment) continue;
    Settings scratch;
    assign(scratch, entry_of(*assignment));
    assignments.push_back(*assignment);
  }
  return assignments;
}

std::vector<Assignment> environment() {
  const char* url = std::getenv("LCM_DEFAULT_URL");
  if (url == nullptr || *url == '\0') return {};  // as LCM reads it
  return {{"lcm.url", url, "LCM_DEFAULT_URL"}};
}

void add_key_options(CLI::App& app) {
  for (const KeyOption& option : key_options) {
    app.add_option(option.flag)
        ->description(help_text(option))
        ->type_name(option.argument)
        ->group(option.group)
        ->take_last();
  }
}

std::string completion(const CLI::App& app) {
  std::vector<CompletedOption> options;
  for (const CLI::Option* option : app.get_options()) {
    const auto row = std::ranges::find_if(
        key_options, [&](const KeyOption& key) { return option->get_name() == key.flag; });
    options.push_back(
        {option->get_name(), row == key_options.end() ? std::string_view{} : row->key});
  }
  return bash_completion(options);
}

void add_other_options(CLI::App& app, Options& options) {
  app.add_option("--config", options.layers.file)
      ->description("keys and values; --print-config writes one")
      ->type_name("FILE.toml")
      ->group(configuration_group)
      ->take_last();
  app.add_option(set_flag)
      ->description("any key of the file, with a value as in it; once for each")
      ->type_name("KEY=VALUE")
      ->group(configuration_group)
      ->allow_extra_args(false)
      ->take_all();
  app.add_flag("--check", options.check, "read configuration and scene, open no device, and exit")
      ->group(configuration_group)
      ->disable_flag_override();
  app.add_flag("--print-config", options.print_config, "write the complete configuration and exit")
      ->group(configuration_group)
      ->disable_flag_override();
  app.add_flag("--release-head", options.release_head,
               "after a gazed was killed: make its head limp (lola, naoqi) and exit")
      ->group(devices_group)
      ->disable_flag_override();
  app.add_flag("--print-completion", options.print_completion,
               "write bash's completion of this command line and exit")
      ->group(configuration_group)
      ->disable_flag_override();
  app.set_version_flag("--version", "gazed " GAZED_VERSION, version_description)
      ->group(configuration_group);
  app.set_help_flag();  // CLI11's own takes no argument
  app.add_option(help_flags)
      ->description(std::string(help_description) +
                    "; of a key: what it is, may be and costs; of a table: its keys")
      ->type_name("[KEY]")
      ->group(configuration_group)
      ->expected(0, 1)
      ->take_last();
}

}  // namespace

Assignment set_assignment(std::string_view written) {
  const std::size_t equals = written.find('=');
  if (equals == std::string_view::npos || trimmed(written.substr(0, equals)).empty()) {
    throw SettingsError(std::string(set_flag) + ": " +
                        base::excerpt(toml_text(std::string(written))) +
                        " found; allowed: KEY=VALUE, as in locate.looks=8");
  }
  return {std::string(trimmed(written.substr(0, equals))),
          std::string(trimmed(written.substr(equals + 1))), set_flag, Written::as_toml};
}

std::variant<Options, Exit> parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app{std::string(about), "gazed"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(std::string(examples));
  app.allow_extras();  // refused below, with the nearest option
  add_key_options(app);
  add_other_options(app, options);
  try {
    app.parse(argc, argv);
    // Asked for by a filter: get_option() cannot say that there was no memory.
    const auto helps = app.get_options([](const CLI::Option* option) {
      return option->check_lname("help") && option->count() > 0;
    });
    if (!helps.empty()) {
      const CLI::Option* help = helps.front();
      const std::string key = help->results().empty() ? "" : help->results().back();
      return Exit{0, key.empty() ? app.help() : key_help(key)};
    }
    if (options.print_completion) return Exit{0, completion(app)};
    options.layers.environment = environment();
    options.layers.command_line = assignments_of(app);
    if (const auto unknown = app.remaining(); !unknown.empty()) {
      return refuse_unknown(app, unknown.front());
    }
  } catch (const CLI::CallForVersion&) {
    return Exit{0, app.version() + '\n'};
  } catch (const CLI::ParseError& error) {
    return refusal(in_words(app, error, help_command));
  } catch (const SettingsError& error) {
    return refusal(error.what());
  }
  return options;
}

}  // namespace gazed::settings
