#include "drivers/naoqi/message.hpp"

#include <array>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/drivers/naoqi/golden.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::naoqi::message_test {
namespace {

QiValue value_of(const QiWriter& writer, std::string_view signature) {
  return QiReader(writer.bytes(), signature).next();
}

std::vector<QiValue> elements_of(const QiValue& value) {
  std::vector<QiValue> all;
  QiReader elements = value.elements();
  while (const QiValue element = elements.next()) all.push_back(element);
  return all;
}

TEST(QiReader, ReadingPastTheEndGivesNothingFromThenOn) {
  QiReader reader("\1\2\3\4\5");
  EXPECT_EQ(reader.u32(), 0x04030201U);
  EXPECT_EQ(reader.integer(2), 0U);
  EXPECT_EQ(reader.integer(1), 0U);
}

TEST(QiValue, TheOfficialServersAnswerIsTwoAngles) {
  const auto bytes = from_hex(golden_get_angles_answer);
  QiReader reader(bytes, "[f]");
  const QiValue angles = reader.next();
  ASSERT_TRUE(angles);
  EXPECT_EQ(angles.signature, "[f]");
  const auto elements = elements_of(angles);
  ASSERT_EQ(elements.size(), 2U);
  EXPECT_EQ(elements[0].number(), 0.5);
  EXPECT_EQ(elements[1].number(), -0.25);
  EXPECT_TRUE(reader.rest().empty());
  EXPECT_FALSE(reader.next());
}

TEST(QiValue, NumbersOfEveryWidthKeepTheirSign) {
  struct Case {
    std::string_view signature;
    std::size_t bytes;
    std::uint64_t bits;
    double expected;
  };
  constexpr std::uint64_t minus_two = ~std::uint64_t{1};
  for (const Case& c : std::to_array<Case>({{"b", 1, 1, 1.0},
                                            {"c", 1, minus_two, -2.0},
                                            {"C", 1, minus_two, 254.0},
                                            {"w", 2, minus_two, -2.0},
                                            {"W", 2, minus_two, 65534.0},
                                            {"i", 4, minus_two, -2.0},
                                            {"I", 4, minus_two, 4294967294.0},
                                            {"l", 8, minus_two, -2.0},
                                            {"L", 8, 3, 3.0},
                                            {"f", 4, 0xbe800000, -0.25},
                                            {"d", 8, 0xbfd0000000000000, -0.25}})) {
    QiWriter writer;
    writer.integer(c.bits, c.bytes);
    const QiValue value = value_of(writer, c.signature);
    ASSERT_TRUE(value) << c.signature;
    EXPECT_EQ(value.number(), c.expected) << c.signature;
    EXPECT_FALSE(value.text()) << c.signature;
    EXPECT_THAT(elements_of(value), ::testing::IsEmpty()) << c.signature;
  }
}

TEST(QiValue, TextAndBytesAreTheSame) {
  for (const std::string_view signature : {"s", "r"}) {
    QiWriter writer;
    writer.text("HeadYaw");
    EXPECT_EQ(value_of(writer, signature).text(), "HeadYaw");
    EXPECT_FALSE(value_of(writer, signature).number());
  }
}

TEST(QiValue, NothingIsNeitherNumberNorText) {
  for (const QiValue& nothing : {value_of({}, "v"), QiValue{}}) {
    EXPECT_EQ(static_cast<bool>(nothing), nothing.signature == "v");
    EXPECT_FALSE(nothing.number());
    EXPECT_FALSE(nothing.text());
    EXPECT_FALSE(nothing.element(0));
  }
}

TEST(QiValue, DynamicValuesAreUnwrappedHoweverOften) {
  QiWriter writer;
  writer.text("m").text("m").dynamic(0.5F);
  EXPECT_EQ(value_of(writer, "m").number(), 0.5);
  // Nobody wraps that often; a message that does is not to fill the stack.
  QiWriter deep;
  for (int i = 0; i < 17; ++i) deep.text("m");
  deep.dynamic(0.5F);
  EXPECT_FALSE(value_of(deep, "m"));
}

TEST(QiValue, ATupleHasNamesOrNot) {
  QiWriter writer;
  writer.text("top").integer(3, 4).integer(0, 1);
  for (const std::string_view signature :
       {"(sib)", "(sib)<Camera,name,index,open>", "(sib)<A<B,C>,d>"}) {
    const auto elements = elements_of(value_of(writer, signature));
    ASSERT_EQ(elements.size(), 3U) << signature;
    EXPECT_EQ(elements[0].text(), "top");
    EXPECT_EQ(elements[1].number(), 3.0);
  }
}

TEST(QiValue, AMapIsKeysAndValuesInTurn) {
  QiWriter writer;
  writer.u32(2).text("a").dynamic(1.0F).text("b").dynamic("two");
  const auto entries = elements_of(value_of(writer, "{sm}"));
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[1].number(), 1.0);
  EXPECT_EQ(entries[2].text(), "b");
  EXPECT_EQ(entries[3].text(), "two");
}

