// A plane of a pyramid, or a map made from two, and the memory they lie in.
//
// Rows begin at multiples of 16 bytes and are padded to whole I16x8: kernels read and write whole
// lanes, and what lies in the padding has no meaning.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "agent/saliency/lanes.hpp"

namespace gazed::saliency {

template <typename Sample>
struct PlaneView {
  Sample* data = nullptr;
  int width = 0;
  int height = 0;
  int stride = 0;  // samples from one row to the next, padded_to_lanes(width)

  [[nodiscard]] Sample* row(int y) const { return data + static_cast<std::ptrdiff_t>(stride) * y; }
  operator PlaneView<const Sample>() const {  // NOLINT: like span
    return {data, width, height, stride};
  }
};

using Plane = PlaneView<std::int16_t>;
using ConstPlane = PlaneView<const std::int16_t>;

/// kernel(x) for each x = 0, step, 2 step, ... below `samples`; with SIMD two to a turn of the
/// loop, whose own instructions are many beside a dozen of the kernel.
template <int step = lane_count, typename Kernel>
void along_row(int samples, Kernel&& kernel) {
  int x = 0;
  if constexpr (has_simd_lanes) {
    for (; x + step < samples; x += 2 * step) {
      kernel(x);
      kernel(x + step);
    }
  }
  for (; x < samples; x += step) kernel(x);
}

/// Padding too.
template <typename Sample>
void fill(const PlaneView<Sample>& plane, Sample value) {
  std::fill(plane.data, plane.row(plane.height), value);
}

/// The samples of a plane of this size, with its padding.
[[nodiscard]] constexpr std::size_t padded_size(int width, int height) {
  return static_cast<std::size_t>(padded_to_lanes(width)) * static_cast<std::size_t>(height);
}

/// Memory that begins at a multiple of 16 bytes, as lanes are loaded from.
template <typename T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{16};

  LaneAllocator() = default;
  template <typename U>
  LaneAllocator(const LaneAllocator<U>&) {}  // NOLINT: as allocators convert

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), alignment));
  }
  void deallocate(T* samples, std::size_t) { ::operator delete(samples, alignment); }
  bool operator==(const LaneAllocator&) const = default;
};

/// Samples that begin at a multiple of 16 bytes, 0 at first. Eight samples on either side may be
/// read and written too, so that a filter need not stop at the ends of a row.
template <typename Sample>
class AlignedSamples {
 public:
  explicit AlignedSamples(std::size_t size) : samples_(size + 2 * margin) {}

  [[nodiscard]] Sample* data() { return samples_.data() + margin; }
  [[nodiscard]] const Sample* data() const { return samples_.data() + margin; }

 private:
  static constexpr std::size_t margin = lane_count;
  std::vector<Sample, LaneAllocator<Sample>> samples_;
};

/// A plane and its samples.
template <typename Sample>
class OwnedPlane {
 public:
  OwnedPlane(int width, int height)
      : samples_(padded_size(width, height)), width_(width), height_(height) {}

  [[nodiscard]] PlaneView<Sample> view() {
    return {samples_.data(), width_, height_, padded_to_lanes(width_)};
  }

 private:
  AlignedSamples<Sample> samples_;
  int width_;
  int height_;
};

}  // namespace gazed::saliency
