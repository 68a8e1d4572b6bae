// What is refused, and in which words.
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "agent/settings/settings.hpp"

#include "tests/unit/agent/settings/settings_file.hpp"

namespace gazed::settings::refusal_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Bad input: place, key, value found, values allowed.

TEST(BadSettings, IntegerOutOfRange) {
  EXPECT_EQ(refusal_of("robot = \"nao-v6\"\n\n[camera]\nwidth_px = 12\n"),
            "robot.toml:4: camera.width_px: 12 found; allowed: 160 to 2560");
}

TEST(BadSettings, IntegerBeyond32Bits) {
  EXPECT_EQ(refusal_of("[run]\nfixations = 4294967297\n"),
            "robot.toml:2: run.fixations: 4294967297 found; allowed: 0 to 1000000000");
}

TEST(BadSettings, NumberOutOfRange) {
  EXPECT_EQ(
      refusal_of("[head]\nmargin_rad = 2.5\n"),
      "robot.toml:2: head.margin_rad: 2.5 found; allowed: 0 to 0.15; degrees? in radians it is "
      "0.04363");
}

TEST(BadSettings, NumberWhereAnIntegerBelongs) {
  EXPECT_EQ(refusal_of("[camera]\nheight_px = 480.0\n"),
            "robot.toml:2: camera.height_px: 480.0 found; allowed: an integer, 120 to 1920");
}

TEST(BadSettings, TextWhereANumberBelongs) {
  EXPECT_EQ(refusal_of("[head]\nspeed_fraction = \"fast\"\n"),
            "robot.toml:2: head.speed_fraction: \"fast\" found; allowed: a number, 0.01 to 1");
}

TEST(BadSettings, NumberWhereTextBelongs) {
  EXPECT_EQ(refusal_of("robot = 6\n"),
            "robot.toml:1: robot: 6 found; allowed: nao-v3, nao-v4, nao-v5, nao-v6");
  EXPECT_EQ(refusal_of("[run]\nrecord = 1\n"),
            "robot.toml:2: run.record: 1 found; allowed: a file name, or empty for none");
}

TEST(BadSettings, NumberWhereTrueOrFalseBelongs) {
  EXPECT_EQ(refusal_of("[publish]\nsaliency = 1\n"),
            "robot.toml:2: publish.saliency: 1 found; allowed: true or false");
  EXPECT_EQ(refusal_of("[publish]\nimages = 1\n"),
            "robot.toml:2: publish.images: 1 found; allowed: false, true, jpeg");
}

TEST(BadSettings, NotANumberAndInfinity) {
  EXPECT_EQ(refusal_of("[camera]\ndelay_s = nan\n"),
            "robot.toml:2: camera.delay_s: nan found; allowed: -1 to 1");
  EXPECT_EQ(refusal_of("[camera]\ndelay_s = -inf\n"),
            "robot.toml:2: camera.delay_s: -inf found; allowed: -1 to 1");
  EXPECT_EQ(refusal_of("[head]\nzero_rad = [0, nan]\n"),
            "robot.toml:2: head.zero_rad: [0.0, nan] found; allowed: 2 numbers, each -0.5 to 0.5");
}

TEST(BadSettings, ArrayOfTheWrongLength) {
  EXPECT_EQ(refusal_of("[camera]\nfocal_px = [600]\n"),
            "robot.toml:2: camera.focal_px: [600.0] found; allowed: 2 numbers, each 10 to 10000");
  EXPECT_EQ(refusal_of("[camera]\nfocal_px = 600\n"),
            "robot.toml:2: camera.focal_px: 600 found; allowed: 2 numbers, each 10 to 10000");
}

TEST(BadSettings, ArrayOfTheWrongType) {
  EXPECT_EQ(refusal_of("[camera]\nfocal_px = [600, \"601\"]\n"),
            "robot.toml:2: camera.focal_px: an array found; allowed: 2 numbers, each 10 to 10000");
}

TEST(BadSettings, DateAndTable) {
  EXPECT_EQ(refusal_of("[sim]\nseed = 2011-07-07\n"),
            "robot.toml:2: sim.seed: a date or time found; allowed: an integer, 0 to 4294967295");
  EXPECT_EQ(refusal_of("[robot]\nname = \"nao-v6\"\n"),
            "robot.toml:1: robot: a table found; allowed: nao-v3, nao-v4, nao-v5, nao-v6");
  EXPECT_EQ(refusal_of("[[camera]]\nwidth_px = 640\n"),
            "robot.toml:1: camera: an array found; allowed: a table, [camera]");
  EXPECT_EQ(refusal_of("camera = \"sim\"\n"),
            "robot.toml:1: camera: \"sim\" found; allowed: a table, [camera]");
}

