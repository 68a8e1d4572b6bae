#include "agent/base/toml.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>
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

std::string read_text(const std::string& file, std::size_t most_bytes) {
  const auto refuse = [&file] {
    return std::invalid_argument(excerpt(file, longest_file_name) +
                                 ": cannot be read: " + std::generic_category().message(errno));
  };
  const auto close = [](std::FILE* stream) { std::fclose(stream); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(std::fopen(file.c_str(), "rb"), close);
  if (!stream) throw refuse();
  std::string text(most_bytes + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stream.get()));
  if (std::ferror(stream.get()) != 0) throw refuse();
  return text;
}

}  // namespace gazed::base
