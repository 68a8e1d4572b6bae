// A plane of a pyramid, or a map made from planes, and its memory.
//
// Rows begin at multiples of 16 bytes and are padded to whole I16x8: kernels read and write whole
// lanes. The contents of the padding are undefined.
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

/// Calls kernel(x) for x = 0, step, 2 step, ... below `samples`. With SIMD the loop is unrolled
/// twice, because its own instructions are many compared with a dozen in the kernel.
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

/// Copies the padding too.
template <typename Sample>
void fill(const PlaneView<Sample>& plane, Sample value) {
  std::fill(plane.data, plane.row(plane.height), value);
}

/// Number of samples of a plane of this size, including its padding.
[[nodiscard]] constexpr std::size_t padded_size(int width, int height) {
  return static_cast<std::size_t>(padded_to_lanes(width)) * static_cast<std::size_t>(height);
}

/// Allocates at multiples of 16 bytes, as aligned loads need.
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

/// Samples whose memory begins at a multiple of 16 bytes, initially 0. Eight samples before and
/// after may be read and written, so that filters need not stop at the ends of a row.
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
