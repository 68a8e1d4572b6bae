// What --check accepts must start, and what cannot start must be refused by it.
#include <cstdint>
#include <exception>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>
#include <variant>
#include <vector>

#include "agent/daemon/loop.hpp"
#include "agent/daemon/wiring.hpp"
#include "agent/settings/table.hpp"
#include "agent/settings/value.hpp"

namespace gazed::daemon::check_test {
namespace {

using ::testing::HasSubstr;

/// The ends of a key's range, as they are written in a configuration.
std::vector<std::string> extremes(const settings::Key& key) {
  const auto* range = std::get_if<settings::Range>(&key.allowed);
  if (range == nullptr) return {};
  settings::Settings defaults = settings::default_settings();
  const settings::Value now = settings::read(defaults, key);
  std::vector<std::string> texts;
  for (const double end : {range->min, range->max}) {
    if (const auto* numbers = std::get_if<std::vector<double>>(&now)) {
      texts.push_back(settings::toml_text(std::vector<double>(numbers->size(), end)));
    } else if (std::holds_alternative<double>(now)) {
      texts.push_back(settings::toml_text(end));
    } else {
      texts.push_back(settings::toml_text(static_cast<std::int64_t>(end)));
    }
  }
  return texts;
}

settings::Settings load(std::vector<settings::Assignment> assignments) {
  assignments.insert(assignments.begin(), {"lcm.url", "memq://", "test"});
  return settings::load_settings({{}, std::nullopt, std::move(assignments)}, scene_uncertainty);
}

settings::Assignment as_toml(const std::string& key, const std::string& text) {
  return {key, text, "test", settings::Written::as_toml};
}

/// Why not; empty when it starts.
std::string start(const settings::Settings& settings) {
  try {
    EndSignals signals;
    Report report(settings::PrintFormat::none, stdout);
    ServiceManager service({}, getpid());
    const Loop loop(settings, make_parts(settings, settings.lcm.url), signals, report, service);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string check(const settings::Settings& settings) {
  try {
    check_parts(settings);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Check, AgreesWithTheStartAtTheExtremesOfEveryKey) {
  int started = 0;
  for (const settings::Key& key : settings::all_keys()) {
    for (const std::string& text : extremes(key)) {
      for (const char* source : {"sim", "lcm"}) {
        std::optional<settings::Settings> settings;
        try {
          settings = load({{"camera.source", source, "test"},
                           {"head.source", source, "test"},
                           as_toml(std::string(key.path), text)});
        } catch (const settings::SettingsError&) {
          continue;  // refused by both: they load it in the same way
        }
        EXPECT_EQ(check(*settings), start(*settings)) << key.path << " = " << text;
        ++started;
      }
    }
  }
  EXPECT_GT(started, 100);
}

TEST(Check, ASceneOfAnotherSizeThanTheCameraIsRefused) {
  const settings::Settings settings =
      load({as_toml("camera.width_px", "320"), as_toml("camera.height_px", "240")});
  EXPECT_THAT(check(settings), HasSubstr("camera.width_px, camera.height_px: 320x240 found; "
                                         "allowed: 640x480"));
  EXPECT_EQ(check(settings), start(settings));
}

TEST(Check, AFileThatCannotBeRecordedToIsRefused) {
  const settings::Settings settings = load({{"run.record", "/dev/full", "test"}});
  EXPECT_THAT(check(settings), HasSubstr("/dev/full: a device; a regular file is needed"));
  EXPECT_EQ(check(settings), start(settings));
}

TEST(Check, SaysWhatItHasLookedAt) {
  EXPECT_EQ(what_was_checked(load({}), "robot.toml"),
            "checked: robot.toml, robot nao-v6, camera sim, head sim, the built-in scene: all "
            "values are allowed; nothing was opened");
  EXPECT_EQ(what_was_checked(load({{"camera.source", "v4l2", "test"},
                                   {"head.source", "lola", "test"},
                                   {"run.record", "walk.lcm", "test"}}),
                             std::nullopt),
            "checked: no configuration file, robot nao-v6, camera v4l2, head lola, recording to "
            "walk.lcm: all values are allowed; nothing was opened");
}

}  // namespace
}  // namespace gazed::daemon::check_test
