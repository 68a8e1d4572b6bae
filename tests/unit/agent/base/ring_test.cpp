#include "agent/base/ring.hpp"

#include <gtest/gtest.h>
#include <memory>

namespace gazed::base::ring_test {
namespace {

TEST(Ring, GivesBackInTheOrderOfComing) {
  Ring<int, 3> ring;
  EXPECT_TRUE(ring.empty());
  EXPECT_FALSE(ring.push(1));
  EXPECT_FALSE(ring.push(2));
  EXPECT_EQ(ring.size(), 2U);
  EXPECT_EQ(ring.oldest(), 1);
  EXPECT_EQ(ring.newest(), 2);
  EXPECT_EQ(ring.take(), 1);
  EXPECT_EQ(ring.take(), 2);
  EXPECT_TRUE(ring.empty());
}

TEST(Ring, AFullOneGivesUpItsOldest) {
  Ring<int, 3> ring;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(ring.push(i), i >= 3);
    EXPECT_EQ(ring.newest(), i);
    EXPECT_EQ(ring.oldest(), i < 3 ? 0 : i - 2);
  }
  EXPECT_TRUE(ring.full());
  for (std::size_t i = 0; i < ring.size(); ++i) EXPECT_EQ(ring[i], 97 + static_cast<int>(i));
}

TEST(Ring, ItsNewestCanBeDropped) {
  Ring<int, 4> ring;
  for (int i = 0; i < 6; ++i) ring.push(i);
  ring.drop_newest(3);
  EXPECT_EQ(ring.size(), 1U);
  EXPECT_EQ(ring.newest(), 2);
  ring.push(7);
  EXPECT_EQ(ring[1], 7);
}

TEST(Ring, WhatIsTakenIsMoved) {
  Ring<std::unique_ptr<int>, 2> ring;
  ring.push(std::make_unique<int>(5));
  EXPECT_EQ(*ring.take(), 5);
}

}  // namespace
}  // namespace gazed::base::ring_test
