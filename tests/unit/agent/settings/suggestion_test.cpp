// What a refusal guesses was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/agent/settings/settings_file.hpp"

namespace gazed::settings::suggestion_test {
namespace {

using testing::HasSubstr;

TEST(BadSettings, KeyOfAnotherTableIsFoundByItsName) {
  EXPECT_EQ(refusal_of("[saliency]\nlooks = 8\n"),
            "robot.toml:2: saliency.looks: unknown key; the nearest known is locate.looks");
  EXPECT_EQ(refusal_of("[saliency]\ninterest_in_everything = 8\n"),
            "robot.toml:2: saliency.interest_in_everything: unknown key");
}

TEST(BadSettings, AnglesInDegreesAreGuessed) {
  EXPECT_EQ(refusal_of("[head]\nzero_rad = [1.5, -0.2]\n"),
            "robot.toml:2: head.zero_rad: [1.5, -0.2] found; allowed: 2 numbers, each -0.5 to 0.5; "
            "degrees? in radians they are [0.02618, -0.003491]");
  EXPECT_EQ(refusal_of("[head]\nmargin_rad = 4\n"),
            "robot.toml:2: head.margin_rad: 4 found; allowed: 0 to 0.15; degrees? in radians it is "
            "0.06981");
}

TEST(BadSettings, NumberInAnotherUnit) {
  EXPECT_THAT(refusal_of("[camera]\nmount_offset_m = [58.7, 0, 63.6]\n"),
              HasSubstr("millimetres? in metres they are [0.0587, 0, 0.0636]"));
  EXPECT_THAT(refusal_of("[camera]\nreadout_s = 37\n"),
              HasSubstr("allowed: 0 to 1; milliseconds? in seconds it is 0.037"));
  EXPECT_THAT(refusal_of("[head]\nsettle_velocity_rad_s = 20\n"),
              HasSubstr("degrees a second? in radians a second it is 0.3491"));
  EXPECT_THAT(refusal_of("[camera.controls]\nwhite_balance = -1\n"),
              HasSubstr("-1 found; allowed: 0 to 20000 K"));
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
