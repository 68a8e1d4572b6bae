// The table of gazed's keys: one row a key, from which reading, checking, writing, help and error
// messages all come.
//
// Vocabulary. A slot points at the fields of Settings that a key stands for. An entry is a value
// that somebody gave a key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "agent/base/range.hpp"
#include "agent/settings/settings.hpp"
#include "agent/settings/value.hpp"

namespace gazed::settings {

/// The numbers that a key with an array stands for, in its order.
struct Numbers {
  std::array<double*, 5> at{};
  std::size_t count = 0;
  /// So many are enough, the rest is 0, and zeros may follow (base::assign_with_zeros); 0: exactly
  /// `count`.
  std::size_t fewest = 0;
};

using Slot =
    std::variant<bool*, int*, std::uint32_t*, double*, std::string*, std::optional<bool>*,
                 std::optional<int>*, geometry::CameraPosition*, saliency::SaliencyProfile*,
                 gaze::Plan*, cycle::LocateMethod*, PrintFormat*, PublishedImages*, sim::Pace*,
                 lola::OtherJoints*, drivers::Source*, Numbers>;

/// Allowed numbers; of an array, for each.
using Range = base::Range;

/// Allowed words; of an enumeration, in the order of its enumerators. "true" and "false" among them
/// are TOML's own, without quotes.
using Choices = std::span<const std::string_view>;

/// Allowed texts, in words and as a test.
struct TextRule {
  std::string_view allowed;
  bool (*accepts)(std::string_view text) = nullptr;
};

/// Nothing for true and false; of a source, the part that it is for.
using Allowed = std::variant<std::monostate, Range, Choices, TextRule, drivers::Part>;

struct Key {
  std::string_view path;  // "camera.width_px": its table, then its name
  std::string_view unit;  // empty: it has none
  std::string_view help;  // what it is, in a few words
  Slot (*slot)(Settings& settings);
  Allowed allowed{};

  [[nodiscard]] std::string_view table() const;  // "camera", "camera.controls"; "" for none
  [[nodiscard]] std::string_view name() const;   // "width_px"
};

/// All keys, grouped by table, in the order in which they are written.
[[nodiscard]] std::span<const Key> all_keys();
/// Null for a path that is no key.
[[nodiscard]] const Key* find_key(std::string_view path);

/// True for "camera", "camera.controls".
[[nodiscard]] bool is_table(std::string_view path);
/// The key, and the table, that somebody who wrote `path` may have meant; empty when there is none
/// like it.
[[nodiscard]] std::string nearest_key(std::string_view path);
[[nodiscard]] std::string nearest_table(std::string_view path);

/// A value that somebody gave a key.
struct Entry {
  const Key* key = nullptr;
  Value value;
  std::string text;       // the value as a message shows it
  std::string where;      // "robot.toml:12", "--camera"
  std::string excerpt{};  // of the file, to go behind a message: the line with a caret
};

/// Throws SettingsError for an unknown key, and for a string without a closing quote.
[[nodiscard]] Entry entry_of(const Assignment& assignment);

[[nodiscard]] bool is_allowed(const Key& key, const Value& value);
/// "camera.width_px: 12 found; allowed: 160 to 2560"; empty when the value is allowed.
[[nodiscard]] std::string refusal(const Entry& entry);

/// Sets the entry's key. Throws SettingsError, which begins with the place and ends with the
/// excerpt, when the value is not allowed.
void assign(Settings& settings, const Entry& entry);

/// What `key` is set to.
[[nodiscard]] Value read(Settings settings, const Key& key);

/// "160 to 2560", "top, bottom", "2 numbers, each 10 to 10000".
[[nodiscard]] std::string allowed_text(const Key& key);

}  // namespace gazed::settings
