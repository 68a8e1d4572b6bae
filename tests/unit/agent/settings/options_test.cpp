#include "agent/settings/options.hpp"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <variant>
#include <vector>

#include "agent/settings/table.hpp"

#include "tests/unit/agent/settings/settings_file.hpp"

namespace gazed::settings::options_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The environment of the person who runs the tests has no say.
class OptionsTest : public testing::Test {
 protected:
  OptionsTest() { unsetenv("LCM_DEFAULT_URL"); }

  static std::variant<Options, Exit> parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "gazed");
    return parse_options(static_cast<int>(arguments.size()), arguments.data());
  }

  static Settings load(const std::vector<const char*>& arguments) {
    const auto result = parse(arguments);
    if (const auto* exit = std::get_if<Exit>(&result)) throw std::runtime_error(exit->text);
    return load_settings(std::get<Options>(result).layers, nothing_stated);
  }

  static void expect_refusal(const std::vector<const char*>& arguments,
                             const std::string& message) {
    const auto result = parse(arguments);
    ASSERT_TRUE(std::holds_alternative<Exit>(result)) << message;
    EXPECT_EQ(std::get<Exit>(result).code, 2);
    EXPECT_EQ(std::get<Exit>(result).text, "gazed: " + message + '\n');
  }
};

TEST_F(OptionsTest, NothingIsTheDefaults) {
  EXPECT_EQ(to_toml(load({})), to_toml(default_settings()));
}

TEST_F(OptionsTest, EveryOptionSetsItsKey) {
  const Settings settings =
      load({"--robot",   "nao-v5",  "--camera", "lcm",         "--head",  "sim",       "--scene",
            "room.toml", "--seed",  "7",        "--fixations", "3",       "--profile", "report",
            "--lcm-url", "memq://", "--record", "a b.lcm",     "--print", "json"});
  EXPECT_EQ(settings.robot, "nao-v5");
  EXPECT_EQ(settings.camera.source.text(), "lcm");
  EXPECT_EQ(settings.head.source.text(), "sim");
  EXPECT_EQ(settings.sim.scene, "room.toml");
  EXPECT_EQ(settings.sim.seed, 7U);
  EXPECT_EQ(settings.run.fixations, 3);
  EXPECT_EQ(settings.cycle.saliency.profile, saliency::SaliencyProfile::report);
  EXPECT_EQ(settings.lcm.url, "memq://");
  EXPECT_EQ(settings.run.record, "a b.lcm");
  EXPECT_EQ(settings.run.print, PrintFormat::json);
}

TEST_F(OptionsTest, EqualsSignAndTheLastOneCounts) {
  EXPECT_EQ(load({"--seed=7", "--seed", "9"}).sim.seed, 9U);
}

TEST_F(OptionsTest, FileNameThatLooksLikeANumberIsAName) {
  EXPECT_EQ(load({"--record", "2011"}).run.record, "2011");
}

TEST_F(OptionsTest, FlagsAndFile) {
  const auto result = parse({"--config", "robot.toml", "--check", "--print-config"});
  const auto& options = std::get<Options>(result);
  EXPECT_EQ(options.layers.file, "robot.toml");
  EXPECT_TRUE(options.check);
  EXPECT_TRUE(options.print_config);
  EXPECT_FALSE(std::get<Options>(parse({})).layers.file.has_value());
}

TEST_F(OptionsTest, UrlOfTheEnvironmentIsTheWeakest) {
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(load({}).lcm.url, "memq://");
  EXPECT_EQ(load({"--lcm-url", "file://a.lcm"}).lcm.url, "file://a.lcm");
  setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(load({}).lcm.url, "udpm://239.255.76.67:7667?ttl=0");
  setenv("LCM_DEFAULT_URL", "nonsense", 1);
  EXPECT_THROW(static_cast<void>(load({})), SettingsError);
}

TEST_F(OptionsTest, Version) {
  const auto result = parse({"--version"});
  EXPECT_EQ(std::get<Exit>(result).code, 0);
  EXPECT_EQ(std::get<Exit>(result).text, "gazed 0.2.0\n");
}

