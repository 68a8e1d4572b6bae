#include "drivers/lcm/reassembly.hpp"

#include <algorithm>

namespace gazed::lcm {

std::size_t Reassembly::held_bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.message.capacity();
  return sum;
}

Reassembly::Part* Reassembly::part_of(const DatagramSource& source) {
  const auto found = std::ranges::find_if(
      parts_, [&](const Part& part) { return part.open && part.source == source; });
  return found == parts_.end() ? nullptr : &*found;
}

/// Others give theirs back: those that hold memory for a later message first, then the oldest.
void Reassembly::make_room(const Part& part, std::size_t message_bytes) {
  const std::size_t most = messages_held_max * message_bytes_max_;
  const auto too_much = [&] {
    return held_bytes() - part.message.capacity() +
               std::max(part.message.capacity(), message_bytes) >
           most;
  };
  while (too_much()) {
    Part& other = *std::ranges::min_element(parts_, {}, [&](const Part& one) {
      if (&one == &part || one.message.capacity() == 0) return Clock::time_point::max();
      return one.open ? one.begun : Clock::time_point::min();
    });
    other.open = false;
    std::vector<std::uint8_t>().swap(other.message);  // with its memory
  }
}

Reassembly::Part* Reassembly::begin(const DatagramSource& source, const Fragment& fragment,
                                    Clock::time_point now) {
  Part* place = part_of(source);
  if (place == nullptr) {
    // A free place, else the oldest.
    place = &*std::ranges::min_element(parts_, {}, [](const Part& part) {
      return part.open ? part.begun : Clock::time_point::min();
    });
  }
  place->open = true;
  place->source = source;
  place->sequence = fragment.sequence;
  place->count = fragment.count;
  place->fragments_left = fragment.count;
  place->bytes_left = fragment.message_bytes;
  place->begun = now;
  place->channel_bytes = fragment.channel.copy(place->channel.data(), place->channel.size());
  make_room(*place, fragment.message_bytes);
  place->message.reserve(fragment.message_bytes);  // not more, as growing would
  place->message.resize(fragment.message_bytes);
  place->seen.reset();
  return place;
}

std::optional<std::span<const std::uint8_t>> Reassembly::add(const DatagramSource& source,
                                                             const Fragment& fragment,
                                                             std::size_t message_bytes_max,
                                                             Clock::time_point now) {
  for (Part& part : parts_) {
    if (part.open && now - part.begun > patience) part.open = false;
  }
  Part* part = nullptr;
  if (fragment.number == 0) {
    message_bytes_max_ = std::max(message_bytes_max_, message_bytes_max);
    // Each fragment brings a byte at least: more fragments than bytes cannot be.
    if (fragment.message_bytes > message_bytes_max || fragment.count > fragment.message_bytes) {
      return std::nullopt;
    }
    part = begin(source, fragment, now);
  } else {
    part = part_of(source);
    if (part == nullptr || part->sequence != fragment.sequence) return std::nullopt;
  }
  if (part->seen[fragment.number]) return std::nullopt;  // networks repeat packets at times
  const bool belongs = fragment.count == part->count &&
                       fragment.message_bytes == part->message.size() &&
                       fragment.data.size() <= part->bytes_left;
  if (!belongs) {
    part->open = false;
    return std::nullopt;
  }
  std::ranges::copy(fragment.data, part->message.begin() + fragment.offset);
  part->seen.set(fragment.number);
  part->bytes_left -= static_cast<std::uint32_t>(fragment.data.size());
  if (--part->fragments_left > 0) return std::nullopt;
  part->open = false;
  if (part->bytes_left > 0) return std::nullopt;
  completed_channel_ = {part->channel.data(), part->channel_bytes};
  return part->message;
}

}  // namespace gazed::lcm
