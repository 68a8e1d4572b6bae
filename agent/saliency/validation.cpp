#include "agent/saliency/validation.hpp"

#include <stdexcept>
#include <string>

#include "agent/base/range.hpp"
#include "agent/base/text.hpp"

namespace gazed::saliency {

namespace {

void require(const char* name, double value, const base::Range& range) {
  if (!range.contains(value))
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                ", must be from " + std::to_string(range.min) + " to " +
                                std::to_string(range.max));
}

void require_factors(const char* of, std::size_t factors, std::size_t map_samples) {
  if (factors != 0 && factors != map_samples)
    throw std::invalid_argument(std::string(of) + " has " + std::to_string(factors) +
                                " factors, the map has " + std::to_string(map_samples) +
                                " samples");
}

}  // namespace

void require_settings(const SaliencySettings& settings) {
  require("intensity_weight", settings.intensity_weight, weight_range);
  require("colour_weight", settings.colour_weight, weight_range);
  if (settings.intensity_weight + settings.colour_weight <= 0.0)
    throw std::invalid_argument("intensity_weight and colour_weight are both 0");
  require("red_green_weight", settings.red_green_weight, weight_range);
  require("blue_yellow_weight", settings.blue_yellow_weight, weight_range);
  if (settings.red_green_weight + settings.blue_yellow_weight <= 0.0)
    throw std::invalid_argument("red_green_weight and blue_yellow_weight are both 0");
  require("flicker_weight", settings.flicker_weight, weight_range);
  require("distinctness_min", settings.distinctness_min, distinctness_range);
  require("intensity_noise_floor", settings.intensity_noise_floor, noise_floor_range);
  require("colour_noise_floor", settings.colour_noise_floor, noise_floor_range);
  require("flicker_noise_floor", settings.flicker_noise_floor, noise_floor_range);
  require("overexposed_weight", settings.overexposed_weight, overexposed_weight_range);
  require("hysteresis", settings.hysteresis, hysteresis_range);
  require("inhibition_radius_rad", settings.inhibition_radius_rad, inhibition_radius_range_rad);
  require("inhibition_decay_s", settings.inhibition_decay_s, inhibition_decay_range_s);
}

bool size_is_taken(int width_px, int height_px) {
  return frame_width_range_px.contains(width_px) && frame_height_range_px.contains(height_px);
}

std::string sizes_taken() {
  const auto corner = [](double width, double height) {
    return base::size_text(static_cast<int>(width), static_cast<int>(height));
  };
  return corner(frame_width_range_px.min, frame_height_range_px.min) + " to " +
         corner(frame_width_range_px.max, frame_height_range_px.max);
}

void require_size(int width_px, int height_px) {
  if (!size_is_taken(width_px, height_px))
    throw std::invalid_argument("frame size " + base::size_text(width_px, height_px) +
                                " is not from " + sizes_taken());
}

void require_frame(const base::ImageView& frame, int width_px, int height_px) {
  if (frame.empty()) throw std::invalid_argument("the frame has no pixels");
  if (frame.width_px != width_px || frame.height_px != height_px)
    throw std::invalid_argument("frame size " + base::size_text(frame.width_px, frame.height_px) +
                                " is not the " + base::size_text(width_px, height_px) +
                                " given at construction");
  if (frame.row_stride < frame.width_px * base::bytes_per_pixel(frame.format))
    throw std::invalid_argument("row stride " + std::to_string(frame.row_stride) +
                                " is shorter than a row of " + std::to_string(frame.width_px) +
                                " pixels");
  if (frame.format == base::PixelFormat::yuyv && frame.width_px % 2 != 0)
    throw std::invalid_argument("a YUYV frame of odd width " + std::to_string(frame.width_px));
}

void require_context(const FrameContext& context, std::size_t map_samples) {
  require_factors("what is kept", context.kept.size(), map_samples);
  require_factors("what is without own parts", context.without_own_parts.size(), map_samples);
}

}  // namespace gazed::saliency
