#include "drivers/log/event_ring.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <sys/mman.h>
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

// Shared memory of two processes, as a recording has it.
TEST(EventRing, HoldsNoMemoryForWhatWasTaken) {
  constexpr std::size_t bytes = 1 << 20, page = 4096;
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  const auto held_pages = [&] {
    std::vector<unsigned char> pages(bytes / page);
    EXPECT_EQ(mincore(memory, bytes, pages.data()), 0);
    return std::ranges::count_if(pages, [](unsigned char held) { return (held & 1) != 0; });
  };
  std::memset(memory, 1, bytes);
  if (madvise(memory, bytes, MADV_REMOVE) != 0 || held_pages() != 0) {
    munmap(memory, bytes);
    GTEST_SKIP() << "MADV_REMOVE does nothing here, as under qemu-user";
  }
  RingPositions positions;
  EventRing ring(std::span(static_cast<std::uint8_t*>(memory), bytes), positions);
  const std::vector<std::uint8_t> message(300'000, 9);
  constexpr std::ptrdiff_t ends = 2;              // pages that an event shares with its neighbours
  constexpr std::ptrdiff_t events_in_memory = 4;  // three, and what is passed over behind them
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(ring.add({"C", 1, message}, 0));
    EXPECT_GE(held_pages(), static_cast<std::ptrdiff_t>(message.size() / page));
    ASSERT_TRUE(ring.oldest());
    ring.remove_oldest();
    EXPECT_LE(held_pages(), ends * events_in_memory);
  }
  munmap(memory, bytes);
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
