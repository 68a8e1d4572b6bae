// Pictures from files, and their reduction to the size that the saliency map works on.
//
// 16 bit are reduced to 8, of samples of 10, 12 or 14 bit to the upper 8 of those; grey becomes
// colour, transparency is dropped. The working frame is the input scaled by one factor s so that
// its longer side is 640.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"

namespace gazed::lab::io {

constexpr int working_long_side_px = 640;

/// A camera notes how it was held. As shown: turned by it, as a viewer does. As coded: as the
/// sensor has its pixels, which is what a calibration is about.
enum class Orientation : std::uint8_t { as_shown, as_coded };

/// What read_picture() reads, for people.
constexpr const char* picture_formats = "JPEG, PNG, PPM, PGM, BMP, TIFF, WebP, JPEG 2000";

/// The picture in `file` as 8UC3 in OpenCV's order blue, green, red. Throws std::runtime_error that
/// names the file and says what is wrong: missing, empty, truncated, damaged, not a picture. A
/// picture that ends early is refused: a decoder would fill the rest with grey. Damage that the
/// decoder bridges is reported on the standard error.
[[nodiscard]] cv::Mat read_picture(const std::filesystem::path& file,
                                   Orientation orientation = Orientation::as_shown);

/// The picture scaled by `scale` in both directions: the area average when it shrinks (a pixel is
/// the mean of what it covers), bilinear when it grows. 8UC3, same order of colours.
[[nodiscard]] cv::Mat scaled(const cv::Mat& picture, double scale);

/// The picture at another size of the same shape, resampled in the same way.
[[nodiscard]] cv::Mat resampled(const cv::Mat& picture, cv::Size size);

/// The factor s that makes the longer side working_long_side_px.
[[nodiscard]] double working_scale(const cv::Mat& picture);

/// Where a pixel of the working frame lies in the input: (p + 0.5) / s - 0.5, since pixel (0,0) is
/// the centre of the top left pixel in both.
[[nodiscard]] geometry::Pixel input_pixel(const geometry::Pixel& working_px, double scale);

/// 8UC3 in the order red, green, blue, as the agent takes it; rows unpadded.
[[nodiscard]] cv::Mat rgb_of(const cv::Mat& bgr);

/// Borrows the pixels of `rgb` (8UC3 in the order red, green, blue).
[[nodiscard]] base::ImageView view_of(const cv::Mat& rgb);

}  // namespace gazed::lab::io
