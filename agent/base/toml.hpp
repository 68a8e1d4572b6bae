// TOML documents: values that know their places, and errors that show them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "agent/base/move_only_variant.hpp"
#include "agent/base/source_text.hpp"

namespace gazed::base {

struct TomlNode;
struct TomlMember;
using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlMember>;  // in the order of the text

struct TomlNode {
  /// Nothing for a date or a time, which nobody asks for.
  MoveOnlyVariant<std::monostate, bool, std::int64_t, double, std::string, TomlArray, TomlTable>
      value;
  TextPlace place;  // of a table or an array of tables: its header
};

struct TomlMember {
  std::string name;
  TextPlace name_place;
  TomlNode node;
};

/// Null when there is none.
[[nodiscard]] const TomlMember* find_member(const TomlTable& table, std::string_view name);

/// A text, its tree, and what its reader finds wrong with it.
class TomlDocument {
 public:
  /// `name` is what errors call the text. Throws std::invalid_argument, "name:line: not TOML: ...",
  /// for a text that is not, and for one longer than `most_bytes`.
  TomlDocument(std::string_view text, std::string name, std::size_t most_bytes);

  [[nodiscard]] const TomlTable& root() const { return root_; }
  [[nodiscard]] const SourceText& source() const { return source_; }

  /// Adds an error, "name:line: message", for check(). One that is about nowhere in the text comes
  /// last.
  void refuse(const TextPlace& place, std::string message);
  [[nodiscard]] bool is_refused() const { return !errors_.empty(); }
  /// Throws std::invalid_argument with all errors in the order of the text, each with the line that
  /// it is about, when there are any.
  void check() const;

 private:
  struct Error {
    TextPlace place;
    std::string message;
  };

  SourceText source_;
  TomlTable root_;
  std::vector<Error> errors_;
};

/// What a person writes is far shorter; a longer text is some other file, named by mistake.
inline constexpr std::size_t longest_written_toml = 65536;

}  // namespace gazed::base
