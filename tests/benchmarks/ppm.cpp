#include "tests/benchmarks/ppm.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

namespace gazed::benchmarks {

namespace {

constexpr int largest_side_px = 8192;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found) {
  throw std::runtime_error(file.string() + ": " + found + "; wanted: a binary PPM (P6), 8 bit");
}

/// The first bytes, with what cannot be printed as dots.
std::string printable(std::string bytes) {
  std::replace_if(
      bytes.begin(), bytes.end(), [](char c) { return c < ' ' || c > '~'; }, '.');
  return bytes;
}

/// The next number of the header, after white space and comments.
std::optional<int> header_number(std::istream& stream) {
  while (std::isspace(stream.peek()) != 0 || stream.peek() == '#') {
    if (stream.peek() == '#') {
      std::string comment;
      std::getline(stream, comment);
    } else {
      stream.get();
    }
  }
  int number = 0;
  if (!(stream >> number)) return std::nullopt;
  return number;
}

}  // namespace

base::Image read_ppm(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) refuse(file, "a folder found");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, std::strerror(errno));
  std::string magic(2, ' ');
  stream.read(magic.data(), 2);
  if (stream.gcount() == 0) refuse(file, "an empty file found");
  if (magic != "P6") refuse(file, "'" + printable(magic) + "' found at its start");

  const auto width = header_number(stream), height = header_number(stream);
  const auto greatest = header_number(stream);
  if (!width || !height || !greatest) refuse(file, "no width, height and greatest value found");
  if (*width < 1 || *height < 1 || *width > largest_side_px || *height > largest_side_px)
    refuse(file, "size " + std::to_string(*width) + "x" + std::to_string(*height) + " found");
  if (*greatest != 255) refuse(file, "greatest value " + std::to_string(*greatest) + " found");
  stream.get();  // the single white space after the header

  base::Image image(*width, *height, base::PixelFormat::rgb24);
  const auto wanted = static_cast<std::streamsize>(image.pixels().size());
  std::string bytes(image.pixels().size(), '\0');
  stream.read(bytes.data(), wanted);
  if (stream.gcount() != wanted)
    refuse(file, std::to_string(stream.gcount()) + " of " + std::to_string(wanted) +
                     " bytes of pixels found");
  std::copy(bytes.begin(), bytes.end(), image.pixels().begin());
  return image;
}

}  // namespace gazed::benchmarks
