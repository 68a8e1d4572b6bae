#include "drivers/lcm/publisher_watch.hpp"

#include <algorithm>

#include "agent/base/counted.hpp"
#include "drivers/lcm/big_endian.hpp"

namespace gazed::lcm {

namespace {

constexpr std::chrono::seconds between_warnings{60};
// Numbers and five texts, of which the fault is the longest.
constexpr std::size_t status_bytes_max = 16384;

// FNV-1a, 64 bits (Fowler, Noll, Vo). A status holds its utime: no two of a program are the same.
std::uint64_t hash(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : bytes) value = (value ^ byte) * 0x100000001b3U;
  return value;
}

}  // namespace

PublisherWatch::PublisherWatch(LcmLink& link, const Channels& channels)
    : channel_(channels.status) {
  link.subscribe(channel_, status_bytes_max, [this](auto message) { received(message); });
}

void PublisherWatch::sent(const status_t& status) {
  encoded_.resize(static_cast<std::size_t>(status.getEncodedSize()));
  status.encode(encoded_.data(), 0, static_cast<int>(encoded_.size()));
  sent_hashes_[sent_count_++ % sent_hashes_.size()] = hash(encoded_);
}

void PublisherWatch::received(std::span<const std::uint8_t> message) {
  // What is no status_t at all is damage, not another gazed.
  const auto fingerprint = BigEndianReader(message).integer<std::int64_t>();
  if (!fingerprint || *fingerprint != status_t::getHash()) return;
  const auto end = sent_hashes_.begin() +
                   static_cast<std::ptrdiff_t>(std::min(sent_count_, sent_hashes_.size()));
  if (std::find(sent_hashes_.begin(), end, hash(message)) == end) ++foreign_;
}

std::string PublisherWatch::warning(Clock::time_point now) {
  if (foreign_ == reported_ || (reported_ > 0 && now < quiet_until_)) return {};
  reported_ = foreign_;
  quiet_until_ = now + between_warnings;
  return "another program publishes on " + channel_ + " too (" +
         base::counted(foreign_, "message") +
         " so far): readers get its points among these. End it, or give one of the two "
         "another LCM prefix or URL";
}

}  // namespace gazed::lcm
