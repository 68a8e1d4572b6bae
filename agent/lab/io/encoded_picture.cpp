#include "agent/lab/io/encoded_picture.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "agent/lab/io/jpeg_scan.hpp"

namespace gazed::lab::io {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 3> jpeg_signature = {0xFF, 0xD8, 0xFF};
constexpr std::uint8_t end_of_image = 0xD9;

std::size_t big_endian(Bytes bytes) {
  std::size_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

bool starts_with(Bytes bytes, Bytes signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin());
}

/// Where the next marker after compressed data stands: an FF that is neither a stuffed data byte
/// (FF 00), nor a restart marker (FF D0 to FF D7), nor padding (FF FF).
std::size_t end_of_scan(Bytes jpeg, std::size_t at) {
  for (; at + 1 < jpeg.size(); ++at) {
    const std::uint8_t code = jpeg[at + 1];
    const bool data = code == 0x00 || code == 0xFF || (code >= 0xD0 && code <= 0xD7);
    if (jpeg[at] == 0xFF && !data) return at;
  }
  return jpeg.size();
}

/// From marker to marker up to the end of image. A search for FF D9 alone would be content with
/// that of the thumbnail that cameras put into a segment at the front.
bool lacks_end_of_image(Bytes jpeg) {
  constexpr std::uint8_t start_of_scan = 0xDA;
  std::size_t at = 2;  // after the start of image, which has no length
  while (at + 1 < jpeg.size()) {
    const std::uint8_t code = jpeg[at + 1];
    if (jpeg[at] != 0xFF || code == 0xFF) {  // padding, or rubbish that decoders skip as well
      ++at;
      continue;
    }
    if (code == end_of_image) return false;
    if (at + 4 > jpeg.size()) return true;
    at += 2 + std::max<std::size_t>(2, big_endian(jpeg.subspan(at + 2, 2)));
    if (code == start_of_scan) at = end_of_scan(jpeg, at);
  }
  return true;
}

/// A chunk: length of the data, type, data, checksum; the lengths of the others are 4 bytes each.
bool png_ends_early(Bytes png) {
  constexpr std::size_t signature_bytes = 8;
  constexpr std::size_t around_data_bytes = 12;
  std::size_t at = signature_bytes;
  while (at + around_data_bytes <= png.size()) {
    const std::size_t data = big_endian(png.subspan(at, 4));
    if (data > png.size() - at - around_data_bytes) return true;
    const Bytes type = png.subspan(at + 4, 4);
    if (std::ranges::equal(type, std::string_view("IEND"))) return false;
    at += around_data_bytes + data;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> read_encoded_picture(const std::filesystem::path& file) {
  const auto fail = [&file](const std::string& why) {
    throw std::runtime_error(file.string() + ": " + why);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("is a folder, not a picture");
  if (std::filesystem::is_fifo(file, ignored)) fail("is a FIFO, not a picture");  // it would wait
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("cannot be opened: " + std::generic_category().message(errno));
  std::vector<std::uint8_t> bytes;
  std::array<char, 1 << 16> block{};
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + stream.gcount());
  }
  if (stream.bad()) fail("cannot be read: " + std::generic_category().message(errno));
  return bytes;
}

bool ends_early(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> png_signature = {0x89, 'P',  'N',  'G',
                                                         '\r', '\n', 0x1A, '\n'};
  if (starts_with(bytes, jpeg_signature)) {
    return lacks_end_of_image(bytes) && !has_all_blocks(bytes);
  }
  if (starts_with(bytes, png_signature)) return png_ends_early(bytes);
  return false;
}

void end_jpeg(std::vector<std::uint8_t>& bytes) {
  if (starts_with(bytes, jpeg_signature)) bytes.insert(bytes.end(), {0xFF, end_of_image});
}

}  // namespace gazed::lab::io
