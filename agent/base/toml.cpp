#include "agent/base/toml.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/base/toml_parser.hpp"

namespace gazed::base {

namespace {

constexpr std::size_t most_errors_shown = 100;

}  // namespace

const TomlMember* find_member(const TomlTable& table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &TomlMember::name);
  return found == table.end() ? nullptr : &*found;
}

TomlDocument::TomlDocument(std::string_view text, std::string name, std::size_t most_bytes)
    : source_(text.substr(0, most_bytes + 1), std::move(name)) {
  if (text.size() > most_bytes) {
    throw std::invalid_argument(source_.name() + ": longer than " + std::to_string(most_bytes) +
                                " bytes");
  }
  root_ = parse_toml(source_);
}

void TomlDocument::refuse(const TextPlace& place, std::string message) {
  errors_.push_back({place, std::move(message)});
}

void TomlDocument::check() const {
  if (errors_.empty()) return;
  std::vector<Error> errors = errors_;
  std::ranges::stable_sort(errors, {}, [](const Error& error) {
    return std::pair{error.place.line == 0, error.place};
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(errors.size(), most_errors_shown); ++i) {
    const auto& [place, message] = errors[i];
    text.append(text.empty() ? "" : "\n").append(source_.line_name(place)).append(": ");
    text.append(message).append(source_.excerpt_at(place));
  }
  if (errors.size() > most_errors_shown) {
    text.append("\n").append(source_.name()).append(": ");
    text.append(std::to_string(errors.size() - most_errors_shown)).append(" more of this kind");
  }
  throw std::invalid_argument(text);
}

}  // namespace gazed::base
