#include "agent/settings/toml.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <variant>

#include "agent/base/nearest.hpp"
#include "agent/base/regular_file.hpp"
#include "agent/base/text.hpp"
#include "agent/base/toml.hpp"
#include "agent/settings/costs.hpp"

namespace gazed::settings {
namespace {

class TomlReader {
 public:
  TomlReader(base::TomlDocument& document, IsWanted is_wanted)
      : document_(document), is_wanted_(is_wanted) {}

  std::vector<Entry> read() {
    read_table(document_.root(), "");
    document_.check();
    return std::move(entries_);
  }

 private:
  void read_table(const base::TomlTable& table, const std::string& prefix) {
    for (const base::TomlMember& member : table) {
      const std::string path = prefix + member.name;
      const bool is_bare = member.name.find('.') == std::string::npos;  // not "camera.width_px"
      const auto* inner = std::get_if<base::TomlTable>(&member.node.value);
      if (const Key* key = is_bare ? find_key(path) : nullptr) {
        if (is_wanted_ == nullptr || is_wanted_(path)) read_value(*key, member.node);
      } else if (!is_bare || !is_table(path)) {
        refuse_unknown(path, inner != nullptr, member.name_place);
      } else if (inner != nullptr) {
        read_table(*inner, path + ".");
      } else {
        document_.refuse(member.node.place,
                         base::text("%s: %s found; allowed: a table, [%s]", path.c_str(),
                                    shown_text(member.node).c_str(), path.c_str()));
      }
    }
  }

  void read_value(const Key& key, const base::TomlNode& node) {
    const base::SourceText& source = document_.source();
    entries_.push_back({&key, value_of(node), shown_text(node), source.line_name(node.place),
                        source.excerpt_at(node.place)});
    if (std::string why = refusal(entries_.back()); !why.empty())
      document_.refuse(node.place, std::move(why));
  }

  void refuse_unknown(const std::string& path, bool table, const base::TextPlace& place) {
    std::string nearest = table ? nearest_table(path) : nearest_key(path);
    if (table && !nearest.empty()) nearest = '[' + nearest + ']';
    document_.refuse(place, base::excerpt(path) + ": unknown " + (table ? "table" : "key") +
                                base::nearest_clause(nearest));
  }

  base::TomlDocument& document_;
  IsWanted is_wanted_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<Entry> read_toml(std::string_view text, const std::string& name, IsWanted is_wanted) {
  try {
    base::TomlDocument document(text, base::excerpt(name, base::longest_file_name),
                                base::longest_written_toml);
    return TomlReader(document, is_wanted).read();
  } catch (const std::invalid_argument& error) {
    throw SettingsError(error.what());
  }
}

std::vector<Entry> read_toml_file(const std::string& file) {
  try {
    return read_toml(base::read_text(file, base::longest_written_toml), file);
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
    if (const std::string_view cost = cost_of(key.path); !cost.empty())
      text.append(comment_column, ' ').append("# costs: ").append(cost).append("\n");
  }
  return text;
}

}  // namespace gazed::settings
