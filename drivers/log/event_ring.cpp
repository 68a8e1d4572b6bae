#include "drivers/log/event_ring.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <sys/mman.h>
#include <unistd.h>

namespace gazed::log {

namespace {

/// Before each event. An event lies in one piece: where it would not fit before the end of the
/// memory, an entry without a channel fills that, and it goes to the beginning.
struct Entry {
  std::uint32_t bytes = 0;  // with this entry
  std::uint32_t channel_bytes = 0;
  std::uint32_t message_bytes = 0;
  std::uint32_t reserved = 0;
  std::int64_t utime_us = 0;
};

constexpr std::size_t alignment = 8;
constexpr std::size_t filler_bytes = 8;  // the part of an entry that a filler has

/// Whole pages that lie within. Where the memory is not shared the kernel refuses, and they stay.
void give_back(std::span<std::uint8_t> memory) {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* begin = memory.data();
  std::size_t bytes = memory.size();
  if (std::align(page, page, begin, bytes) != nullptr)
    static_cast<void>(madvise(begin, bytes / page * page, MADV_REMOVE));
}

std::size_t aligned(std::size_t bytes) {
  return (bytes + alignment - 1) / alignment * alignment;
}

}  // namespace

std::size_t EventRing::bytes_of(std::size_t channel_bytes, std::size_t message_bytes) {
  return aligned(sizeof(Entry) + channel_bytes + message_bytes);
}

bool EventRing::has_room(std::size_t event_bytes, std::size_t spare_bytes) const {
  const std::uint32_t added = positions_.added.load(std::memory_order_relaxed);
  const std::uint32_t used = added - positions_.taken.load(std::memory_order_acquire);
  const std::size_t to_end = memory_.size() - offset(added);
  const std::size_t filler = event_bytes > to_end ? to_end : 0;
  return used + filler + event_bytes + spare_bytes <= memory_.size();
}

bool EventRing::add(const Event& event, std::size_t spare_bytes) {
  const auto message =
      begin_to_add(event.channel, event.utime_us, event.message.size(), spare_bytes);
  if (message.data() == nullptr) return false;
  std::ranges::copy(event.message, message.begin());
  end_to_add();
  return true;
}

std::span<std::uint8_t> EventRing::begin_to_add(std::string_view channel, std::int64_t utime_us,
                                                std::size_t message_bytes,
                                                std::size_t spare_bytes) {
  const std::size_t bytes = bytes_of(channel.size(), message_bytes);
  if (!has_room(bytes, spare_bytes)) return {};
  std::uint32_t added = positions_.added.load(std::memory_order_relaxed);
  const std::size_t to_end = memory_.size() - offset(added);
  if (bytes > to_end) {
    const Entry filler{.bytes = static_cast<std::uint32_t>(to_end)};
    std::memcpy(&memory_[offset(added)], &filler, filler_bytes);
    added += filler.bytes;
  }
  const Entry entry{.bytes = static_cast<std::uint32_t>(bytes),
                    .channel_bytes = static_cast<std::uint32_t>(channel.size()),
                    .message_bytes = static_cast<std::uint32_t>(message_bytes),
                    .utime_us = utime_us};
  const std::span<std::uint8_t> to = memory_.subspan(offset(added), bytes);
  std::memcpy(to.data(), &entry, sizeof entry);
  std::memcpy(&to[sizeof entry], channel.data(), channel.size());
  will_be_added_ = added + entry.bytes;
  return to.subspan(sizeof entry + channel.size(), message_bytes);
}

void EventRing::end_to_add() {
  positions_.added.store(will_be_added_, std::memory_order_release);
}

bool EventRing::empty() const {
  return positions_.added.load(std::memory_order_acquire) ==
         positions_.taken.load(std::memory_order_acquire);
}

std::optional<Event> EventRing::oldest() {
  while (!empty()) {
    const std::size_t at = offset(positions_.taken.load(std::memory_order_relaxed));
    std::uint32_t channel_bytes = 0;
    std::memcpy(&channel_bytes, &memory_[at + offsetof(Entry, channel_bytes)],
                sizeof channel_bytes);
    if (channel_bytes == 0) {
      remove_oldest();
      continue;
    }
    Entry entry;
    std::memcpy(&entry, &memory_[at], sizeof entry);
    const std::uint8_t* channel = &memory_[at] + sizeof entry;
    return Event{.channel = {reinterpret_cast<const char*>(channel), entry.channel_bytes},
                 .utime_us = entry.utime_us,
                 .message = {channel + entry.channel_bytes, entry.message_bytes}};
  }
  return std::nullopt;
}

void EventRing::remove_oldest() {
  const std::uint32_t taken = positions_.taken.load(std::memory_order_relaxed);
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, &memory_[offset(taken)], sizeof bytes);
  give_back(memory_.subspan(offset(taken), bytes));
  positions_.taken.store(taken + bytes, std::memory_order_release);
}

}  // namespace gazed::log
