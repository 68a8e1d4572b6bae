#include "agent/settings/help.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "agent/base/nearest.hpp"
#include "agent/base/text.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/settings/costs.hpp"
#include "agent/settings/table.hpp"

namespace gazed::settings {
namespace {

constexpr std::size_t name_width = 12;    // of "default", "allowed", ... and the space behind
constexpr std::size_t longest_line = 96;  // as the widest of --help's own

/// A line of "name   text", broken between words.
std::string field(std::string_view name, std::string_view text) {
  std::string line = "  " + std::string(name);
  line.resize(name_width, ' ');
  std::string out;
  while (line.size() + text.size() > longest_line) {
    const std::size_t space = text.rfind(' ', longest_line - name_width);
    if (space == std::string_view::npos || space == 0) break;
    out.append(line).append(text.substr(0, space)).append("\n");
    text.remove_prefix(space + 1);
    line.assign(name_width, ' ');
  }
  return out.append(line).append(text).append("\n");
}

std::string shown(const Value& value) {
  return std::holds_alternative<std::monostate>(value) ? "not set" : toml_text(value);
}

/// The default, or those of the robots: "nao-v3, nao-v4: 2.0".
std::string defaults(const Key& key) {
  std::vector<std::pair<std::string, std::string>> found;  // the value, and whose it is
  for (const std::string_view robot : geometry::robot_names) {
    const std::string value = shown(read(default_settings(robot), key));
    const auto same = std::ranges::find(found, value, &std::pair<std::string, std::string>::first);
    if (same == found.end()) {
      found.emplace_back(value, robot);
    } else {
      same->second.append(", ").append(robot);
    }
  }
  if (key.path == "robot") return field("default", toml_text(std::string(default_robot)));
  if (found.size() == 1) return field("default", found.front().first);
  std::string text;
  for (const auto& [value, robots] : found) {
    std::string line = value;
    line.append(" (").append(robots).append(")");
    text += field(text.empty() ? "default" : "", line);
  }
  return text;
}

std::string help_of(const Key& key) {
  std::string text = std::string(key.path) + ": " + std::string(key.help) + "\n\n";
  std::string allowed = allowed_text(key);
  if (!key.unit.empty()) allowed.append(" ").append(key.unit);
  text += field("allowed", allowed);
  text += defaults(key);
  if (const std::string_view cost = cost_of(key.path); !cost.empty()) text += field("costs", cost);
  const Value value = read(default_settings(), key);
  const std::string example =
      std::holds_alternative<std::monostate>(value) ? "VALUE" : toml_text(value);
  // The shell takes quotes, brackets and spaces for its own.
  const bool plain = example.find_first_of("\"[ ?") == std::string::npos;
  const std::string assignment = std::string(key.path) + "=" + example;
  text += field("set", "--set " + (plain ? assignment : "'" + assignment + "'"));
  const std::string table =
      key.table().empty() ? "at the top" : "under [" + std::string(key.table()) + "]";
  return text + field("or", std::string(key.name()) + " = " + example + "    " + table +
                                " in the file of --config");
}

std::string help_of_table(std::string_view table) {
  std::string text = "[" + std::string(table) + "]\n\n";
  std::size_t width = 0;
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) {
    if (key.table() != table && !key.table().starts_with(std::string(table) + '.')) continue;
    keys.push_back(&key);
    width = std::max(width, key.path.size());
  }
  for (const Key* key : keys) {
    std::string line = "  " + std::string(key->path);
    line.resize(width + 4, ' ');
    text.append(line).append(key->help).append("\n");
  }
  return text + "\ngazed --help KEY has each one's values, default and cost.\n";
}

/// The key of this name in whatever table; null where there is none, or more than one.
const Key* only_key_named(std::string_view name) {
  const Key* found = nullptr;
  for (const Key& key : all_keys()) {
    if (key.name() != name) continue;
    if (found != nullptr) return nullptr;
    found = &key;
  }
  return found;
}

}  // namespace

std::string key_help(std::string_view path) {
  if (const Key* key = find_key(path)) return help_of(*key);
  if (is_table(path)) return help_of_table(path);
  if (const Key* key = only_key_named(path)) return help_of(*key);
  throw SettingsError("--help: " + base::excerpt(path) + ": unknown key" +
                      base::nearest_clause(nearest_key(path)));
}

}  // namespace gazed::settings