TEST_F(OptionsTest, HelpNamesEveryOptionAndDefault) {
  const auto result = parse({"--help"});
  EXPECT_EQ(std::get<Exit>(result).code, 0);
  const std::string& text = std::get<Exit>(result).text;
  for (const char* option :
       {"--config FILE.toml", "--robot NAME",      "--camera SOURCE", "--head SOURCE",
        "--scene FILE.toml",  "--seed N",          "--fixations N",   "--profile NAME",
        "--lcm-url URL",      "--record FILE.lcm", "--print FORMAT",  "--check",
        "--print-config",     "--set KEY=VALUE",   "--version",       "--help",
        "(default nao-v6)",   "(default sim)",     "(default text)",  "(default 1)",
        "(default surround)", "LCM_DEFAULT_URL",   "Examples:"}) {
    EXPECT_THAT(text, HasSubstr(option));
  }
}

TEST_F(OptionsTest, ExamplesOfTheHelpAreRight) {
  const std::string text = std::get<Exit>(parse({"--help"})).text;
  EXPECT_EQ(load({"--fixations", "2"}).run.fixations, 2);
  EXPECT_NO_THROW(load({"--fixations", "8", "--seed", "7", "--print", "json"}));
  EXPECT_NO_THROW(load({"--camera", "lcm", "--head", "lcm", "--robot", "nao-v5"}));
  EXPECT_NO_THROW(load({"--camera", "lcm", "--head", "lcm", "--record", "walk.lcm"}));
  EXPECT_EQ(load({"--set", "locate.relative_sigma_goal=0.02"}).cycle.locate.relative_sigma_goal,
            0.02);
  EXPECT_EQ(load({"--set", "locate.method=report"}).cycle.locate.method,
            cycle::LocateMethod::report);
  EXPECT_NO_THROW(load({"--camera", "log:walk.lcm", "--head", "log:walk.lcm"}));
}

TEST_F(OptionsTest, HelpOfAKey) {
  for (const std::vector<const char*>& arguments :
       {std::vector<const char*>{"--help", "locate.looks"},
        {"-h", "locate.looks"},
        {"--help=locate.looks"},
        {"--seed", "7", "--help", "looks"}}) {
    const auto result = parse(arguments);
    EXPECT_EQ(std::get<Exit>(result).code, 0);
    EXPECT_THAT(std::get<Exit>(result).text, StartsWith("locate.looks: "));
  }
  expect_refusal({"--help", "looky"},
                 "--help: looky: unknown key; the nearest known is locate.looks");
}

TEST_F(OptionsTest, HelpBesideOptionsIsTheWholeHelp) {
  EXPECT_EQ(std::get<Exit>(parse({"--help", "--check"})).text,
            std::get<Exit>(parse({"--help"})).text);
}

TEST_F(OptionsTest, CompletionKnowsOptionsKeysAndWords) {
  const auto result = parse({"--print-completion"});
  EXPECT_EQ(std::get<Exit>(result).code, 0);
  for (const char* line :
       {"--print-config", "locate.looks", "--profile) echo 'saliency.profile'",
        "saliency.profile) echo 'report robust surround'", "sim.scene) echo 'FILE'"}) {
    EXPECT_THAT(std::get<Exit>(result).text, HasSubstr(line));
  }
}

TEST_F(OptionsTest, UnknownOptionNamesTheNearest) {
  expect_refusal({"--fixation", "2"},
                 "--fixation: unknown option; the nearest known is --fixations");
}

TEST_F(OptionsTest, OptionLikeNoOther) {
  expect_refusal({"--telescope"}, "--telescope: unknown option; gazed --help lists them");
  expect_refusal({"--fixation=2"},
                 "--fixation=2: unknown option; the nearest known is --fixations");
}

TEST_F(OptionsTest, ValueForAFlag) {
  expect_refusal({"--check=1"}, "--check: takes no value");
}

TEST_F(OptionsTest, ArgumentThatBelongsToNoOption) {
  expect_refusal({"robot.toml"}, "robot.toml: no option; gazed --help lists them");
}

TEST_F(OptionsTest, ValueMissing) {
  expect_refusal({"--robot"}, "--robot: no value found; wanted: NAME");
}