TEST(BadSettings, UnknownWord) {
  EXPECT_EQ(refusal_of("[saliency]\nprofile = \"itti\"\n"),
            "robot.toml:2: saliency.profile: \"itti\" found; allowed: report, robust, surround");
  EXPECT_EQ(refusal_of("[camera]\nposition = \"left\"\n"),
            "robot.toml:2: camera.position: \"left\" found; allowed: top, bottom");
}

TEST(BadSettings, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(refusal_of("[camera]\nwidht_px = 640\n"),
            "robot.toml:2: camera.widht_px: unknown key; the nearest known is camera.width_px");
  EXPECT_EQ(refusal_of("width_px = 640\n"),
            "robot.toml:1: width_px: unknown key; the nearest known is camera.width_px");
  EXPECT_EQ(refusal_of("\"camera.width_px\" = 640\n"),
            "robot.toml:1: camera.width_px: unknown key; the nearest known is camera.width_px");
}

TEST(BadSettings, UnknownTableNamesTheNearest) {
  EXPECT_EQ(refusal_of("\n[camra]\nwidth_px = 640\n"),
            "robot.toml:2: camra: unknown table; the nearest known is [camera]");
  EXPECT_EQ(refusal_of("[camera.control]\ngain = 6\n"),
            "robot.toml:1: camera.control: unknown table; the nearest known is [camera.controls]");
}

TEST(BadSettings, SourcesThatAreNone) {
  const std::string allowed = " found; allowed: sim, lcm, log:FILE";
  const std::string naoqi = ", naoqi, naoqi:ADDRESS, naoqi:ADDRESS:PORT";
  // A name would have to be looked up, which nothing in gazed's loop may wait for.
  for (const std::string source :
       {"lola", "v4l2:", "log:", "naoqi:", "naoqi:nao.local", "naoqi:127.0.0.1:0"}) {
    EXPECT_EQ(
        refusal_of("[camera]\nsource = \"" + source + "\"\n"),
        "robot.toml:2: camera.source: \"" + source + '"' + allowed + ", v4l2, v4l2:DEVICE" + naoqi);
  }
  for (const std::string source : {"v4l2", "log:", "lola:", "naoqi:nao.local:9559"}) {
    EXPECT_EQ(
        refusal_of("[head]\nsource = \"" + source + "\"\n"),
        "robot.toml:2: head.source: \"" + source + '"' + allowed + ", lola, lola:SOCKET" + naoqi);
  }
}

TEST(BadSettings, WhatNoVersionWillHave) {
  EXPECT_EQ(refusal_of("[locate]\nlooks = 1\n"),
            "robot.toml:2: locate.looks: 1 found; allowed: 2 to 16");
  EXPECT_EQ(refusal_of("[locate]\nlooks = 17\n"),
            "robot.toml:2: locate.looks: 17 found; allowed: 2 to 16");
  EXPECT_EQ(refusal_of("[locate]\nplan = \"best\"\n"),
            "robot.toml:2: locate.plan: \"best\" found; allowed: report, parallax");
}

TEST(BadSettings, ChannelPrefixAndUrl) {
  EXPECT_EQ(refusal_of("[lcm]\nprefix = \"GA ZED\"\n"),
            "robot.toml:2: lcm.prefix: \"GA ZED\" found; allowed: 1 to 40 letters, digits and _");
  EXPECT_THAT(refusal_of("[lcm]\nurl = \"239.255.76.67\"\n"),
              StartsWith("robot.toml:2: lcm.url: \"239.255.76.67\" found; allowed: udpm://"));
}

TEST(BadSettings, ControlCharactersDoNotReachTheMessage) {
  EXPECT_EQ(refusal_of("[run]\nrecord = \"a\\u0000b\\n\"\n"),
            "robot.toml:2: run.record: \"a?b?\" found; allowed: a file name, or empty for none");
}

