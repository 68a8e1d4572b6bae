#include "agent/lab/io/encoded_picture.hpp"

#include <cstdint>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::io::encoded_picture_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<std::uint8_t> encoded(const char* extension, const std::vector<int>& parameters = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, red_disc({64, 48}, {20, 20}, 9), bytes, parameters);
  return bytes;
}

/// A JPEG with another, complete one in a segment at its front, as cameras store thumbnails.
std::vector<std::uint8_t> jpeg_with_thumbnail() {
  std::vector<std::uint8_t> jpeg = encoded(".jpg");
  const std::vector<std::uint8_t> thumbnail = encoded(".jpg");
  const std::size_t length = thumbnail.size() + 2;
  std::vector<std::uint8_t> segment = {0xFF, 0xE1, static_cast<std::uint8_t>(length >> 8),
                                       static_cast<std::uint8_t>(length & 0xFF)};
  segment.insert(segment.end(), thumbnail.begin(), thumbnail.end());
  jpeg.insert(jpeg.begin() + 2, segment.begin(), segment.end());
  return jpeg;
}

/// `marker`: bytes at the end without which the picture is still whole.
void expect_whole_and_every_cut_told_apart(const std::vector<std::uint8_t>& bytes,
                                           std::size_t signature, std::size_t marker = 0) {
  for (std::size_t length = bytes.size() - marker; length <= bytes.size(); ++length) {
    EXPECT_FALSE(ends_early(std::span(bytes).first(length))) << length << " of " << bytes.size();
  }
  for (std::size_t length = signature; length < bytes.size() - marker; ++length) {
    EXPECT_TRUE(ends_early(std::span(bytes).first(length))) << length << " of " << bytes.size();
  }
  std::vector<std::uint8_t> with_tail = bytes;
  with_tail.insert(with_tail.end(), {0xFF, 0x00, 0x12});
  EXPECT_FALSE(ends_early(with_tail));
}

// Opened as a file, it would wait for whoever writes it, for ever.
TEST(EncodedPicture, AFifoIsRefusedAtOnce) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "fifo.jpg").c_str(), 0600), 0);
  EXPECT_THAT([&] { (void)read_encoded_picture(folder / "fifo.jpg"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is a FIFO, not a picture")));
}

constexpr std::size_t end_of_image_bytes = 2;

TEST(EncodedPicture, PngCutAnywhere) {
  expect_whole_and_every_cut_told_apart(encoded(".png"), 8);
}

TEST(EncodedPicture, JpegCutAnywhere) {
  expect_whole_and_every_cut_told_apart(encoded(".jpg"), 3, end_of_image_bytes);
}

TEST(EncodedPicture, ProgressiveJpegCutAnywhere) {
  expect_whole_and_every_cut_told_apart(encoded(".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}), 3,
                                        end_of_image_bytes);
}

TEST(EncodedPicture, JpegWithRestartMarkersCutAnywhere) {
  expect_whole_and_every_cut_told_apart(encoded(".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 2}), 3,
                                        end_of_image_bytes);
}

TEST(EncodedPicture, ThumbnailInsideJpegIsNotItsEnd) {
  expect_whole_and_every_cut_told_apart(jpeg_with_thumbnail(), 3, end_of_image_bytes);
}

TEST(EncodedPicture, AnyBytesAreSafe) {
  std::mt19937_64 random(2);
  const std::vector<std::uint8_t> jpeg = encoded(".jpg");
  const std::vector<std::uint8_t> png = encoded(".png");
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<std::uint8_t> bytes = trial % 2 == 0 ? jpeg : png;
    for (int changes = 0; changes < 8; ++changes) {
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::uint8_t>(random());
    }
    static_cast<void>(ends_early(bytes));
  }
  EXPECT_FALSE(ends_early({}));
}

TEST(EncodedPicture, MissingFileIsNamed) {
  const ScratchFolder folder;
  const auto missing = folder / "nowhere.png";
  EXPECT_THAT([&] { static_cast<void>(read_encoded_picture(missing)); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr(missing.string() + ": cannot be opened: No such file")));
}

TEST(EncodedPicture, FolderIsNoPicture) {
  const ScratchFolder folder;
  EXPECT_THAT([&] { static_cast<void>(read_encoded_picture(folder.path())); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is a folder")));
}

}  // namespace
}  // namespace gazed::lab::io::encoded_picture_test
