#include "agent/lab/io/picture.hpp"

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::io::picture_test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

cv::Mat written_and_read(const cv::Mat& picture, const std::string& name) {
  const ScratchFolder folder;
  cv::imwrite((folder / name).string(), picture);
  return read_picture(folder / name);
}

/// Centre of the pixels redder than half way from wall to disc, weighted by how red they are.
cv::Point2d red_centre(const cv::Mat& bgr) {
  double sum = 0.0;
  cv::Point2d weighted(0.0, 0.0);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const auto pixel = bgr.at<cv::Vec3b>(y, x);
      const double redness = std::max(0, pixel[2] - pixel[1]);
      sum += redness;
      weighted += redness * cv::Point2d(x, y);
    }
  }
  return weighted / sum;
}

TEST(Picture, ColourStaysAsItIs) {
  const cv::Mat disc = red_disc({64, 48}, {20, 30}, 8);
  const cv::Mat read = written_and_read(disc, "colour.png");
  EXPECT_EQ(cv::norm(read, disc, cv::NORM_INF), 0.0);
}

TEST(Picture, GreyBecomesColour) {
  const cv::Mat read = written_and_read(cv::Mat(48, 64, CV_8UC1, cv::Scalar(77)), "grey.png");
  EXPECT_EQ(read.type(), CV_8UC3);
  EXPECT_EQ(read.at<cv::Vec3b>(5, 5), cv::Vec3b(77, 77, 77));
}

TEST(Picture, SixteenBitBecomeEight) {
  const cv::Mat read = written_and_read(cv::Mat(48, 64, CV_16UC1, cv::Scalar(0x8040)), "deep.png");
  EXPECT_EQ(read.at<cv::Vec3b>(5, 5), cv::Vec3b(0x80, 0x80, 0x80));
}

TEST(Picture, TransparencyIsDropped) {
  const cv::Mat read =
      written_and_read(cv::Mat(48, 64, CV_8UC4, cv::Scalar(10, 20, 30, 0)), "alpha.png");
  EXPECT_EQ(read.at<cv::Vec3b>(5, 5), cv::Vec3b(10, 20, 30));
}

TEST(Picture, TruncatedOfEveryFormatIsRefusedByName) {
  for (const char* extension : {".png", ".jpg", ".ppm", ".bmp", ".tiff", ".webp"}) {
    const ScratchFolder folder;
    const auto whole = folder / (std::string("whole") + extension);
    const auto cut = folder / (std::string("cut") + extension);
    cv::imwrite(whole.string(), red_disc({200, 150}, {60, 60}, 30));
    const auto size = std::filesystem::file_size(whole);
    for (const std::size_t bytes : {size / 50 + 9, size / 2, size - 20}) {
      write_cut(whole, cut, bytes);
      EXPECT_THAT([&] { static_cast<void>(read_picture(cut)); },
                  ThrowsMessage<std::runtime_error>(HasSubstr(cut.string() + ": ")))
          << extension << ", " << bytes << " of " << size << " bytes";
    }
  }
}

/// Of a picture with a disc, `damage` done to its bytes.
template <class Damage>
std::string damaged(const ScratchFolder& folder, const std::string& name, Damage damage) {
  const std::string file = folder / name;
  cv::imwrite(file, red_disc({64, 48}, {20, 30}, 8));
  std::string bytes = file_text(file);
  damage(bytes);
  write_text(file, bytes);
  return file;
}

TEST(Picture, DecodersSayNothingOfTheirOwn) {
  const ScratchFolder folder;
  const auto flip_in_the_middle = [](std::string& bytes) { bytes.at(bytes.size() / 2) ^= 0x55; };
  const auto cut = [](std::string& bytes) { bytes.resize(bytes.size() / 2); };
  const std::string png = damaged(folder, "d.png", flip_in_the_middle),
                    jp2 = damaged(folder, "d.jp2", cut), bmp = damaged(folder, "d.bmp", cut),
                    tiff = damaged(folder, "d.tiff", cut), ppm = damaged(folder, "d.ppm", cut);
  for (const std::string& file : {png, jp2, bmp, tiff, ppm}) {
    ::testing::internal::CaptureStderr();
    EXPECT_THAT([&] { static_cast<void>(read_picture(file)); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(file), HasSubstr("damaged"))));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << file;
  }
  EXPECT_THAT([&] { static_cast<void>(read_picture(png)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("libpng")));
  // OpenCV 4.6 says what it found, 4.10 nothing.
  EXPECT_THAT([&] { static_cast<void>(read_picture(bmp)); },
              ThrowsMessage<std::runtime_error>(
                  AnyOf(EndsWith("damaged: Unexpected end of input stream"), EndsWith("damaged"))));
}

