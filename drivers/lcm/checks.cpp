#include "drivers/lcm/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <numbers>
#include <optional>
#include <sstream>

#include "drivers/lcm/big_endian.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

namespace gazed::lcm {

namespace {

// More than any camera; small enough that products of two sides and a pixel's bytes stay in 32
// bits.
constexpr std::int32_t longest_side_px = 16384;

// Joins its arguments: "image of ", 320, "x", 240.
template <class... Parts>
Refusal refuse(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return {text.str()};
}

// What libbot2's image_t.lcm calls the formats that cameras have and gazed does not read, of those
// whose number says nothing.
struct NamedFormat {
  std::int32_t number;
  const char* name;
};
constexpr std::array named_formats{
    NamedFormat{357, "BE_GRAY16 (grey of 16 bit)"},
    NamedFormat{909199180, "LE_GRAY16 (grey of 16 bit)"},
    NamedFormat{358, "BE_RGB16 (RGB of 16 bit)"},
    NamedFormat{1279412050, "LE_RGB16 (RGB of 16 bit)"},
    NamedFormat{359, "BE_SIGNED_GRAY16 (grey of 16 bit)"},
    NamedFormat{360, "BE_SIGNED_RGB16 (RGB of 16 bit)"},
    NamedFormat{825770306, "BAYER_BGGR (a sensor's mosaic)"},
    NamedFormat{844650584, "BAYER_GBRG (a sensor's mosaic)"},
    NamedFormat{861427800, "BAYER_GRBG (a sensor's mosaic)"},
    NamedFormat{878205016, "BAYER_RGGB (a sensor's mosaic)"},
    NamedFormat{'Y' | '1' << 8 | '6' << 16 | ' ' << 24, "Y16 (grey of 16 bit)"},
};

// Its name, or its four characters as they are printed, or the number when it is none of that kind.
std::string format_text(std::int32_t four_cc) {
  const auto named = std::ranges::find(named_formats, four_cc, &NamedFormat::number);
  if (named != named_formats.end()) return named->name;
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const auto c = static_cast<char>(static_cast<std::uint32_t>(four_cc) >> shift & 0xFF);
    if (c < ' ' || c > '~') return std::to_string(four_cc);
    text += c;
  }
  return text;
}

std::optional<Refusal> check_fingerprint(BigEndianReader& reader, std::int64_t expected,
                                         const char* type) {
  const std::optional<std::int64_t> found = reader.integer<std::int64_t>();
  if (!found) return refuse("too short to be a ", type);
  if (*found == expected) return std::nullopt;
  return refuse("not a ", type, ": fingerprint ", std::hex, std::setfill('0'), std::setw(16),
                *found, " found, ", std::setw(16), expected, " expected");
}

// True when the rest is well-formed metadata, of which gazed needs nothing, and ends with it.
bool metadata_is_sound(BigEndianReader& reader) {
  const auto count = reader.integer<std::int32_t>();
  if (!count || *count < 0) return false;
  for (std::int32_t i = 0; i < *count; ++i) {
    const auto key_bytes = reader.integer<std::int32_t>();  // with its closing zero
    if (!key_bytes || *key_bytes < 1 || !reader.take(*key_bytes)) return false;
    const auto value_bytes = reader.integer<std::int32_t>();
    if (!value_bytes || !reader.take(*value_bytes)) return false;
  }
  return reader.rest().empty();
}

struct ImageHeader {
  std::int64_t utime;
  std::int32_t width, height, row_stride, pixelformat, size;
};

std::optional<ImageHeader> read_header(BigEndianReader& reader) {
  const auto utime = reader.integer<std::int64_t>();
  const auto width = reader.integer<std::int32_t>();
  const auto height = reader.integer<std::int32_t>();
  const auto row_stride = reader.integer<std::int32_t>();
  const auto pixelformat = reader.integer<std::int32_t>();
  const auto size = reader.integer<std::int32_t>();
  if (!size) return std::nullopt;  // the last one: none of the others is missing either
  return ImageHeader{*utime, *width, *height, *row_stride, *pixelformat, *size};
}

std::optional<Refusal> check_sides(const ImageHeader& header) {
  if (header.width < 1 || header.width > longest_side_px || header.height < 1 ||
      header.height > longest_side_px) {
    return refuse("an image of ", header.width, "x", header.height, " pixels; 1 to ",
                  longest_side_px, " a side can be");
  }
  return std::nullopt;
}

/// After check_sides().
std::optional<Refusal> check_rows(const ImageHeader& header, base::PixelFormat format) {
  const std::int32_t row_bytes = header.width * base::bytes_per_pixel(format);
  if (header.row_stride < row_bytes) {
    return refuse("row_stride ", header.row_stride, " where a row of ", header.width,
                  " pixels has ", row_bytes, " bytes");
  }
  const std::int64_t needed =
      static_cast<std::int64_t>(header.row_stride) * (header.height - 1) + row_bytes;
  if (header.size < needed) {
    return refuse("size ", header.size, " where ", header.height, " rows at row_stride ",
                  header.row_stride, " need ", needed, " bytes");
  }
  return std::nullopt;
}

}  // namespace

