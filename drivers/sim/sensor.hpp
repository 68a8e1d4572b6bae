// From the light on the image plane to the bytes that a camera gives: blur, exposure, noise,
// rounding, pixel format.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/image.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed {

/// Rows go in from top to bottom, each one time; the image is complete after finish(). Nothing is
/// allocated after construction.
class Sensor {
 public:
  Sensor(int width_px, int height_px, const CameraBehaviour& behaviour, std::uint64_t seed);

  /// Factor on the brightness of the rows that follow; at first CameraBehaviour's.
  void set_exposure(double exposure) { exposure_ = static_cast<float>(exposure); }
  /// Width x (r, g, b), grey levels.
  void add_row(std::span<const float> rgb);
  /// The picture of the rows since the last call, valid until the next row.
  [[nodiscard]] ImageView finish();
  /// Another picture of the light of the last one: only its noise is new.
  [[nodiscard]] ImageView finish_again();

 private:
  void blur_along_row(std::span<const float> rgb, std::span<float> blurred) const;
  void write_row(int y);
  [[nodiscard]] std::span<std::int32_t> exposed_row(int y);
  void add_noise(int y);
  void write_bytes(std::span<const std::int32_t> exposed, std::uint8_t* out);
  void write_yuyv(std::uint8_t* out) const;

  int width_px_, height_px_;
  PixelFormat format_;
  float exposure_;
  int radius_ = 0;                        // of the blur, px
  std::vector<float> kernel_;             // 2 radius + 1, sum 1
  std::vector<std::vector<float>> rows_;  // the last 2 radius + 1 rows, blurred along the row
  std::vector<float> row_;                // blurred both ways
  // Grey levels in Q15.16: a still picture is given out again and again with new noise, which on an
  // emulated CPU costs a fifth of what it does in floating point.
  std::vector<std::int32_t> exposed_;  // the whole picture, without noise
  std::vector<std::uint8_t> bytes_;    // one row, rgb
  std::vector<std::int32_t> noise_;    // Q15.16, quantiles of the noise; empty for none
  std::uint64_t noise_state_;
  int rows_in_ = 0;
  Image image_;
};

}  // namespace gazed
