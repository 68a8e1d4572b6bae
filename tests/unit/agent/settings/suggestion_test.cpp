// What a refusal guesses was meant.
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/agent/settings/settings_file.hpp"

namespace gazed::settings::suggestion_test {
namespace {

TEST(BadSettings, KeyOfAnotherTableIsFoundByItsName) {
  EXPECT_EQ(refusal_of("[saliency]\nlooks = 8\n"),
            "robot.toml:2: saliency.looks: unknown key; the nearest known is locate.looks");
  EXPECT_EQ(refusal_of("[saliency]\ninterest_in_everything = 8\n"),
            "robot.toml:2: saliency.interest_in_everything: unknown key");
}

TEST(BadSettings, AnglesInDegreesAreGuessed) {
  EXPECT_EQ(refusal_of("[head]\nzero_rad = [1.5, -0.2]\n"),
            "robot.toml:2: head.zero_rad: [1.5, -0.2] found; allowed: 2 numbers, each -0.5 to 0.5; "
            "degrees? in radians they are [0.0262, -0.0035]");
  EXPECT_EQ(refusal_of("[head]\nmargin_rad = 4\n"),
            "robot.toml:2: head.margin_rad: 4 found; allowed: 0 to 0.15; degrees? in radians it is "
            "0.0698");
}

TEST(BadSettings, LensesOfMoreNumbersAreTakenWhereTheyAreZero) {
  const std::string refusal =
      refusal_of("[camera]\ndistortion = [0.1, 0.2, 0, 0, 0.3, 0.4, 0, 0]\n");
  EXPECT_NE(refusal.find("the rational model is not gazed's: calibrate with 5"), std::string::npos)
      << refusal;
}

TEST(BadSettings, FileOfASourceNamesTheSource) {
  EXPECT_NE(
      refusal_of("[camera]\nsource = \"/dev/video0\"\n").find("; the nearest is v4l2:/dev/video0"),
      std::string::npos);
  EXPECT_NE(refusal_of("[head]\nsource = \"walk.lcm\"\n").find("; the nearest is log:walk.lcm"),
            std::string::npos);
}

}  // namespace
}  // namespace gazed::settings::suggestion_test
