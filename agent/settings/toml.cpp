#include "agent/settings/toml.hpp"

#include <algorithm>

#include "agent/base/strict_toml.hpp"
#include "agent/base/text.hpp"

namespace gazed::settings {
namespace {

constexpr std::size_t longest_file = 65536;

class TomlReader {
 public:
  explicit TomlReader(std::string file) : file_(std::move(file)) {}

  std::vector<Entry> read(std::string_view text) {
    read_table(base::parse_toml(text, file_, longest_file), "");
    return std::move(entries_);
  }

 private:
  void read_table(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string path = prefix + std::string(name.str());
      const bool is_bare = name.str().find('.') == std::string_view::npos;  // not "camera.width_px"
      if (const Key* key = is_bare ? find_key(path) : nullptr) {
        Value value = value_of(node);
        std::string text = text_of(node, value);
        entries_.push_back({key, std::move(value), std::move(text), where(name.source())});
      } else if (!is_bare || !is_table(path)) {
        refuse_unknown(path, node.is_table(), where(name.source()));
      } else if (const toml::table* inner = node.as_table()) {
        read_table(*inner, path + ".");
      } else {
        throw SettingsError(where(name.source()) + ": " + path + ": " +
                            text_of(node, value_of(node)) + " found; allowed: a table, [" + path +
                            "]");
      }
    }
  }

  [[noreturn]] static void refuse_unknown(const std::string& path, bool table,
                                          const std::string& place) {
    const std::string nearest = table ? '[' + nearest_table(path) + ']' : nearest_key(path);
    throw SettingsError(place + ": " + base::excerpt(path) + ": unknown " +
                        (table ? "table" : "key") + "; the nearest known is " + nearest);
  }

  /// Nothing for what no key takes.
  static Value value_of(const toml::node& node) {
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* whole = node.as_integer()) return whole->get();
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* array = node.as_array()) return numbers(*array);
    return {};
  }

  static std::string text_of(const toml::node& node, const Value& value) {
    if (!std::holds_alternative<std::monostate>(value)) return base::excerpt(toml_text(value));
    return node.is_table() ? "a table" : node.is_array() ? "an array" : "a date or time";
  }

  /// Nothing for an array of anything else.
  static Value numbers(const toml::array& array) {
    std::vector<double> result;
    for (const toml::node& element : array) {
      const std::optional<double> number = element.value_exact<double>();
      const std::optional<std::int64_t> whole = element.value_exact<std::int64_t>();
      if (!number && !whole) return {};
      result.push_back(number ? *number : static_cast<double>(*whole));
    }
    return result;
  }

  [[nodiscard]] std::string where(const toml::source_region& region) const {
    return file_ + ':' + std::to_string(region.begin.line);
  }

  std::string file_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<Entry> read_toml(std::string_view text, const std::string& name) {
  try {
    return TomlReader(base::excerpt(name, base::longest_file_name)).read(text);
  } catch (const std::invalid_argument& error) {
    throw SettingsError(error.what());
  }
}

std::vector<Entry> read_toml_file(const std::string& file) {
  try {
    return read_toml(base::read_text(file, longest_file), file);
  } catch (const std::invalid_argument& error) {
    throw SettingsError(error.what());
  }
}

std::string to_toml(const Settings& settings) {
  constexpr std::size_t comment_column = 44;
  std::string text = "# The complete configuration of gazed. A key behind a # is not set.\n";
  std::string_view table;
  for (const Key& key : all_keys()) {
    if (key.table() != table) {
      table = key.table();
      text.append("\n[").append(table).append("]\n");
    }
    const std::string value = toml_text(read(settings, key));
    std::string line = (value.empty() ? "# " : "") + std::string(key.name()) + " = " + value;
    line.resize(std::max(line.size() + 2, comment_column), ' ');
    line.append("# ").append(key.help).append("; ").append(allowed_text(key));
    if (!key.unit.empty()) line.append(" ").append(key.unit);
    text += line + '\n';
  }
  return text;
}

}  // namespace gazed::settings
