#include "agent/saliency/saliency.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/distinctness.hpp"
#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/fixed.hpp"
#include "agent/saliency/low_levels.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed {

namespace {

using LowLevels = std::variant<PixelOpponents, LateOpponents>;

LowLevels low_levels_for(const SaliencySettings& settings, int width_px, int height_px) {
  if (settings.profile == SaliencyProfile::report)
    return PixelOpponents(width_px, height_px, settings.clamp_negative);
  return LateOpponents(width_px, height_px);
}

void require_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                ", must be from " + std::to_string(low) + " to " +
                                std::to_string(high));
}

void require_settings(const SaliencySettings& settings) {
  require_range("intensity_weight", settings.intensity_weight, 0.0, 10.0);
  require_range("colour_weight", settings.colour_weight, 0.0, 10.0);
  if (settings.intensity_weight + settings.colour_weight <= 0.0)
    throw std::invalid_argument("intensity_weight and colour_weight are both 0");
  require_range("distinctness_min", settings.distinctness_min, 0.0, 1.0);
  require_range("intensity_noise_floor", settings.intensity_noise_floor, 0.0, 255.0);
  require_range("colour_noise_floor", settings.colour_noise_floor, 0.0, 255.0);
}

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

constexpr int smallest_width_px = 160, smallest_height_px = 120;
constexpr int largest_width_px = 2560, largest_height_px = 1920;

void require_size(int width_px, int height_px) {
  if (width_px < smallest_width_px || height_px < smallest_height_px ||
      width_px > largest_width_px || height_px > largest_height_px)
    throw std::invalid_argument("frame size " + size_text(width_px, height_px) +
                                " is not from 160x120 to 2560x1920");
}

}  // namespace

struct Saliency::State {
  State(const SaliencySettings& settings, int width, int height)
      : width_px(width),
        height_px(height),
        mode(settings.profile == SaliencyProfile::report ? CentreSurround::sum
                                                         : CentreSurround::difference),
        intensity_floor(static_cast<std::int32_t>(
            std::lround(settings.intensity_noise_floor * samples_per_grey_level))),
        colour_floor(static_cast<std::int32_t>(
            std::lround(settings.colour_noise_floor * samples_per_colour_level))),
        low_levels(low_levels_for(settings, width, height)),
        intensity(width, height),
        red_green(width, height),
        blue_yellow(width, height),
        feature_maps(settings.profile, width, height),
        map_width(length_at_level(width, map_level)),
        map_height(length_at_level(height, map_level)),
        sum(settings.intensity_weight, settings.colour_weight, map_width, map_height),
        map(static_cast<std::size_t>(map_width) * static_cast<std::size_t>(map_height)),
        distinctness(map_width, map_height),
        intensity_conspicuity(map_width, map_height),
        colour_conspicuity(map_width, map_height) {}

  void require_frame(const ImageView& frame) const;
  SaliencyPlane saliency_of(const ImageView& frame);

  int width_px;
  int height_px;
  CentreSurround mode;  // of the opponent colours; intensity is always the difference
  std::int32_t intensity_floor;
  std::int32_t colour_floor;
  LowLevels low_levels;
  Pyramid intensity;
  Pyramid red_green;
  Pyramid blue_yellow;
  FeatureMaps feature_maps;
  int map_width;
  int map_height;
  SaliencySum sum;
  std::vector<std::uint16_t> map;
  Distinctness distinctness;
  OwnedPlane<std::int32_t> intensity_conspicuity;
  OwnedPlane<std::int32_t> colour_conspicuity;
};

void Saliency::State::require_frame(const ImageView& frame) const {
  if (frame.empty()) throw std::invalid_argument("the frame has no pixels");
  if (frame.width_px != width_px || frame.height_px != height_px)
    throw std::invalid_argument("frame size " + size_text(frame.width_px, frame.height_px) +
                                " is not the " + size_text(width_px, height_px) +
                                " given at construction");
  if (frame.row_stride < frame.width_px * bytes_per_pixel(frame.format))
    throw std::invalid_argument("row stride " + std::to_string(frame.row_stride) +
                                " is shorter than a row of " + std::to_string(frame.width_px) +
                                " pixels");
  if (frame.format == PixelFormat::yuyv && frame.width_px % 2 != 0)
    throw std::invalid_argument("a YUYV frame of odd width " + std::to_string(frame.width_px));
}

SaliencyPlane Saliency::State::saliency_of(const ImageView& frame) {
  const LevelTwo level2{intensity.level(2), red_green.level(2), blue_yellow.level(2)};
  std::visit([&](auto& low) { low.read(frame, level2); }, low_levels);
  for (Pyramid* pyramid : {&intensity, &red_green, &blue_yellow}) pyramid->build();

  const ConspicuityMap of_intensity = intensity_conspicuity.view();
  const ConspicuityMap of_colour = colour_conspicuity.view();
  fill(of_intensity, 0);
  fill(of_colour, 0);
  feature_maps.add(intensity, CentreSurround::difference, intensity_floor, of_intensity);
  feature_maps.add(red_green, mode, colour_floor, of_colour);
  feature_maps.add(blue_yellow, mode, colour_floor, of_colour);
  return sum.add(of_intensity, of_colour);
}

Saliency::Saliency(const SaliencySettings& settings, int width_px, int height_px) {
  require_settings(settings);
  require_size(width_px, height_px);
  state_ = std::make_unique<State>(settings, width_px, height_px);
}

Saliency::~Saliency() = default;
Saliency::Saliency(Saliency&&) noexcept = default;
Saliency& Saliency::operator=(Saliency&&) noexcept = default;

SaliencyResult Saliency::look(const ImageView& frame) {
  State& state = *state_;
  state.require_frame(frame);
  const SaliencyPlane plane = state.saliency_of(frame);
  constexpr int shift = conspicuity_fraction_bits - map_fraction_bits;
  auto to = state.map.begin();
  for (int y = 0; y < plane.height; ++y)
    to = std::transform(plane.row(y), plane.row(y) + plane.width, to, [](std::int32_t s) {
      return static_cast<std::uint16_t>(rounding_shift<shift>(s));
    });

  const Winner winner = find_winner(plane);
  constexpr double full_saliency = double{map_maximum} * (1 << conspicuity_fraction_bits);
  SaliencyResult result;
  result.map = {state.map, state.map_width, state.map_height};
  result.peak_px = winner.pixel;
  result.saliency = static_cast<float>(plane.row(winner.y)[winner.x] / full_saliency);
  const PlanesAtMapLevel planes{state.intensity.level(map_level), state.red_green.level(map_level),
                                state.blue_yellow.level(map_level)};
  result.distinctness = static_cast<float>(state.distinctness.of(plane, winner, planes));
  return result;
}

}  // namespace gazed
