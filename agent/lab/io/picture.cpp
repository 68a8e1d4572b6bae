#include "agent/lab/io/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/io/decoder_words.hpp"
#include "agent/lab/io/encoded_picture.hpp"

namespace gazed::lab::io {

namespace {

/// 16 bit a sample, of which a sensor of 10, 12 or 14 bit fills the lower ones, to the upper 8 of
/// those that are used.
cv::Mat upper_bits(const cv::Mat& picture) {
  double greatest = 0.0;
  cv::minMaxLoc(picture.reshape(1), nullptr, &greatest);
  int bits = 8;
  while (bits < 16 && greatest >= std::ldexp(1.0, bits)) bits += 2;
  cv::Mat result(picture.size(), CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    const auto* const from = picture.ptr<std::uint16_t>(y);
    std::transform(
        from, from + 3 * static_cast<std::ptrdiff_t>(picture.cols), result.ptr<std::uint8_t>(y),
        [bits](std::uint16_t sample) { return static_cast<std::uint8_t>(sample >> (bits - 8)); });
  }
  return result;
}

cv::Mat decoded(const std::vector<std::uint8_t>& bytes, Orientation orientation) {
  const int turned = orientation == Orientation::as_coded ? cv::IMREAD_IGNORE_ORIENTATION : 0;
  const cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | turned);
  if (picture.type() == CV_16UC3) return upper_bits(picture);
  if (picture.empty() || picture.type() == CV_8UC3) return picture;
  return cv::imdecode(bytes, cv::IMREAD_COLOR | turned);  // floating point: as OpenCV has it
}

}  // namespace

cv::Mat read_picture(const std::filesystem::path& file, Orientation orientation) {
  const auto fail = [&file](const std::string& why) {
    throw std::runtime_error(file.string() + ": " + why);
  };
  std::vector<std::uint8_t> bytes = read_encoded_picture(file);
  if (bytes.empty()) fail("the file is empty");
  if (ends_early(bytes)) fail("the picture ends early: the file is truncated or damaged");
  end_jpeg(bytes);

  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  DecoderWords words;
  cv::Mat picture;
  try {
    picture = decoded(bytes, orientation);
  } catch (const cv::Exception& error) {  // sizes beyond what OpenCV accepts
    fail("cannot be decoded: " + error.err);
  } catch (const std::bad_alloc&) {
    fail("cannot be decoded: not enough memory");
  }
  const std::string heard = words.heard();
  if (picture.empty() && heard.empty())
    fail(base::text("not a picture that can be decoded (%s), or damaged", picture_formats));
  if (picture.empty()) fail("damaged: " + heard);
  if (!heard.empty())
    std::fprintf(stderr, "%s: damaged, and used all the same: %s\n", file.c_str(), heard.c_str());
  return picture;
}

cv::Mat scaled(const cv::Mat& picture, double scale) {
  if (scale == 1.0) return picture;
  cv::Mat result;
  // The factors, not the resulting size, are given: otherwise the rounding of the shorter side
  // would give each axis its own factor.
  cv::resize(picture, result, cv::Size(), scale, scale,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result;
}

cv::Mat resampled(const cv::Mat& picture, cv::Size size) {
  if (size == picture.size()) return picture;
  cv::Mat result;
  const bool shrinks = size.width < picture.cols;
  cv::resize(picture, result, size, 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result;
}

double working_scale(const cv::Mat& picture) {
  return static_cast<double>(working_long_side_px) / std::max(picture.cols, picture.rows);
}

geometry::Pixel input_pixel(const geometry::Pixel& working_px, double scale) {
  return (working_px.array() + 0.5) / scale - 0.5;
}

cv::Mat rgb_of(const cv::Mat& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

base::ImageView view_of(const cv::Mat& rgb) {
  return {rgb.data, rgb.cols, rgb.rows, static_cast<int>(rgb.step[0]), base::PixelFormat::rgb24};
}

}  // namespace gazed::lab::io
