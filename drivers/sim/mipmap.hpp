// A picture, and the filtered look-up in it that a renderer needs.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/sim/course.hpp"

namespace gazed::sim {

/// A picture at full size and halved again and again, so that a far look-up costs as much as a near
/// one and averages over what one pixel sees (Williams 1983).
class MipMap {
 public:
  static constexpr float sample_scale = 64.0F;  // samples are Q9.6
  static constexpr float value_scale = 256.0F;  // what is looked up is Q9.8

  /// Rows of 1 or 3 (`channels`) interleaved samples. `wraps`: the picture repeats in both
  /// directions (its sides are then powers of two), else its border goes on for ever.
  MipMap(int width, int height, int channels, bool wraps, std::vector<std::int16_t> samples);

  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }
  [[nodiscard]] int channels() const { return channels_; }
  /// Trilinear, for a run of pixels. x and y in samples of level 0, (0, 0) at the picture's top
  /// left corner, within +-2^15 where it does not repeat; `footprint` is the side of what a pixel
  /// sees, in samples of level 0. Writes `channels` values for each pixel until `values` is full.
  void sample(Course x, Course y, float footprint, std::span<std::int32_t> values) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::int16_t> samples;
  };

  [[nodiscard]] Level half(const Level& level) const;
  template <int channels, bool wraps>
  void sample_run(Course x, Course y, float footprint, std::span<std::int32_t> values) const;

  std::vector<Level> levels_;
  int channels_;
  bool wraps_;
};

/// Reads a binary PGM or PPM file (P5, P6; 8 bit). Throws std::invalid_argument that names the file
/// for anything else.
[[nodiscard]] std::shared_ptr<const MipMap> load_pnm(const std::string& path);

}  // namespace gazed::sim
