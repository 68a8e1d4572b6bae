// A plane of a pyramid, or a map made from two: samples of 16 bits, rows without padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gazed {

template <typename Sample>
struct PlaneView {
  Sample* data = nullptr;
  int width = 0;
  int height = 0;

  [[nodiscard]] Sample* row(int y) const { return data + static_cast<std::ptrdiff_t>(width) * y; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  operator PlaneView<const Sample>() const { return {data, width, height}; }  // NOLINT: like span
};

using Plane = PlaneView<std::int16_t>;
using ConstPlane = PlaneView<const std::int16_t>;

}  // namespace gazed
