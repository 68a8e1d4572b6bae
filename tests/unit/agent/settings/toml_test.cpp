#include "agent/settings/toml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/settings/table.hpp"

#include "tests/unit/agent/settings/settings_file.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::settings::toml_test {
namespace {

/// Random values that their keys allow.
class RandomSettings {
 public:
  explicit RandomSettings(std::uint64_t seed) : random_(seed) {}

  Settings draw() {
    Settings settings = default_settings();
    for (const Key& key : all_keys()) set(settings, key);
    make_consistent(settings);
    return settings;
  }

  std::uint64_t below(std::uint64_t n) { return random_() % n; }

 private:
  void set(Settings& settings, const Key& key) {
    const Value before = read(settings, key);
    const bool stays_unset = std::holds_alternative<std::monostate>(before) && below(2) == 0;
    if (!stays_unset) assign(settings, {&key, value(key, before), "", "random"});
  }

  Value value(const Key& key, const Value& before) {
    if (std::holds_alternative<std::monostate>(key.allowed)) return below(2) == 0;
    if (const auto* choices = std::get_if<Choices>(&key.allowed)) {
      return std::string((*choices)[below(choices->size())]);
    }
    if (const auto* range = std::get_if<Range>(&key.allowed)) return number(*range, before);
    if (key.name() == "source") return pick({"sim", "lcm"});
    if (key.path == "lcm.url") return pick({"memq://", "udpm://239.255.76.68:7667?ttl=1"});
    if (key.path.ends_with("_channel")) return pick({"", "IMAGE", "robot/camera-1.front"});
    if (key.path == "lcm.prefix") return pick({"GAZED", "a", "Robot_7"});
    return text();
  }

  Value number(const Range& range, const Value& before) {
    if (const auto* list = std::get_if<std::vector<double>>(&before)) {
      std::vector<double> numbers(list->size());
      for (double& element : numbers) element = real(range);
      return numbers;
    }
    if (std::holds_alternative<double>(before)) return real(range);
    const auto count = static_cast<std::uint64_t>(range.max - range.min) + 1;
    return static_cast<std::int64_t>(range.min) + static_cast<std::int64_t>(below(count));
  }

  double real(const Range& range) {
    constexpr double two_to_53 = 9007199254740992.0;
    switch (below(6)) {
      case 0:
        return range.min;
      case 1:
        return range.max;
      case 2:  // down to where doubles have fewer digits
        if (range.min <= 0) return std::ldexp(range.max, -static_cast<int>(below(1074)));
        [[fallthrough]];
      default:
        const double unit = static_cast<double>(random_() >> 11U) / two_to_53;
        return range.min + unit * (range.max - range.min);
    }
  }

  std::string text() {
    constexpr std::array<std::string_view, 12> pieces = {
        "a", "\"", "\\", "'", "#", "=", "[", "\\u0041", " ", "\u00e4", "\u673a", "\U0001F916"};
    std::string result;
    for (std::uint64_t i = below(12); i > 0; --i) result += pieces[below(pieces.size())];
    return result;
  }

  std::string pick(std::initializer_list<const char*> texts) {
    return *(texts.begin() + below(texts.size()));
  }

  void make_consistent(Settings& settings) {
    if (below(4) == 0) {
      settings.camera.source = settings.head.source =
          drivers::Source::parse(drivers::Part::camera, "log:a \"b\".lcm").value();
    }
    settings.run.record += "r";  // never the log that is read
    geometry::CameraModel& model = settings.rig.camera;
    model.centre_px.x() = std::min(model.centre_px.x(), model.width_px - 1.0);
    model.centre_px.y() = std::min(model.centre_px.y(), model.height_px - 1.0);
    if (settings.cycle.locate.registration.range_min_m >=
        settings.cycle.locate.registration.range_max_m) {
      settings.cycle.locate.registration.range_min_m = 0.5;
      settings.cycle.locate.registration.range_max_m = 0.75;
    }
    settings.cycle.saliency.colour_weight += 0.5 * (10 - settings.cycle.saliency.colour_weight);
    settings.cycle.saliency.red_green_weight +=
        0.5 * (10 - settings.cycle.saliency.red_green_weight);
  }