TEST_F(OptionsTest, OptionInPlaceOfAValue) {
  expect_refusal({"--camera", "--head", "sim"},
                 "--camera: camera.source: \"--head\" found; allowed: sim, lcm, log:FILE, v4l2, "
                 "v4l2:DEVICE, naoqi, naoqi:ADDRESS, naoqi:ADDRESS:PORT");
}

TEST_F(OptionsTest, BadValues) {
  expect_refusal({"--robot", "nao"},
                 "--robot: robot: \"nao\" found; allowed: nao-v3, nao-v4, nao-v5, nao-v6");
  expect_refusal({"--fixations", "-3"},
                 "--fixations: run.fixations: -3 found; allowed: 0 to 1000000000");
  expect_refusal({"--fixations", "two"},
                 "--fixations: run.fixations: \"two\" found; allowed: an integer, 0 to 1000000000");
  expect_refusal({"--seed", "1.5"},
                 "--seed: sim.seed: \"1.5\" found; allowed: an integer, 0 to 4294967295");
  expect_refusal({"--seed", "99999999999999999999"},
                 "--seed: sim.seed: \"99999999999999999999\" found; allowed: an integer, 0 to "
                 "4294967295");
  expect_refusal({"--print", "xml"},
                 "--print: run.print: \"xml\" found; allowed: text, json, none");
  expect_refusal({"--profile", "fast"},
                 "--profile: saliency.profile: \"fast\" found; allowed: report, robust, surround");
  expect_refusal(
      {"--scene", "K\xf6rper.toml"},
      "--scene: sim.scene: \"K?rper.toml\" found; allowed: a file name, or empty for the "
      "built-in scene");
}

TEST_F(OptionsTest, SetTakesEachKindOfValue) {
  const Settings settings =
      load({"--set", "saliency.profile=surround", "--set", "camera.focal_px=[600,601]", "--set",
            "locate.looks=8", "--set", "head.margin_rad=0.05", "--set", "saliency.flicker_weight=2",
            "--set", "publish.images=true", "--set", "camera.controls.exposure=0x10", "--set",
            "run.record=a b=c.lcm", "--set", "lcm.prefix='Robot_7'", "--set=sim.pace=\"fast\""});
  EXPECT_EQ(settings.cycle.saliency.profile, saliency::SaliencyProfile::surround);
  EXPECT_EQ(settings.rig.camera.focal_px, Eigen::Vector2d(600, 601));
  EXPECT_EQ(settings.cycle.locate.looks, 8);
  EXPECT_EQ(settings.cycle.motion.margin_rad, 0.05);
  EXPECT_EQ(settings.cycle.saliency.flicker_weight, 2.0);
  EXPECT_EQ(settings.publish.images, PublishedImages::pixels);
  EXPECT_EQ(settings.camera.controls.exposure, 16);
  EXPECT_EQ(settings.run.record, "a b=c.lcm");
  EXPECT_EQ(settings.lcm.prefix, "Robot_7");
  EXPECT_EQ(settings.sim.pace, sim::Pace::fast);
}

TEST_F(OptionsTest, SetTakesSpacesNumbersAsNamesAndNothing) {
  EXPECT_EQ(load({"--set", " locate.looks = 8 "}).cycle.locate.looks, 8);
  EXPECT_EQ(load({"--set", "run.record=2011"}).run.record, "2011");
  EXPECT_EQ(load({"--set", "naoqi.token=nao\\\"s"}).naoqi.token, "nao\\\"s");
  EXPECT_EQ(load({"--set", "naoqi.token=\"nao\\\"s\""}).naoqi.token, "nao\"s");
  EXPECT_EQ(load({"--record", "a.lcm", "--set", "run.record="}).run.record, "");
}

TEST_F(OptionsTest, SetAndOtherOptionsInTheOrderGiven) {
  EXPECT_EQ(load({"--set", "sim.seed=7", "--set", "sim.seed=8"}).sim.seed, 8U);
  EXPECT_EQ(load({"--seed", "7", "--set", "sim.seed=8"}).sim.seed, 8U);
  EXPECT_EQ(load({"--set", "sim.seed=8", "--seed", "7"}).sim.seed, 7U);
  EXPECT_EQ(load({"--seed", "6", "--set", "sim.seed=8", "--seed", "7", "--set", "run.print=json"})
                .sim.seed,
            7U);
}

