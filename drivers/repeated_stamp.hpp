// Sources that give everything the same time stamp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace gazed::drivers {

/// A source without time stamps sends the same stamp, 0 or another, again and again; one that
/// stamps in whole seconds sends a new one now and then.
class RepeatedStamp {
 public:
  /// Returns the stamp. After so many equal stamps in a row, returns the time of arrival instead,
  /// if known, until as many in a row are new.
  [[nodiscard]] std::int64_t time_of(std::int64_t stamp_us,
                                     std::optional<std::int64_t> arrived_us) {
    saw(stamp_us, arrived_us.has_value());
    return arrival_counts() ? *arrived_us : stamp_us;
  }
  /// Records a stamp (of any clock), and whether its time of arrival is known.
  void saw(std::int64_t stamp, bool arrival_known) {
    const bool again = stamp_ == stamp;
    stamp_ = stamp;
    news_ = again ? 0 : std::min(news_ + 1, repeats_believed);
    const bool believed = arrival_counts() && news_ < repeats_believed;
    if (!arrival_known || !(again || believed)) repeats_ = 0;
    if (again && arrival_known) repeats_ = std::min(repeats_ + 1, repeats_believed);
  }
  /// True if times are those of arrival.
  [[nodiscard]] bool arrival_counts() const { return repeats_ >= repeats_believed; }

 private:
  /// Messages duplicated by the network or a recorder come in twos and threes.
  static constexpr int repeats_believed = 8;
  std::optional<std::int64_t> stamp_;
  int repeats_ = 0, news_ = 0;  // in a row
};

}  // namespace gazed::drivers