  std::mt19937_64 random_;
};

TEST(SettingsToml, FedBackIsTheSameConfiguration) {
  RandomSettings random(20110707);
  for (int i = 0; i < 300; ++i) {
    const Settings written = random.draw();
    const std::string text = to_toml(written);
    const SettingsFile file(text);
    // A scene that says otherwise must not show: the file states every sigma.
    const Settings back = load_settings(file.layers(), [](const std::string&) {
      return geometry::UncertaintyOverride{.pixel_sigma_px = 7.0, .focal_sigma_px = 7.0};
    });
    for (const Key& key : all_keys()) {
      ASSERT_EQ(read(back, key), read(written, key)) << key.path << " of\n" << text;
    }
    ASSERT_EQ(to_toml(back), text);
  }
}

TEST(SettingsToml, DefaultsFedBackAreTheDefaults) {
  using enum geometry::CameraPosition;
  for (const std::string_view robot : geometry::robot_names) {
    for (const geometry::CameraPosition position : {top, bottom}) {
      const Settings settings = default_settings(robot, position);
      EXPECT_EQ(to_toml(load_text(to_toml(settings))), to_toml(settings));
    }
  }
}

TEST(SettingsToml, EveryKeyIsWrittenWithWhatItMayBe) {
  const std::string text = to_toml(default_settings());
  for (const Key& key : all_keys()) {
    const std::string name = std::string(key.name()) + " = ";
    const std::size_t line = text.find('\n' + name) != std::string::npos ? text.find('\n' + name)
                                                                         : text.find("\n# " + name);
    ASSERT_NE(line, std::string::npos) << key.path;
  }
  EXPECT_THAT(text, testing::HasSubstr("\n[camera]\n"));
  EXPECT_THAT(text, testing::HasSubstr("# image width; 160 to 2560 px\n"));
  EXPECT_THAT(text, testing::HasSubstr("; top, bottom\n"));
}

constexpr std::array<std::string_view, 22> pieces = {"[",
                                                     "]]",
                                                     "{a=",
                                                     "}",
                                                     "\"",
                                                     "'''",
                                                     "\"\"\"",
                                                     "\\u",
                                                     "\xc3",
                                                     "nan",
                                                     "-inf",
                                                     "1e999",
                                                     "0x7fffffffffffffff",
                                                     "2011-07-07T10:00:00Z",
                                                     "a.b.c",
                                                     "=",
                                                     "\n",
                                                     "\n[$x]\n",
                                                     "\n[camera]\n",
                                                     "\nseed = 2\n",
                                                     "log:walk.lcm",
                                                     ","};

/// A valid file, changed at random in 1 to 4 places: bytes, pieces moved, pieces of other files,
/// whole lines twice.
std::string mutated(std::string text, RandomSettings& random) {
  for (std::uint64_t i = 1 + random.below(4); i > 0; --i) {
    const std::size_t at = random.below(text.size());
    const std::size_t length = random.below(40);
    const std::size_t line = text.rfind('\n', at) + 1;  // 0 when there is none
    switch (random.below(7)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.insert(at, pieces[random.below(pieces.size())]);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(random.below(text.size()), text.substr(at, length));
        break;
      case 4:
        text.insert(std::min(line, text.size()),
                    text.substr(std::min(line, text.size()), text.find('\n', line) + 1 - line));
        break;
      case 5:
        text.erase(std::min(text.find_first_of("\"'[]{},=", at), text.size() - 1), 1);
        break;
      default:
        text.resize(std::max<std::size_t>(at, 1));
    }
    if (text.empty()) text.push_back('\n');
  }
  return text;
}

/// The number behind "robot.toml:" at `at`; 0 when there is none.
std::size_t line_named(std::string_view message, std::size_t at) {
  constexpr std::string_view file = "robot.toml:";
  std::size_t line = 0;
  if (message.substr(at).starts_with(file)) {
    const std::string_view number = message.substr(at + file.size());
    std::from_chars(number.data(), number.data() + number.size(), line);
  }
  return line;
}

/// A message is made of printable lines, and its first and each that is not indented begins with a
/// line of the text.
void expect_places(std::string_view message, std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t end = std::min(message.find('\n', at), message.size());
    EXPECT_TRUE(base::is_printable(message.substr(at, end - at))) << message << "\nof\n" << text;
    if (message[at] != ' ') {
      const std::size_t line = line_named(message, at);
      EXPECT_TRUE(line >= 1 && line <= lines) << message << "\nof\n" << text;
    }
    at = end + 1;
  }
}

/// True when `text` is refused; fails when that happens by anything but a message of its lines.
bool is_refused(const std::string& text) {
  try {
    Settings settings = default_settings();
    for (const Entry& entry : read_toml(text, "robot.toml")) assign(settings, entry);
    return false;
  } catch (const SettingsError& error) {
    expect_places(error.what(), text);
    return true;
  }
}

/// The same with what no key can tell alone.
void expect_loaded_or_refused(const std::string& text) {
  const std::string message = whole_refusal_of(text);
  if (message != "accepted") expect_places(message, text);
}

TEST(SettingsToml, MutationsAreRefusedOrRead) {
  RandomSettings random(1998);
  int refused = 0;
  constexpr int mutations = test::trials(10000, 2000);
  std::string valid;
  for (int i = 0; i < mutations; ++i) {
    if (i % 100 == 0) valid = to_toml(i % 200 == 0 ? default_settings() : random.draw());
    const std::string text = mutated(valid, random);
    refused += is_refused(text) ? 1 : 0;
    if (i % 50 == 0) expect_loaded_or_refused(text);  // through a file, which takes its time
  }
  EXPECT_GT(refused, mutations / 5);        // the mutations do reach the checks,
  EXPECT_LT(refused, mutations * 19 / 20);  // and what is still right passes
}

TEST(SettingsToml, RandomBytesAreRefused) {
  RandomSettings random(2011);
  for (int i = 0; i < 10000; ++i) {
    std::string bytes(8 + random.below(200), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.below(256));
    EXPECT_TRUE(bytes.front() == '#' || is_refused(bytes));
  }
}

}  // namespace
}  // namespace gazed::settings::toml_test
