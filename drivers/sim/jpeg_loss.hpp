// What MJPEG loses, without a codec: pictures are taken apart into blocks, the blocks into cosines,
// the cosines rounded to the standard's steps, and all put together again.
#pragma once

#include <array>
#include <cstdint>

#include "agent/base/image.hpp"

namespace gazed::sim {

class JpegLoss {
 public:
  static constexpr int block_size = 8;
  static constexpr std::size_t block_samples = 64;
  using Block = std::array<std::int32_t, block_samples>;  // row by row
  using Steps = std::array<std::int32_t, block_samples>;

  /// 1 to 100; the standard's tables at 50, as libjpeg scales them otherwise.
  explicit JpegLoss(int quality);

  /// A YUYV picture as a camera gives it that compresses with 4:2:2 and decodes again. Whole
  /// numbers: the same bits everywhere.
  void degrade(base::Image& yuyv) const;
  /// Samples, 0 to 255.
  void degrade(Block& block, const Steps& steps) const;

  [[nodiscard]] const Steps& luma_steps() const { return luma_; }
  [[nodiscard]] const Steps& chroma_steps() const { return chroma_; }

 private:
  /// Every `stride`-th byte of a row from `first` on is a sample, `columns` of them.
  void degrade_plane(base::Image& image, int first, int stride, int columns,
                     const Steps& steps) const;

  std::array<std::int32_t, block_samples> cosines_q13_{};  // frequency by place
  Steps luma_{}, chroma_{};
};

}  // namespace gazed::sim
