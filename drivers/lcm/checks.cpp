#include "drivers/lcm/checks.hpp"

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <numbers>
#include <optional>
#include <sstream>

#include "drivers/lcm/big_endian.hpp"
#include "drivers/lcm/conversions.hpp"
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

// Four characters as they are printed, or the number when it is none of that kind.
std::string four_cc_text(std::int32_t four_cc) {
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

std::optional<Refusal> check_sizes(const ImageHeader& header, base::PixelFormat format) {
  if (header.width < 1 || header.width > longest_side_px || header.height < 1 ||
      header.height > longest_side_px) {
    return refuse("an image of ", header.width, "x", header.height, " pixels; 1 to ",
                  longest_side_px, " a side can be");
  }
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

std::variant<geometry::Frame, Refusal> read_image(std::span<const std::uint8_t> message) {
  BigEndianReader reader(message);
  if (auto refusal = check_fingerprint(reader, bot_core::image_t::getHash(), "bot_core.image_t")) {
    return *refusal;
  }
  const std::optional<ImageHeader> header = read_header(reader);
  if (!header) return refuse("an image_t that ends after ", message.size(), " bytes");
  const std::optional<WireFormat> wire = wire_format(header->pixelformat);
  if (!wire) {
    return refuse("pixelformat ", four_cc_text(header->pixelformat), " found; YUYV, UYVY, RGB3, ",
                  "BGR3 or GREY (8 bit) can be read");
  }
  if (auto refusal = check_sizes(*header, wire->format)) return *refusal;
  const std::size_t available = reader.rest().size();
  const auto pixels = reader.take(header->size);
  if (!pixels) return refuse("size ", header->size, " where ", available, " bytes are left");
  if (!metadata_is_sound(reader)) return refuse("metadata that does not fit the message's length");
  return geometry::Frame{.image = {.data = pixels->data(),
                                   .width_px = header->width,
                                   .height_px = header->height,
                                   .row_stride = header->row_stride,
                                   .format = wire->format},
                         .utime_us = header->utime};
}

bool has_swapped_bytes(std::span<const std::uint8_t> message) {
  BigEndianReader reader(message);
  static_cast<void>(reader.integer<std::int64_t>());  // the fingerprint
  const std::optional<ImageHeader> header = read_header(reader);
  const auto wire = header ? wire_format(header->pixelformat) : std::nullopt;
  return wire && wire->swapped;
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
