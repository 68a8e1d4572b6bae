// The newest of what comes in a row, in fixed memory.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace gazed::base {

/// Holds up to `capacity` elements, the oldest first. Allocates nothing that T does not.
template <typename T, std::size_t capacity>
class Ring {
 public:
  /// A full ring gives up its oldest element for it; true when it had to.
  bool push(T element) {
    const bool gives_up = full();
    if (gives_up) drop_oldest();
    elements_[place(count_++)] = std::move(element);
    return gives_up;
  }
  /// Removes the oldest element and returns it; the ring must not be empty.
  T take() {
    T oldest = std::move(elements_[first_]);
    drop_oldest();
    return oldest;
  }
  /// At most as many as there are.
  void drop_newest(std::size_t count) { count_ -= count; }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] bool full() const { return count_ == capacity; }
  [[nodiscard]] std::size_t size() const { return count_; }

  /// Counted from the oldest, 0.
  [[nodiscard]] const T& operator[](std::size_t i) const { return elements_[place(i)]; }
  [[nodiscard]] T& operator[](std::size_t i) { return elements_[place(i)]; }
  [[nodiscard]] const T& oldest() const { return elements_[first_]; }
  [[nodiscard]] const T& newest() const { return elements_[place(count_ - 1)]; }

 private:
  [[nodiscard]] std::size_t place(std::size_t i) const { return (first_ + i) % capacity; }
  void drop_oldest() {
    first_ = place(1);
    --count_;
  }

  std::array<T, capacity> elements_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace gazed::base
