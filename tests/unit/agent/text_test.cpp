#include "agent/text.hpp"

#include <gtest/gtest.h>

namespace gazed {
namespace {

TEST(Text, PutsNumbersIntoASentence) {
  EXPECT_EQ(text("%d of %.2f m", 3, 0.5), "3 of 0.50 m");
}

TEST(Text, HasNoGreatestLength) {
  const std::string path(5000, 'x');
  EXPECT_EQ(text("%s!", path.c_str()), path + "!");
}

TEST(Text, CanBeEmpty) {
  EXPECT_EQ(text("%s", ""), "");
}

}  // namespace
}  // namespace gazed
