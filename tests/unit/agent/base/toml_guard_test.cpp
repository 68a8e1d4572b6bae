#include "agent/base/toml_guard.hpp"

#include <gtest/gtest.h>
#include <string>

#include "drivers/sim/scene.hpp"

namespace gazed::base::toml_guard_test {
namespace {

TEST(TomlGuard, LettersOutsideAsciiBelongInStringsAndComments) {
  EXPECT_FALSE(toml_hazard("# caf\xc3\xa9\na = \"caf\xc3\xa9\" # \xc3\xa9\nb = 'caf\xc3\xa9'\n"));
  EXPECT_FALSE(
      toml_hazard("\xEF\xBB\xBF"
                  "a = 1\n"));
  EXPECT_FALSE(toml_hazard("a = \"quote \\\" and caf\xc3\xa9\"\n"));
  EXPECT_EQ(toml_hazard("a = 1\nb = \xc3\xa9\n")->line, 2);
  EXPECT_TRUE(toml_hazard("a = \"x\" \xc3\xa9\n"));
  EXPECT_TRUE(
      toml_hazard("\xc2\xa0"
                  "a = 1\n"));
  EXPECT_TRUE(toml_hazard("a = \"\"\"\\\n\xc3\xa9\"\"\"\n"));
  EXPECT_TRUE(toml_hazard("a = \"\\\xc3\xa9\"\n"));
  EXPECT_TRUE(toml_hazard("a = 'back\\' \xc3\xa9\n"));
}

TEST(TomlGuard, DecimalsAreNoDottedNames) {
  std::string numbers, names, digits;
  for (int i = 0; i < 5000; ++i) {
    numbers += "a = [ 1.5, -0.25e3 ]\n";
    names += ".a";
    digits += ".1";
  }
  EXPECT_FALSE(toml_hazard(numbers));
  EXPECT_TRUE(toml_hazard("a" + names));
  EXPECT_TRUE(toml_hazard("1" + digits));
  EXPECT_FALSE(toml_hazard(sim::default_scene_toml()));
}

}  // namespace
}  // namespace gazed::base::toml_guard_test
