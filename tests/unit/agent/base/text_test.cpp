#include "agent/base/text.hpp"

#include <gtest/gtest.h>
#include <string>

namespace gazed::base::text_test {
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

TEST(Text, OnlyUtf8WithoutControlCharactersIsPrintable) {
  EXPECT_TRUE(is_printable(""));
  EXPECT_TRUE(is_printable("K\u00f6rper \u673a \U0001F916"));
  EXPECT_FALSE(is_printable("a\tb"));
  EXPECT_FALSE(is_printable("\x7f"));
  EXPECT_FALSE(is_printable("\xc2\x85"));          // control, C1
  EXPECT_FALSE(is_printable("\xe4"));              // Latin-1
  EXPECT_FALSE(is_printable("\xc0\x80"));          // 0 in two bytes
  EXPECT_FALSE(is_printable("\xed\xa0\x80"));      // a surrogate
  EXPECT_FALSE(is_printable("\xf4\x90\x80\x80"));  // beyond Unicode
  EXPECT_FALSE(is_printable("\xe6\x9c"));          // cut
}

TEST(Text, ExcerptIsShortAndPrintable) {
  EXPECT_EQ(excerpt("a\nb\xff"), "a?b?");
  EXPECT_EQ(excerpt("abcdef", 3), "abc...");
  EXPECT_EQ(excerpt("\u673a\u673a", 2), "\u673a...");  // no character is cut
}

}  // namespace
}  // namespace gazed::base::text_test
