#include "agent/settings/help.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "agent/settings/costs.hpp"
#include "agent/settings/table.hpp"

namespace gazed::settings::help_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Help, EveryKeySaysWhatItIsAndMayBe) {
  for (const Key& key : all_keys()) {
    EXPECT_THAT(key_help(key.path),
                AllOf(StartsWith(std::string(key.path) + ": " + std::string(key.help) + '\n'),
                      HasSubstr("allowed   "), HasSubstr("default   "),
                      HasSubstr(std::string(key.path) + '=')))
        << key.path;
  }
}

TEST(Help, KeyThatCostsSomethingSaysWhat) {
  EXPECT_THAT(key_help("publish.images"), HasSubstr("costs     614 kB a frame"));
  EXPECT_THAT(key_help("lcm.prefix"), Not(HasSubstr("costs")));
}

TEST(Help, RobotsThatDifferHaveTheirOwnDefaults) {
  EXPECT_THAT(key_help("camera.focal_px"), AllOf(HasSubstr("[752.0, 752.0] (nao-v3)"),
                                                 HasSubstr("[557.0, 556.0] (nao-v4, nao-v5)")));
}

TEST(Help, TextForTheShellIsQuoted) {
  EXPECT_THAT(key_help("camera.focal_px"), HasSubstr("--set 'camera.focal_px=[608.0, 608.0]'\n"));
  EXPECT_THAT(key_help("locate.looks"), HasSubstr("--set locate.looks=6\n"));
}

TEST(Help, KeyThatIsNotSetHasNoDefault) {
  EXPECT_THAT(key_help("camera.controls.gain"),
              AllOf(HasSubstr("default   not set"), HasSubstr("camera.controls.gain=VALUE")));
}

TEST(Help, NameWithoutItsTableWillDoWhereItIsTheOnlyOne) {
  EXPECT_EQ(key_help("looks"), key_help("locate.looks"));
  EXPECT_THROW(static_cast<void>(key_help("source")), SettingsError);  // of camera, and of head
}

TEST(Help, TableListsItsKeysAndThoseBelow) {
  EXPECT_THAT(key_help("camera"),
              AllOf(HasSubstr("  camera.width_px "), HasSubstr("  camera.controls.gain "),
                    Not(HasSubstr("head."))));
}

TEST(Help, UnknownKeyNamesTheNearest) {
  try {
    static_cast<void>(key_help("locate.look"));
    FAIL();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "--help: locate.look: unknown key; the nearest known is locate.looks");
  }
}

TEST(Costs, EachIsOfAKey) {
  for (const Cost& cost : all_costs()) {
    EXPECT_NE(find_key(cost.path), nullptr) << cost.path;
    EXPECT_EQ(cost_of(cost.path), cost.text);
  }
}

TEST(Costs, PrintedConfigurationHasThemBelowTheirKeys) {
  EXPECT_THAT(to_toml(default_settings()),
              testing::ContainsRegex("\nimages = false +# [^\n]*\n +# costs: 614 kB a frame"));
}

}  // namespace
}  // namespace gazed::settings::help_test
