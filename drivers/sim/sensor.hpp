// From the light on the image plane to the bytes that a camera gives: blur, exposure, noise,
// rounding, pixel format, MJPEG's losses.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "agent/base/image.hpp"
#include "drivers/sim/jpeg_loss.hpp"
#include "drivers/sim/light.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::sim {

/// Rows go in from top to bottom, each one time; the image is complete after finish(). Nothing is
/// allocated after construction.
class Sensor {
 public:
  Sensor(int width_px, int height_px, const CameraBehaviour& behaviour, std::uint64_t seed);

  /// Factor on the brightness of the rows that follow, up to 2^16; at first CameraBehaviour's.
  void set_exposure(double exposure) { exposure_q16_ = exposure_factor(exposure); }
  /// Width x (r, g, b).
  void add_row(std::span<const Light> rgb);
  /// The picture of the rows since the last call, valid until the next row.
  [[nodiscard]] base::ImageView finish();
  /// Another picture of the light of the last one: only its noise is new.
  [[nodiscard]] base::ImageView finish_again();
  /// The last picture as it was, after which the next one's noise is as if a new one had been made.
  [[nodiscard]] base::ImageView finish_nothing();

 private:
  [[nodiscard]] static std::int64_t exposure_factor(double exposure) {
    return static_cast<std::int64_t>(exposure * 0x1p16 + 0.5);
  }
  void blur_along_row(std::span<const Light> rgb, std::span<Light> blurred);
  void expose_row(int y, std::int64_t exposure_q16);
  [[nodiscard]] std::span<Light> row(int y);
  void write_row(int y);
  void write_bytes(std::uint8_t* out);
  void write_yuyv(std::uint8_t* out) const;

  int width_px_, height_px_;
  base::PixelFormat format_;
  std::int64_t exposure_q16_;
  int radius_ = 0;                    // of the blur, px
  std::vector<std::int16_t> kernel_;  // 2 radius + 1, Q1.14, sum 1
  // A still picture is given out again and again with new noise: all of its light is kept, blurred
  // along the rows. What is made of a row's light takes four times the bytes, so it is made anew.
  std::vector<Light> light_;
  std::vector<std::int64_t> exposures_q16_;  // of each row
  std::vector<std::int32_t> exposed_;        // one row: sums of weighted light, then Q15.16 levels
  std::vector<std::uint8_t> bytes_;          // one row, rgb
  std::vector<std::int32_t> noise_;          // Q15.16, quantiles of the noise; empty for none
  std::uint64_t noise_state_;
  int rows_in_ = 0;
  std::optional<JpegLoss> jpeg_;
  base::Image image_;
};

}  // namespace gazed::sim
