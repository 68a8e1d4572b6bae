#include "drivers/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gazed::drivers::table_test {
namespace {

constexpr Part both_parts[] = {Part::camera, Part::head};

/// "lola:SOCKET" with something in the place of its words.
std::string example(std::string form) {
  const std::pair<std::string, std::string> words[] = {{"FILE", "walk.lcm"},
                                                       {"DEVICE", "/dev/video2"},
                                                       {"SOCKET", "/tmp/a"},
                                                       {"ADDRESS", "10.0.0.7"},
                                                       {"PORT", "9560"}};
  for (const auto& [word, text] : words) {
    if (const std::size_t at = form.find(word); at != std::string::npos)
      form.replace(at, word.size(), text);
  }
  return form;
}

/// The row's forms, one by one.
std::vector<std::string> examples(const DriverRow& row) {
  std::vector<std::string> result;
  std::istringstream forms{std::string(row.forms)};
  for (std::string form; std::getline(forms >> std::ws, form, ',');)
    result.push_back(example(form));
  return result;
}

TEST(DriverTable, NamesAreUniqueAndEveryDriverHasAPart) {
  std::set<std::string_view> names;
  for (const DriverRow& row : all_drivers()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(row.has_camera || row.has_head) << row.name;
    EXPECT_EQ(row.name.find(':'), std::string_view::npos) << row.name;
  }
}

TEST(DriverTable, EveryFormIsASourceOfTheDriversParts) {
  for (const DriverRow& row : all_drivers()) {
    for (const std::string& text : examples(row)) {
      for (const Part part : both_parts) {
        const auto source = Source::parse(part, text);
        ASSERT_EQ(source.has_value(), row.has(part)) << text;
        if (!source) continue;
        EXPECT_EQ(&source->driver(), &row) << text;
        EXPECT_EQ(source->text(), text);
      }
    }
  }
}

TEST(DriverTable, FormsTellWhetherAnArgumentIsNeeded) {
  for (const DriverRow& row : all_drivers()) {
    const Part part = row.has_camera ? Part::camera : Part::head;
    const std::string name(row.name);
    const bool bare = row.forms == name || row.forms.starts_with(name + ", ");
    EXPECT_EQ(Source::parse(part, name).has_value(), bare) << name;
    EXPECT_FALSE(Source::parse(part, name + ":")) << name;
    const bool takes_one = row.argument.need != Argument::Need::none;
    EXPECT_EQ(Source::parse(part, name + ":10.0.0.7").has_value(), takes_one) << name;
  }
}

TEST(DriverTable, AllowedSourcesAreTheRowsForms) {
  EXPECT_EQ(allowed_sources(Part::camera),
            "sim, lcm, log:FILE, v4l2, v4l2:DEVICE, naoqi, naoqi:ADDRESS, naoqi:ADDRESS:PORT");
  EXPECT_EQ(allowed_sources(Part::head),
            "sim, lcm, log:FILE, lola, lola:SOCKET, naoqi, naoqi:ADDRESS, naoqi:ADDRESS:PORT");
}

TEST(Source, IsTheSimulatorUntilItIsSet) {
  const Source source;
  EXPECT_EQ(source.text(), "sim");
  EXPECT_TRUE(source.is(Origin::simulation));
  for (const Part part : both_parts) EXPECT_TRUE(source.driver().has(part));
}

TEST(Source, ArgumentIsAllAfterTheFirstColon) {
  EXPECT_EQ(Source::parse(Part::camera, "log:a:b.lcm")->argument(), "a:b.lcm");
  EXPECT_EQ(Source::parse(Part::camera, "v4l2")->argument(), "");
  EXPECT_EQ(Source::parse(Part::head, "naoqi:10.0.0.7:9560")->argument(), "10.0.0.7:9560");
}

TEST(Source, WhatIsNone) {
  for (const std::string_view text : {"", ":", "simulator", "Sim", " sim", "sim ", "log",
                                      "naoqi:nao.local", "naoqi:10.0.0.7:0"}) {
    for (const Part part : both_parts) EXPECT_FALSE(Source::parse(part, text)) << text;
  }
}

}  // namespace
}  // namespace gazed::drivers::table_test
