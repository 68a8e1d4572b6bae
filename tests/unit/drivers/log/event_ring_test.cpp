#include "drivers/log/event_ring.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "agent/base/random.hpp"

namespace gazed::log::event_ring_test {
namespace {

struct Kept {
  std::string channel;
  std::int64_t utime_us;
  std::vector<std::uint8_t> message;
};

class EventRingTest : public testing::Test {
 protected:
  EventRingTest() : memory_(4096), ring_(memory_, positions_) {}

  bool add(const Kept& kept, std::size_t spare = 0) {
    return ring_.add({kept.channel, kept.utime_us, kept.message}, spare);
  }
  void expect_oldest(const Kept& kept) {
    const auto event = ring_.oldest();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->channel, kept.channel);
    EXPECT_EQ(event->utime_us, kept.utime_us);
    EXPECT_TRUE(std::ranges::equal(event->message, kept.message));
  }

  std::vector<std::uint8_t> memory_;
  RingPositions positions_;
  EventRing ring_;
};

TEST_F(EventRingTest, GivesBackWhatWasAddedInItsOrder) {
  EXPECT_TRUE(ring_.empty());
  EXPECT_FALSE(ring_.oldest());
  const Kept first{"GAZED_IMAGE", 7, {1, 2, 3}}, second{"A", -1, {}};
  EXPECT_TRUE(add(first));
  EXPECT_TRUE(add(second));
  expect_oldest(first);
  ring_.remove_oldest();
  expect_oldest(second);
  ring_.remove_oldest();
  EXPECT_TRUE(ring_.empty());
}

TEST_F(EventRingTest, WithoutRoomNothingIsAddedAndNothingIsLost) {
  const Kept kept{"C", 1, std::vector<std::uint8_t>(1000, 9)};
  int added = 0;
  while (add(kept)) ++added;
  EXPECT_EQ(added, 3);
  EXPECT_FALSE(ring_.has_room(EventRing::bytes_of(1, 1000), 0));
  for (int i = 0; i < added; ++i) {
    expect_oldest(kept);
    ring_.remove_oldest();
  }
  EXPECT_TRUE(ring_.empty());
}

TEST_F(EventRingTest, RoomThatIsKeptForOthersIsKept) {
  const Kept large{"C", 1, std::vector<std::uint8_t>(1000, 9)}, small{"D", 2, {5}};
  EXPECT_TRUE(add(large, 2000));
  EXPECT_TRUE(add(large, 1000));
  EXPECT_FALSE(add(large, 2000));
  EXPECT_TRUE(add(small));
}

// Any sizes, added and taken in any order, across the end of the memory and of the counting.
TEST_F(EventRingTest, HoldsWhateverTheSizes) {
  base::Random random(3);
  const auto below = [&](std::uint32_t end) {
    return static_cast<std::uint32_t>(random.uniform() * end);
  };
  positions_.added = positions_.taken = 0xfffff000U;
  std::deque<Kept> expected;
  for (int i = 0; i < 20'000; ++i) {
    if (below(2) == 0) {
      const Kept kept{std::string(1 + below(63), 'c'), i,
                      std::vector<std::uint8_t>(below(1500), static_cast<std::uint8_t>(i))};
      if (add(kept)) expected.push_back(kept);
    } else if (!expected.empty()) {
      expect_oldest(expected.front());
      ring_.remove_oldest();
      expected.pop_front();
    }
    ASSERT_EQ(!ring_.oldest(), expected.empty());
  }
}

}  // namespace
}  // namespace gazed::log::event_ring_test
