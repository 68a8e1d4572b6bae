// Sources that stamp everything alike.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace gazed::drivers {

/// A source that does not stamp what it sends says one stamp, 0 or another, again and again; one
/// that stamps in whole seconds says a new one now and then.
class RepeatedStamp {
 public:
  /// The stamp, or after so many of it in a row the time of arrival, where it is known, until as
  /// many in a row are new.
  [[nodiscard]] std::int64_t time_of(std::int64_t stamp_us,
                                     std::optional<std::int64_t> arrived_us) {
    saw(stamp_us, arrived_us.has_value());
    return arrival_counts() ? *arrived_us : stamp_us;
  }
  /// A stamp, by whatever clock, whose arrival has a time of its own or not.
  void saw(std::int64_t stamp, bool arrival_known) {
    const bool again = stamp_ == stamp;
    stamp_ = stamp;
    news_ = again ? 0 : std::min(news_ + 1, repeats_believed);
    const bool believed = arrival_counts() && news_ < repeats_believed;
    if (!arrival_known || !(again || believed)) repeats_ = 0;
    if (again && arrival_known) repeats_ = std::min(repeats_ + 1, repeats_believed);
  }
  /// Whether times are those of arrival.
  [[nodiscard]] bool arrival_counts() const { return repeats_ >= repeats_believed; }

 private:
  /// Messages that the network or a recorder doubled come by twos and threes.
  static constexpr int repeats_believed = 8;
  std::optional<std::int64_t> stamp_;
  int repeats_ = 0, news_ = 0;  // in a row
};

}  // namespace gazed::drivers