std::variant<WireImage, Refusal> read_image(std::span<const std::uint8_t> message) {
  BigEndianReader reader(message);
  if (auto refusal = check_fingerprint(reader, bot_core::image_t::getHash(), "bot_core.image_t")) {
    return *refusal;
  }
  const std::optional<ImageHeader> header = read_header(reader);
  if (!header) return refuse("an image_t that ends after ", message.size(), " bytes");
  const std::optional<WireFormat> wire = wire_format(header->pixelformat);
  if (!wire) {
    return refuse("pixelformat ", format_text(header->pixelformat), " found; YUYV, UYVY, RGB3, ",
                  "BGR3, GREY (8 bit) or MJPG can be read");
  }
  if (auto refusal = check_sides(*header)) return *refusal;
  const bool is_jpeg = wire->coding == Coding::jpeg;
  if (!is_jpeg) {
    if (auto refusal = check_rows(*header, wire->format)) return *refusal;
  }
  const std::size_t available = reader.rest().size();
  const auto bytes = reader.take(header->size);
  if (!bytes) return refuse("size ", header->size, " where ", available, " bytes are left");
  if (!metadata_is_sound(reader)) return refuse("metadata that does not fit the message's length");
  WireImage image{.frame = {.image = {.data = is_jpeg ? nullptr : bytes->data(),
                                      .width_px = header->width,
                                      .height_px = header->height,
                                      .row_stride = header->row_stride,
                                      .format = wire->format},
                            .utime_us = header->utime},
                  .coding = wire->coding};
  if (is_jpeg) image.jpeg = *bytes;
  return image;
}

std::variant<geometry::HeadState, Refusal> read_head_state(std::span<const std::uint8_t> message) {
  BigEndianReader reader(message);
  if (auto refusal = check_fingerprint(reader, head_state_t::getHash(), "gazed.head_state_t")) {
    return *refusal;
  }
  head_state_t decoded;
  const int size = decoded.getEncodedSize();
  if (message.size() != static_cast<std::size_t>(size) ||
      decoded.decode(message.data(), 0, size) != size) {
    return refuse("a head_state_t of ", message.size(), " bytes; it has ", size);
  }
  const geometry::HeadState state = from_message(decoded);
  for (const double angle_rad : {state.measured.yaw_rad, state.measured.pitch_rad}) {
    if (!(std::abs(angle_rad) <= std::numbers::pi)) {
      return refuse("head angles (", state.measured.yaw_rad, ", ", state.measured.pitch_rad,
                    ") rad; finite ones within +-pi can be");
    }
  }
  return state;
}

}  // namespace gazed::lcm
