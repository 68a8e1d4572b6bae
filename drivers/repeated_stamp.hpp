// Sources that stamp everything alike.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace gazed::drivers {

/// A source that does not stamp what it sends says one stamp, 0 or another, again and again.
class RepeatedStamp {
 public:
  /// The stamp, or after so many of it in a row the time of arrival, where it is known.
  [[nodiscard]] std::int64_t time_of(std::int64_t stamp_us,
                                     std::optional<std::int64_t> arrived_us) {
    const bool again = stamp_us_ == stamp_us;
    stamp_us_ = stamp_us;
    repeats_ = again && arrived_us ? std::min(repeats_ + 1, repeats_believed) : 0;
    return arrival_counts() ? *arrived_us : stamp_us;
  }
  /// Whether times are those of arrival.
  [[nodiscard]] bool arrival_counts() const { return repeats_ >= repeats_believed; }

 private:
  /// Messages that the network or a recorder doubled come by twos and threes.
  static constexpr int repeats_believed = 8;
  std::optional<std::int64_t> stamp_us_;
  int repeats_ = 0;
};

}  // namespace gazed::drivers