TEST(Picture, DamageThatADecoderBridgesIsReportedByTheFilesName) {
  const ScratchFolder folder;
  // More than the last block needs, and than a decoder reads ahead, before the end-of-image marker.
  const std::string file = damaged(
      folder, "d.jpg", [](std::string& bytes) { bytes.insert(bytes.size() - 2, 16, '\x55'); });
  ::testing::internal::CaptureStderr();
  const cv::Mat picture = read_picture(file);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              AllOf(StartsWith(file + ": damaged, and used all the same: "), HasSubstr("JPEG")));
  EXPECT_EQ(picture.size(), cv::Size(64, 48));
}

TEST(Picture, EmptyFileIsRefused) {
  const ScratchFolder folder;
  write_text(folder / "empty.jpg", "");
  EXPECT_THAT([&] { static_cast<void>(read_picture(folder / "empty.jpg")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("empty.jpg: the file is empty")));
}

TEST(Picture, TextIsRefused) {
  const ScratchFolder folder;
  write_text(folder / "notes.jpg", "these are not the pixels you are looking for\n");
  EXPECT_THAT([&] { static_cast<void>(read_picture(folder / "notes.jpg")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("notes.jpg: not a picture")));
}

TEST(Picture, HugeSizeInHeaderIsRefused) {
  const ScratchFolder folder;
  write_text(folder / "huge.ppm", "P6\n2000000 2000000\n255\nabc");
  EXPECT_THROW(static_cast<void>(read_picture(folder / "huge.ppm")), std::runtime_error);
}

TEST(Picture, ZeroSizeInHeaderIsRefused) {
  const ScratchFolder folder;
  write_text(folder / "zero.ppm", "P6\n0 0\n255\n");
  EXPECT_THROW(static_cast<void>(read_picture(folder / "zero.ppm")), std::runtime_error);
}

// 640x426 reduced and 427x640 keep their size; 1000x667 would give each axis its own factor if the
// shorter side were rounded first.
TEST(Picture, ScalingMovesPixelsByOneFactor) {
  // The disc's centre of mass after resampling; its edge is quantised to 1/256 of a pixel's colour.
  constexpr double tolerance_px = 0.02;
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(1920, 1280), cv::Size(640, 426),
                              cv::Size(427, 640), cv::Size(1000, 667), cv::Size(1333, 1000)}) {
    const double longer = std::max(size.width, size.height);
    const cv::Point2d centre(0.83 * size.width, 0.78 * size.height);
    const cv::Mat picture = red_disc(size, centre, 0.08 * longer);
    const double scale = working_scale(picture);
    const cv::Mat working = scaled(picture, scale);
    EXPECT_EQ(std::max(working.cols, working.rows), working_long_side_px);
    const cv::Point2d found = red_centre(working);
    const geometry::Pixel back = input_pixel({found.x, found.y}, scale);
    EXPECT_NEAR(back.x(), centre.x, tolerance_px / scale) << size;
    EXPECT_NEAR(back.y(), centre.y, tolerance_px / scale) << size;
  }
}

TEST(Picture, ShrinkingTakesTheMeanOfTheArea) {
  cv::Mat stripes(1280, 1280, CV_8UC3, cv::Scalar(0, 0, 0));
  for (int x = 0; x < stripes.cols; x += 2) stripes.col(x).setTo(cv::Scalar(200, 100, 50));
  const cv::Mat working = scaled(stripes, working_scale(stripes));
  EXPECT_EQ(working.at<cv::Vec3b>(300, 300), cv::Vec3b(100, 50, 25));
}

TEST(Picture, AgentSeesRedFirst) {
  const cv::Mat rgb = rgb_of(cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3)));
  const base::ImageView view = view_of(rgb);
  EXPECT_EQ(view.data[0], 3);
  EXPECT_EQ(view.data[2], 1);
  EXPECT_EQ(view.row_stride, 6);
}

}  // namespace
}  // namespace gazed::lab::io::picture_test
