#include "drivers/naoqi/image_container.hpp"

#include <array>
#include <cmath>

#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

struct Part {
  enum : std::size_t { width, height, layers, colours, seconds, microseconds, pixels, count };
};

/// -1 if the value is not a whole number in the range of a time or size.
std::int64_t whole(const QiValue& value) {
  constexpr double greatest = 1e12;
  const double number = value.number().value_or(-1.0);
  return number >= 0.0 && number <= greatest ? std::llround(number) : -1;
}

}  // namespace

std::variant<NaoqiImage, std::string> read_image(const QiResult& result, int width_px,
                                                 int height_px) {
  if (!result.value) return base::excerpt(result.error);
  std::array<QiValue, Part::count> container;
  QiReader elements = result.value.elements();
  for (QiValue& part : container) part = elements.next();
  if (!container.back()) return "it has no image";
  const auto bytes = container[Part::pixels].text();
  const std::int64_t found_width = whole(container[Part::width]),
                     found_height = whole(container[Part::height]),
                     found_colours = whole(container[Part::colours]);
  if (!bytes || found_width != width_px || found_height != height_px ||
      found_colours != naoqi_yuv422) {
    return base::text("an image of %lldx%lld in colour space %lld; asked for: %dx%d in %d",
                      static_cast<long long>(found_width), static_cast<long long>(found_height),
                      static_cast<long long>(found_colours), width_px, height_px, naoqi_yuv422);
  }
  const int stride = width_px * base::bytes_per_pixel(base::PixelFormat::yuyv);
  const auto expected = static_cast<std::size_t>(stride) * static_cast<std::size_t>(height_px);
  if (bytes->size() != expected)
    return base::text("an image of %zu bytes; %zu were due", bytes->size(), expected);
  const std::int64_t stamp_s = whole(container[Part::seconds]),
                     stamp_us = whole(container[Part::microseconds]);
  if (stamp_s < 0 || stamp_us < 0 || stamp_us >= 1'000'000) return "an image without a time";
  return NaoqiImage{{reinterpret_cast<const std::uint8_t*>(bytes->data()), width_px, height_px,
                     stride, base::PixelFormat::yuyv},
                    1'000'000 * stamp_s + stamp_us};
}

}  // namespace gazed::naoqi