TEST_F(OptionsTest, SetWinsOverTheFile) {
  const SettingsFile file("[sim]\nseed = 3\n[locate]\nlooks = 4\n");
  const std::string path = file.path();
  const Settings settings = load({"--set", "sim.seed=7", "--config", path.c_str()});
  EXPECT_EQ(settings.sim.seed, 7U);
  EXPECT_EQ(settings.cycle.locate.looks, 4);
}

TEST_F(OptionsTest, SetScalesWhatDependsOnIt) {
  const Settings settings = load({"--set", "camera.width_px=320", "--set", "camera.height_px=240"});
  EXPECT_EQ(settings.rig.camera.focal_px, default_settings().rig.camera.focal_px / 2);
}

TEST_F(OptionsTest, SetIsRefusedAsOtherOptionsAre) {
  expect_refusal({"--set", "camera.width_px=12"},
                 "--set: camera.width_px: 12 found; allowed: 160 to 2560");
  expect_refusal({"--set", "locate.looks=eight"},
                 "--set: locate.looks: \"eight\" found; allowed: an integer, 2 to 16");
  expect_refusal({"--set", "locate.looks=8.0"},
                 "--set: locate.looks: 8.0 found; allowed: an integer, 2 to 16");
  expect_refusal({"--set", "locate.looks="},
                 "--set: locate.looks: \"\" found; allowed: an integer, 2 to 16");
  expect_refusal({"--set", "locate.looks=8\nsim.seed=1"},
                 "--set: locate.looks: \"8?sim.seed=1\" found; allowed: an integer, 2 to 16");
  expect_refusal({"--set", "camera.focal_px=[600"},
                 "--set: camera.focal_px: \"[600\" found; allowed: 2 numbers, each 10 to 10000");
  expect_refusal({"--set", "camera.focal_px=[600, 'a']"},
                 "--set: camera.focal_px: an array found; allowed: 2 numbers, each 10 to 10000");
  expect_refusal({"--set", "sim.seed={a = 1}"},
                 "--set: sim.seed: a table found; allowed: an integer, 0 to 4294967295");
  expect_refusal({"--set", "publish.images=yes"},
                 "--set: publish.images: \"yes\" found; allowed: false, true, jpeg");
  expect_refusal({"--set", "publish.saliency=yes"},
                 "--set: publish.saliency: \"yes\" found; allowed: true or false");
  expect_refusal({"--set", "saliency.profile=itti"},
                 "--set: saliency.profile: \"itti\" found; allowed: report, robust, surround");
  expect_refusal({"--set", "run.record=\"a.lcm"},
                 "--set:1: not TOML: the string that begins at --set:1:14 has no closing quote\n"
                 "   1:14 | run.record = \"a.lcm\n"
                 "        |              ^");
}

TEST_F(OptionsTest, SetOfNoKey) {
  expect_refusal({"--set", "camera.widht_px=640"},
                 "--set: camera.widht_px: unknown key; the nearest known is camera.width_px");
  expect_refusal({"--set", "looks=8"},
                 "--set: looks: unknown key; the nearest known is locate.looks");
  const std::string allowed = " found; allowed: KEY=VALUE, as in locate.looks=8";
  expect_refusal({"--set", "locate.looks"}, "--set: \"locate.looks\"" + allowed);
  expect_refusal({"--set", "=8"}, "--set: \"=8\"" + allowed);
  expect_refusal({"--set", ""}, "--set: \"\"" + allowed);
  expect_refusal({"--set", "locate.looks", "8"}, "--set: \"locate.looks\"" + allowed);
  expect_refusal({"--set"}, "--set: no value found; wanted: KEY=VALUE");
}

TEST_F(OptionsTest, FlagsTakeNoValue) {
  const auto result = parse({"--check=false"});
  ASSERT_TRUE(std::holds_alternative<Exit>(result));
  EXPECT_EQ(std::get<Exit>(result).code, 2);
  EXPECT_THAT(std::get<Exit>(result).text, StartsWith("gazed: "));
}

TEST_F(OptionsTest, EmptyFileNameIsNoFile) {
  EXPECT_THROW(static_cast<void>(load({"--config", ""})), SettingsError);
}

}  // namespace
}  // namespace gazed::settings::options_test
