// What gazelab says of a command line that it does not understand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "scratch.hpp"

namespace gazed::lab::gazelab_test {
namespace {

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  const Outcome run = run_gazelab(arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "gazelab: " + words + "\n");
}

/// Of lists that grow: how the refusal begins and ends.
void expect_refusal(const std::vector<std::string>& arguments, const std::string& begin,
                    const std::string& end) {
  const Outcome run = run_gazelab(arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, ::testing::StartsWith("gazelab: " + begin));
  EXPECT_THAT(run.err, ::testing::EndsWith(end + "\n"));
}

TEST(Gazelab, OptionsThatAreMisspelt) {
  expect_refusal({"saliency", "a.png", "--ovrlay", "out"},
                 "--ovrlay: unknown option; the nearest known is --overlay");
  expect_refusal({"triangulate", "a.toml", "b.csv", "--telescope"},
                 "--telescope: unknown option; allowed: --help, ", "--csv");
}

TEST(Gazelab, CommandsThatAreMisspelt) {
  expect_refusal({"salency", "a.png"}, "'salency': unknown command; allowed: saliency, ",
                 "; the nearest known is saliency");
  expect_refusal({"look"}, "'look': unknown command; allowed: saliency, ",
                 "; the nearest known is log");
  expect_refusal({}, "no command found; gazelab --help lists them");
}

TEST(Gazelab, ValuesThatAreNotAllowed) {
  expect_refusal({"analyze", "table", "--samples", "1"},
                 "--samples: '1' found; allowed: 2 to 1000000");
  expect_refusal({"analyze", "table", "--samples", "many"},
                 "--samples: 'many' found; allowed: 2 to 1000000");
  expect_refusal({"analyze", "tabel"},
                 "WHAT: 'tabel' found; allowed: table, sweep, sources; the nearest known is table");
}

TEST(Gazelab, WhatIsMissingAndWhatIsTooMuch) {
  expect_refusal({"triangulate"},
                 "PAIR.toml: nothing found; it is needed, see gazelab triangulate --help");
  expect_refusal({"saliency"}, "one of IMAGE, --camera and --video is needed");
  expect_refusal(
      {"saliency", "a.png", "--", "b.png"},
      "'b.png': behind a -- that follows other arguments; allowed: -- before all of them");
  expect_refusal({"analyze", "table", "--seed"}, "--seed: no value found; wanted: N");
  expect_refusal({"log", "folder", "a.lcm", "b.lcm"},
                 "'b.lcm': more arguments than wanted; see gazelab log --help");
}

}  // namespace
}  // namespace gazed::lab::gazelab_test