TEST(QiValue, AnElementIsThereOrNot) {
  QiWriter writer;
  writer.u32(2).f32(1.0F).f32(2.0F).f32(3.0F);
  const QiValue list = value_of(writer, "[f]");
  EXPECT_EQ(list.element(1).number(), 2.0);
  EXPECT_FALSE(list.element(2));
  EXPECT_FALSE(list.element(1).element(0));
}

TEST(QiValue, AfterOneThatIsNoneThereIsNone) {
  QiWriter writer;
  writer.u32(1).u32(2);
  QiReader reader(writer.bytes(), "iXi");
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.next());
}

TEST(QiValue, WhatEndsEarlyIsNoValue) {
  QiWriter writer;
  writer.dynamic_list(std::vector<float>{0.5F, 0.25F});
  ASSERT_TRUE(value_of(writer, "m"));
  for (std::size_t size = 0; size < writer.bytes().size(); ++size)
    EXPECT_FALSE(QiReader(writer.bytes().substr(0, size), "m").next()) << size;
}

TEST(QiValue, SignaturesThatAreNoneAreRefused) {
  QiWriter zeros;
  for (int i = 0; i < 64; ++i) zeros.integer(1, 1);
  for (const std::string_view signature : {"", "o", "X", "(", ")", "(i", "(i]", "[i)", "{i]", "i)",
                                           ">", "<", "<i>", "((((((((((((((((((i)"})
    EXPECT_FALSE(value_of(zeros, signature) && signature != "i)") << signature;
}

// Each element of a list looks through its type: a long one would make a short list long work.
TEST(QiValue, TypesLongerThanARobotsAreRefused) {
  constexpr std::size_t longest = 256;
  QiWriter two_lists;
  two_lists.u32(2).u32(0).u32(0);
  for (const std::size_t length : {longest, longest + 1}) {
    const std::string signature = "[[" + std::string(length - 4, 'i') + "]]";
    EXPECT_EQ(static_cast<bool>(value_of(two_lists, signature)), length == longest) << length;
  }
}

TEST(QiValue, CountsThatNoMessageHoldsAreRefused) {
  QiWriter writer;
  writer.u32(0xffffffff).f32(1.0F);
  for (const std::string_view signature : {"[f]", "[v]", "[()]", "[[v]]", "{vv}", "s", "r", "[]"})
    EXPECT_FALSE(value_of(writer, signature)) << signature;
}

TEST(QiValue, AnyBytesAreReadOrRefused) {
  std::mt19937_64 random(1);
  const std::array<std::string_view, 5> signatures{"m", "[m]", "{sm}", "[f]", "(Issss[(ss)]s)"};
  const std::string_view letters = "bcCwWiIlLfdsrmv[]{}()<>";
  for (int i = 0; i < test::trials(200'000, 5'000); ++i) {
    QiWriter writer;
    const std::size_t size = random() % 64;
    while (writer.bytes().size() < size) {
      // Mostly small counts and signatures, so that some of it is understood.
      switch (random() % 3) {
        case 0:
          writer.u32(static_cast<std::uint32_t>(random() % 4));
          break;
        case 1:
          writer.integer(static_cast<std::uint8_t>(letters[random() % letters.size()]), 1);
          break;
        default:
          writer.integer(random(), 1);
      }
    }
    for (const std::string_view signature : signatures) {
      for (const QiValue& element : elements_of(value_of(writer, signature))) {
        ASSERT_NE(element.signature, "m");
        ASSERT_LE(element.bytes.size(), size);
        static_cast<void>(element.number());
        static_cast<void>(element.text());
      }
    }
  }
}

}  // namespace
}  // namespace gazed::naoqi::message_test
