#include "drivers/naoqi/value.hpp"

#include <array>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "tests/unit/naoqi/golden.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::value_test {
namespace {

std::optional<QiValue> value_of(const QiWriter& writer, std::string_view signature) {
  QiReader reader(writer.bytes());
  return take_value(reader, signature);
}

TEST(QiValue, TheOfficialServersAnswerIsTwoAngles) {
  const auto bytes = from_hex(golden_get_angles_answer);
  QiReader reader{QiBytes(bytes)};
  std::string_view signature = "[f]";
  const auto angles = take_value(reader, signature);
  ASSERT_TRUE(angles);
  std::array<QiValue, 3> elements;
  ASSERT_EQ(angles->elements(elements), 2U);
  EXPECT_EQ(elements[0].number(), 0.5);
  EXPECT_EQ(elements[1].number(), -0.25);
  EXPECT_TRUE(reader.rest().empty());
  EXPECT_TRUE(signature.empty());
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
    const auto value = value_of(writer, c.signature);
    ASSERT_TRUE(value) << c.signature;
    EXPECT_EQ(value->number(), c.expected) << c.signature;
    EXPECT_FALSE(value->text()) << c.signature;
  }
}

TEST(QiValue, TextAndBytesAreTheSame) {
  for (const std::string_view signature : {"s", "r"}) {
    QiWriter writer;
    writer.text("HeadYaw");
    EXPECT_EQ(value_of(writer, signature)->text(), "HeadYaw");
    EXPECT_FALSE(value_of(writer, signature)->number());
  }
}

TEST(QiValue, NothingIsNeitherNumberNorText) {
  const auto nothing = value_of({}, "v");
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(nothing->number());
  EXPECT_FALSE(nothing->text());
  std::array<QiValue, 1> elements;
  EXPECT_EQ(nothing->elements(elements), 0U);
}

TEST(QiValue, DynamicValuesAreUnwrappedHoweverOften) {
  QiWriter writer;
  write_dynamic(writer.text("m").text("m"), 0.5F);
  EXPECT_EQ(value_of(writer, "m")->number(), 0.5);
  // Nobody wraps that often; a message that does is not to fill the stack.
  QiWriter deep;
  for (int i = 0; i < 17; ++i) deep.text("m");
  write_dynamic(deep, 0.5F);
  EXPECT_FALSE(value_of(deep, "m"));
}

TEST(QiValue, ATupleHasNamesOrNot) {
  QiWriter writer;
  writer.text("top").integer(3, 4).integer(0, 1);
  for (const std::string_view signature :
       {"(sib)", "(sib)<Camera,name,index,open>", "(sib)<A<B,C>,d>"}) {
    const auto tuple = value_of(writer, signature);
    ASSERT_TRUE(tuple) << signature;
    std::array<QiValue, 4> elements;
    ASSERT_EQ(tuple->elements(elements), 3U);
    EXPECT_EQ(elements[0].text(), "top");
    EXPECT_EQ(elements[1].number(), 3.0);
  }
}

TEST(QiValue, AMapIsKeysAndValuesInTurn) {
  QiWriter writer;
  writer.u32(2).text("a");
  write_dynamic(writer, 1.0F);
  writer.text("b");
  write_dynamic(writer, "two");
  std::array<QiValue, 5> entries;
  ASSERT_EQ(value_of(writer, "{sm}")->elements(entries), 4U);
  EXPECT_EQ(entries[1].number(), 1.0);
  EXPECT_EQ(entries[2].text(), "b");
  EXPECT_EQ(entries[3].text(), "two");
}

TEST(QiValue, ElementsBeyondTheRoomForThemAreLeft) {
  QiWriter writer;
  writer.u32(3).f32(1.0F).f32(2.0F).f32(3.0F);
  std::array<QiValue, 2> elements;
  EXPECT_EQ(value_of(writer, "[f]")->elements(elements), 2U);
}

TEST(QiValue, WhatEndsEarlyIsNoValue) {
  QiWriter writer;
  write_dynamic_list(writer, std::vector<float>{0.5F, 0.25F});
  ASSERT_TRUE(value_of(writer, "m"));
  for (std::size_t size = 0; size < writer.bytes().size(); ++size) {
    QiReader reader(writer.bytes().first(size));
    std::string_view signature = "m";
    EXPECT_FALSE(take_value(reader, signature)) << size;
  }
}

TEST(QiValue, SignaturesThatAreNoneAreRefused) {
  QiWriter zeros;
  for (int i = 0; i < 64; ++i) zeros.integer(1, 1);
  for (const std::string_view signature : {"", "o", "X", "(", ")", "(i", "(i]", "[i)", "{i]", "i)",
                                           ">", "<", "<i>", "((((((((((((((((((i)"})
    EXPECT_FALSE(value_of(zeros, signature) && signature != "i)") << signature;
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
  std::array<QiValue, 16> elements;
  for (int i = 0; i < trials(200'000, 5'000); ++i) {
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
      const auto value = value_of(writer, signature);
      if (!value) continue;
      const std::size_t count = value->elements(elements);
      for (const QiValue& element : std::span(elements).first(count)) {
        ASSERT_NE(element.signature, "m");
        ASSERT_LE(element.bytes.size(), size);
        static_cast<void>(element.number());
        static_cast<void>(element.text());
      }
    }
  }
}

}  // namespace
}  // namespace gazed::value_test