TEST(BadSettings, NotToml) {
  EXPECT_THAT(refusal_of("[camera]\nwidth_px 640\n"), StartsWith("robot.toml:2: not TOML: "));
  EXPECT_THAT(refusal_of("[run]\nprint = \"text\n"), StartsWith("robot.toml:2: not TOML: "));
  EXPECT_THAT(refusal_of("[sim]\nseed = 1\nseed = 2\n"), StartsWith("robot.toml:3: not TOML: "));
  EXPECT_THAT(refusal_of("\xff\xfe"), HasSubstr("not TOML: "));
}

TEST(BadSettings, MissingFile) {
  const SettingsFile file;
  EXPECT_EQ(refusal_of(file.layers(), file),
            "robot.toml: cannot be read: No such file or directory");
}

TEST(BadSettings, FolderForAFile) {
  const SettingsFile file;
  SettingsLayers layers;
  layers.file = file.folder();
  EXPECT_EQ(refusal_of(layers, file),
            file.folder() + ": cannot be read: a folder; a regular file is needed");
}

TEST(BadSettings, FileTooLong) {
  EXPECT_EQ(refusal_of(std::string(65537, '\n')), "robot.toml: longer than 65536 bytes");
  EXPECT_EQ(refusal_of(std::string(65536, '\n')), "accepted");
}

TEST(BadSettings, LetterThatTheParserDoesNotSurvive) {
  EXPECT_EQ(refusal_of("[run]\nfixations = \xc3\xa9\n"),
            "robot.toml:2: not TOML: a letter outside ASCII, outside strings and comments");
}

TEST(BadSettings, TreeTooDeepForTheParser) {
  std::string name = "a";
  for (int i = 0; i < 20000; ++i) name += ".a";
  EXPECT_EQ(refusal_of(name + " = 1\n"), "robot.toml:1: not TOML: too many dotted names");
  EXPECT_THAT(refusal_of("a = " + std::string(30000, '[')), HasSubstr("not TOML: "));
}

// How it is shown.

TEST(RefusalShown, LineWithACaretUnderTheValue) {
  EXPECT_EQ(whole_refusal_of("robot = \"nao-v6\"\n\n[camera]\nwidth_px = 12  # too few\n"),
            "robot.toml:4: camera.width_px: 12 found; allowed: 160 to 2560\n"
            "   4:12 | width_px = 12  # too few\n"
            "        |            ^^");
}

TEST(RefusalShown, LineWithACaretUnderTheKey) {
  EXPECT_EQ(whole_refusal_of("[camera]\n  widht_px = 640\n"),
            "robot.toml:2: camera.widht_px: unknown key; the nearest known is camera.width_px\n"
            "    2:3 |   widht_px = 640\n"
            "        |   ^^^^^^^^");
}

TEST(RefusalShown, AllThatIsWrongInTheOrderOfTheFile) {
  EXPECT_EQ(whole_refusal_of("[sim]\n"
                             "seed = -1\n"
                             "[camra]\n"
                             "width_px = 640\n"
                             "[camera]\n"
                             "focal_px = [600,\n"
                             "            \"601\"]\n"
                             "position = \"left\"\n"
                             "widht_px = 3\n"),
            "robot.toml:2: sim.seed: -1 found; allowed: 0 to 4294967295\n"
            "    2:8 | seed = -1\n"
            "        |        ^^\n"
            "robot.toml:3: camra: unknown table; the nearest known is [camera]\n"
            "    3:2 | [camra]\n"
            "        |  ^^^^^\n"
            "robot.toml:6: camera.focal_px: an array found; allowed: 2 numbers, each 10 to 10000\n"
            "   6:12 | focal_px = [600,\n"
            "        |            ^^^^^\n"
            "robot.toml:8: camera.position: \"left\" found; allowed: top, bottom\n"
            "   8:12 | position = \"left\"\n"
            "        |            ^^^^^^\n"
            "robot.toml:9: camera.widht_px: unknown key; the nearest known is camera.width_px\n"
            "    9:1 | widht_px = 3\n"
            "        | ^^^^^^^^");
}

TEST(RefusalShown, SyntaxErrorAlone) {
  EXPECT_EQ(whole_refusal_of("[camera]\nwidth_px = 12\nposition = \"top\n"),
            "robot.toml:3: not TOML: the string that begins at robot.toml:3:12 has no closing "
            "quote\n"
            "   3:12 | position = \"top\n"
            "        |            ^");
}

