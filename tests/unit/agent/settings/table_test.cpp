#include "agent/settings/table.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "agent/geometry/limits.hpp"

namespace gazed::settings::table_test {
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
    EXPECT_NO_THROW(assign(settings, {&key, read(settings, key), "", "default"})) << key.path;
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
  for (const std::string_view name : geometry::robot_names) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  EXPECT_EQ(allowed_text(*find_key("robot")), names);
}

TEST(KeyTable, EndsOfARangeAreInside) {
  Settings settings;
  const Key& key = *find_key("head.margin_rad");
  EXPECT_NO_THROW(assign(settings, {&key, 0.0, "", "test"}));
  EXPECT_NO_THROW(assign(settings, {&key, geometry::max_margin_rad, "", "test"}));
  EXPECT_THROW(assign(settings, {&key, geometry::max_margin_rad + 1e-10, "", "test"}),
               SettingsError);
}

TEST(KeyTable, RefusedValueChangesNothing) {
  Settings settings = default_settings();
  const Key& key = *find_key("camera.focal_px");
  EXPECT_THROW(assign(settings, {&key, std::vector<double>{500.0, -1.0}, "", "test"}),
               SettingsError);
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(608, 608));
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

}  // namespace
}  // namespace gazed::settings::table_test
