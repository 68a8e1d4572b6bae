#include "agent/settings/table.hpp"

#include <gtest/gtest.h>
#include <set>
#include <string>

#include "agent/settings/nearest.hpp"

namespace gazed {
namespace {

TEST(KeyTable, PathsAreUniqueAndTablesAreTogether) {
  std::set<std::string_view> paths;
  std::set<std::string_view> finished;
  std::string_view table;
  for (const Key& key : all_keys()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path;
    if (key.table() == table) continue;
    finished.insert(table);
    table = key.table();
    EXPECT_EQ(finished.count(table), 0U) << key.path << " is away from its table";
  }
}

TEST(KeyTable, EveryDefaultIsAllowed) {
  for (const Key& key : all_keys()) {
    Settings settings = default_settings();
    const Value value = read(settings, key);
    if (std::holds_alternative<std::monostate>(value)) continue;
    EXPECT_NO_THROW(assign(settings, {&key, value, "", "default"})) << key.path;
    EXPECT_EQ(read(settings, key), value) << key.path;
  }
}

TEST(KeyTable, EveryKeyIsAFieldOfItsOwn) {
  std::set<const void*> fields;
  Settings settings;
  for (const Key& key : all_keys()) {
    const auto insert = [&](const void* field) {
      EXPECT_TRUE(fields.insert(field).second) << key.path;
    };
    std::visit(Overloaded{[&](const Numbers& numbers) {
                            for (std::size_t i = 0; i < numbers.count; ++i) insert(numbers.at[i]);
                          },
                          [&](const auto* field) { insert(field); }},
               key.slot(settings));
  }
}

TEST(KeyTable, RobotsAreThoseWithAProfile) {
  std::string names;
  for (const std::string_view name : robot_names()) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  EXPECT_EQ(allowed_text(*find_key("robot")), names);
}

TEST(KeyTable, EndsOfARangeAreInside) {
  Settings settings;
  const Key& key = *find_key("head.margin_rad");
  EXPECT_NO_THROW(assign(settings, {&key, 0.0, "0", "test"}));
  EXPECT_NO_THROW(assign(settings, {&key, 0.2, "0.2", "test"}));
  EXPECT_THROW(assign(settings, {&key, 0.2000000001, "0.2000000001", "test"}), SettingsError);
}

TEST(KeyTable, RefusedValueChangesNothing) {
  Settings settings = default_settings();
  const Key& key = *find_key("camera.focal_px");
  EXPECT_THROW(assign(settings, {&key, std::vector<double>{500.0, -1.0}, "", "test"}),
               SettingsError);
  EXPECT_EQ(settings.camera.model.focal_px, Eigen::Vector2d(608, 608));
}

TEST(Value, NumbersAreShortAndStayNumbers) {
  EXPECT_EQ(toml_text(0.1), "0.1");
  EXPECT_EQ(toml_text(640.0), "640.0");
  EXPECT_EQ(toml_text(1e-7), "1e-07");
  EXPECT_EQ(toml_text(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(toml_text(std::vector<double>{-0.5, 2.0}), "[-0.5, 2.0]");
  EXPECT_EQ(plain_number(1048575), "1048575");
  EXPECT_EQ(plain_number(0.2), "0.2");
}

TEST(Value, TextIsEscaped) {
  EXPECT_EQ(toml_text(std::string("a\"b\\c")), R"("a\"b\\c")");
}

TEST(Value, OnlyUtf8WithoutControlCharactersIsPrintable) {
  EXPECT_TRUE(is_printable(""));
  EXPECT_TRUE(is_printable("K\u00f6rper \u673a \U0001F916"));
  EXPECT_FALSE(is_printable("a\tb"));
  EXPECT_FALSE(is_printable("\x7f"));
  EXPECT_FALSE(is_printable("\xc2\x85"));          // control, C1
  EXPECT_FALSE(is_printable("\xe4"));              // Latin-1
  EXPECT_FALSE(is_printable("\xc0\x80"));          // 0 in two bytes
  EXPECT_FALSE(is_printable("\xed\xa0\x80"));      // a surrogate
  EXPECT_FALSE(is_printable("\xf4\x90\x80\x80"));  // beyond Unicode
  EXPECT_FALSE(is_printable("\xe6\x9c"));          // cut
}

TEST(Value, ExcerptIsShortAndPrintable) {
  EXPECT_EQ(excerpt("a\nb\xff"), "a?b?");
  EXPECT_EQ(excerpt("abcdef", 3), "abc...");
  EXPECT_EQ(excerpt("\u673a\u673a", 2), "\u673a...");  // no character is cut
}

TEST(Nearest, CountsEdits) {
  Nearest nearest("--fixatoin");
  nearest.offer("", "nothing");
  nearest.offer("--seed", "--seed");
  nearest.offer("--fixations", "--fixations");
  nearest.offer("--profile", "--profile");
  EXPECT_EQ(nearest.result(), "--fixations");
}

}  // namespace
}  // namespace gazed