TEST(RefusalShown, KeyGivenTwice) {
  EXPECT_EQ(whole_refusal_of("[sim]\nseed = 1\nseed = 2\n"),
            "robot.toml:3: not TOML: sim.seed is given twice; first given at robot.toml:2:1\n"
            "    3:1 | seed = 2\n"
            "        | ^^^^\n"
            "    2:1 | seed = 1\n"
            "        | ^^^^ first");
}

TEST(RefusalShown, WhatNoKeyCanTellAlone) {
  EXPECT_EQ(whole_refusal_of("[locate]\nrange_min_m = 3\nrange_max_m = 2\n"),
            "robot.toml:2: locate.range_min_m: 3.0 found; allowed: range_min_m below range_max_m\n"
            "   2:15 | range_min_m = 3\n"
            "        |               ^");
}

// What no key can tell alone.

TEST(BadTogether, LogForOneDeviceOnly) {
  EXPECT_EQ(refusal_of("[camera]\nsource = \"log:walk.lcm\"\n"),
            "robot.toml:2: camera.source: \"log:walk.lcm\" found; allowed: log:FILE for camera and "
            "head (no other head moves as the recorded one did)");
  EXPECT_EQ(refusal_of("[camera]\nsource = \"lcm\"\n[head]\nsource = \"log:walk.lcm\"\n"),
            "robot.toml:4: head.source: \"log:walk.lcm\" found; allowed: log:FILE for camera and "
            "head (no other camera turns with a recorded head)");
  const Settings both =
      load_text("[camera]\nsource = \"log:walk.lcm\"\n[head]\nsource = \"log:walk.lcm\"\n");
  EXPECT_EQ(both.head.source.argument(), "walk.lcm");
}

TEST(BadTogether, RecordOverTheLogThatIsRead) {
  const std::string log =
      "[camera]\nsource = \"log:walk.lcm\"\n[head]\nsource = \"log:walk.lcm\"\n";
  EXPECT_EQ(refusal_of(log + "[run]\nrecord = \"walk.lcm\"\n"),
            "robot.toml:6: run.record: \"walk.lcm\" found; allowed: another file than the log that "
            "is read");
  EXPECT_EQ(refusal_of(log + "[run]\nrecord = \"walk2.lcm\"\n"), "accepted");
}

TEST(BadTogether, RecordOverTheLogByAnotherName) {
  const SettingsFile file;
  file.write("");
  const std::string log = "log:" + file.folder() + "/../" +
                          std::filesystem::path(file.folder()).filename().string() + "/robot.toml";
  SettingsLayers layers;
  layers.command_line = {{"camera.source", log, "--camera"},
                         {"head.source", log, "--head"},
                         {"run.record", file.path(), "--record"}};
  EXPECT_THAT(refusal_of(layers, file), StartsWith("--record: run.record: "));
}

TEST(BadTogether, PrincipalPointOutsideTheImage) {
  EXPECT_EQ(refusal_of("[camera]\ncentre_px = [700, 240]\n"),
            "robot.toml:2: camera.centre_px: [700.0, 240.0] found; allowed: inside the image, 0 to "
            "639 and 0 to 479");
}

TEST(BadTogether, RangesTheWrongWayRound) {
  EXPECT_EQ(refusal_of("[locate]\nrange_min_m = 3\nrange_max_m = 2\n"),
            "robot.toml:2: locate.range_min_m: 3.0 found; allowed: range_min_m below range_max_m");
  EXPECT_EQ(refusal_of("[locate]\nrange_max_m = 0.05\n"),
            "robot.toml:2: locate.range_max_m: 0.05 found; allowed: range_min_m below range_max_m");
}

TEST(BadTogether, NoConspicuityMapHasWeight) {
  EXPECT_EQ(refusal_of("[saliency]\nweights = [0, 0]\n"),
            "robot.toml:2: saliency.weights: [0.0, 0.0] found; allowed: at least one above 0");
}

TEST(BadTogether, NoOpponentHasWeight) {
  EXPECT_EQ(
      refusal_of("[saliency]\nopponent_weights = [0, 0]\n"),
      "robot.toml:2: saliency.opponent_weights: [0.0, 0.0] found; allowed: at least one above "
      "0; weights = [1, 0] leaves colour out");
}

}  // namespace
}  // namespace gazed::settings::refusal_test
