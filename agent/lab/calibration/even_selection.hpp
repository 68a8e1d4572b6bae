// An even selection of a sequence whose length nobody knows before its end.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace gazed::lab::calibration {

/// Holds at most 2 x `most` items at any time: when there are more, every second one goes, and of
/// those to come every second one (then every fourth, ...) is not taken at all.
template <class Item>
class EvenSelection {
 public:
  explicit EvenSelection(std::size_t most) : most_(most) {}

  void add(Item item) {
    newest_is_held_ = offered_++ % stride_ == 0;
    if (!newest_is_held_) return;
    held_.push_back(std::move(item));
    if (held_.size() > 2 * most_) halve();
  }

  /// In the place of the item that was added last.
  void replace_newest(Item item) {
    if (newest_is_held_) held_.back() = std::move(item);
  }

  [[nodiscard]] std::size_t held() const { return held_.size(); }

  /// At most `most` items in the order they came in, the first one added among them. Leaves
  /// nothing.
  [[nodiscard]] std::vector<Item> take() {
    std::vector<Item> items = std::exchange(held_, {});
    if (items.size() <= most_) return items;
    std::vector<Item> selected;
    for (std::size_t i = 0; i < most_; ++i) {
      selected.push_back(std::move(items[i * items.size() / most_]));
    }
    return selected;
  }

 private:
  /// Of an odd number of items: the first and the last stay.
  void halve() {
    for (std::size_t i = 1; 2 * i < held_.size(); ++i) held_[i] = std::move(held_[2 * i]);
    held_.resize(most_ + 1);
    stride_ *= 2;
  }

  std::size_t most_;
  std::vector<Item> held_;
  std::size_t offered_ = 0;
  std::size_t stride_ = 1;  // of those offered, one in so many is held
  bool newest_is_held_ = false;
};

}  // namespace gazed::lab::calibration
