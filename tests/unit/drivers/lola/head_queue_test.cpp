#include "drivers/lola/head_queue.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace gazed::lola::head_queue_test {
namespace {

class HeadQueueTest : public testing::Test {
 protected:
  void add(int states) {
    for (int i = 0; i < states; ++i) {
      geometry::HeadState state;
      state.measured.yaw_rad = next_++;
      queue_.add(state);
    }
  }
  std::vector<std::int64_t> times() {
    std::vector<std::int64_t> all;
    while (const auto state = queue_.take()) all.push_back(state->utime_us);
    return all;
  }

  HeadQueue queue_;
  int next_ = 0;
};

using Times = std::vector<std::int64_t>;

TEST_F(HeadQueueTest, OneThatIsReadAtOnceHasItsTimeOfArrival) {
  add(1);
  queue_.stamp(1'000'000);
  add(1);
  queue_.stamp(1'011'300);
  EXPECT_EQ(times(), (Times{1'000'000, 1'011'300}));
}

TEST_F(HeadQueueTest, SeveralThatWaitedAreACycleApart) {
  add(1);
  queue_.stamp(1'000'000);
  add(3);
  queue_.stamp(1'040'000);
  EXPECT_EQ(times(), (Times{1'000'000, 1'016'000, 1'028'000, 1'040'000}));
}

TEST_F(HeadQueueTest, ABurstDoesNotGoBackBehindWhatWasRead) {
  add(1);
  queue_.stamp(1'000'000);
  add(2);
  queue_.stamp(1'010'000);
  EXPECT_EQ(times(), (Times{1'000'000, 1'005'000, 1'010'000}));
}

TEST_F(HeadQueueTest, AWallClockThatIsSetBackGoesOnFromThere) {
  add(1);
  queue_.stamp(1'000'000'000);
  add(2);
  queue_.stamp(5'000'000);
  EXPECT_EQ(times(), (Times{1'000'000'000, 4'988'000, 5'000'000}));
}

TEST_F(HeadQueueTest, WhatIsDiscardedIsNotHandedOn) {
  add(1);
  queue_.stamp(1'000'000);
  add(2);
  queue_.discard();
  EXPECT_EQ(times(), (Times{1'000'000}));
}

TEST_F(HeadQueueTest, AFullOneDropsTheOldestAndCounts) {
  add(500);
  queue_.stamp(10'000'000);
  EXPECT_EQ(queue_.dropped(), 500 - 128);
  const auto first = queue_.take();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->measured.yaw_rad, 500.0 - 128.0);
  EXPECT_EQ(times().back(), 10'000'000);
  EXPECT_FALSE(queue_.take());
}

}  // namespace
}  // namespace gazed::lola::head_queue_test
