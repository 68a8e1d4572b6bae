#include "agent/saliency/saliency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/distinctness.hpp"
#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/fixed.hpp"
#include "agent/saliency/flicker.hpp"
#include "agent/saliency/hysteresis.hpp"
#include "agent/saliency/inhibition.hpp"
#include "agent/saliency/low_levels.hpp"
#include "agent/saliency/middle.hpp"
#include "agent/saliency/overexposed.hpp"
#include "agent/saliency/surroundedness.hpp"
#include "agent/saliency/texture.hpp"
#include "agent/saliency/validation.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

namespace {

using LowLevels = std::variant<PixelOpponents, LateOpponents>;

LowLevels low_levels_for(const SaliencySettings& settings, int width_px, int height_px) {
  if (settings.profile == SaliencyProfile::report)
    return PixelOpponents(width_px, height_px, settings.clamp_negative);
  return LateOpponents(width_px, height_px);
}

// Relative to the intensity's weight. NSS on OSIE: 0.02 more than without texture, 0.01 more than
// at 1.
constexpr double texture_share = 0.5;

// Of 103 parts of photographs without their object in which nothing was surrounded enough, 9 have a
// centre-surround winner so distinct so near to the border, 23 one above 0.3. A lone disc that is
// cut has 0.47 to 0.49: nothing encloses it.
constexpr double border_share = 0.125;  // of the width
constexpr double cut_distinctness_min = 0.45;

constexpr int q16_bits = 16;
constexpr std::int32_t one_q16 = 1 << q16_bits;

std::int32_t to_q16(double value) {
  return static_cast<std::int32_t>(std::lround(value * one_q16));
}

std::int32_t samples_of_grey_levels(double grey_levels) {
  return static_cast<std::int32_t>(std::lround(grey_levels * samples_per_grey_level));
}

std::optional<Flicker> flicker_for(const SaliencySettings& settings, int width_px, int height_px) {
  const double weight = settings.flicker_weight;
  if (weight <= 0.0) return std::nullopt;
  const double share = weight / (settings.intensity_weight + settings.colour_weight + weight);
  return Flicker(share, samples_of_grey_levels(settings.flicker_noise_floor), width_px, height_px);
}

// The report's profile does not weaken overexposed places.
std::optional<Overexposed> overexposed_for(const SaliencySettings& settings, int map_width,
                                           int map_height) {
  const double weight = settings.overexposed_weight;
  if (settings.profile == SaliencyProfile::report || weight >= 1.0) return std::nullopt;
  return Overexposed(weight, map_width, map_height);
}

std::optional<Surroundedness> surroundedness_for(const SaliencySettings& settings, int width_px,
                                                 int height_px) {
  if (settings.profile != SaliencyProfile::surround) return std::nullopt;
  return Surroundedness(width_px, height_px);
}

std::optional<Texture> texture_for(const SaliencySettings& settings, int width_px, int height_px) {
  if (settings.profile != SaliencyProfile::surround) return std::nullopt;
  return std::make_optional<Texture>(width_px, height_px);
}

}  // namespace

/// For profile surround.
struct Judgement {
  double distinctness = 0.0;
  double full_saliency = 1.0;  // the saliency at the map's full scale
};

struct Saliency::State {
  State(const SaliencySettings& settings_in, int width, int height)
      : settings(settings_in),
        width_px(width),
        height_px(height),
        mode(settings.profile == SaliencyProfile::report ? CentreSurround::sum
                                                         : CentreSurround::difference),
        intensity_floor(samples_of_grey_levels(settings.intensity_noise_floor)),
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
        surroundedness(surroundedness_for(settings, width, height)),
        texture(texture_for(settings, width, height)),
        flicker(flicker_for(settings, width, height)),
        overexposed(overexposed_for(settings, map_width, map_height)),
        hysteresis(to_q16(settings.hysteresis)),
        map(static_cast<std::size_t>(map_width) * static_cast<std::size_t>(map_height)),
        distinctness(map_width, map_height),
        intensity_conspicuity(map_width, map_height),
        colour_conspicuity(map_width, map_height) {}

  PlaneView<std::int32_t> saliency_of(const base::ImageView& frame);
  void add_colour();
  PlaneView<std::int32_t> centre_surround();
  PlaneView<std::int32_t> surrounded();
  [[nodiscard]] PlanesAtMapLevel planes_at_map_level() const;
  [[nodiscard]] FramePlanes frame_planes() const;
  void leave_out(const PlaneView<std::int32_t>& plane, const FrameContext& context);
  [[nodiscard]] Judgement judge(PlaneView<std::int32_t>& plane, const FrameContext& context);
  [[nodiscard]] bool near_border(const geometry::Pixel& pixel) const;
  [[nodiscard]] Winner winner_of(const SaliencyPlane& plane, const FrameContext& context) const;

  SaliencySettings settings;
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
  std::optional<Surroundedness> surroundedness;  // only in its profile, instead of feature maps
  std::optional<Texture> texture;                // likewise
  std::optional<Flicker> flicker;                // none if its weight is 0
  std::optional<Overexposed> overexposed;        // none if its weight is 1
  std::int32_t hysteresis;                       // Q16
  std::vector<std::uint16_t> map;
  Distinctness distinctness;
  OwnedPlane<std::int32_t> intensity_conspicuity;
  OwnedPlane<std::int32_t> colour_conspicuity;
};

PlaneView<std::int32_t> Saliency::State::saliency_of(const base::ImageView& frame) {
  const LevelTwo level2{intensity.level(2), red_green.level(2), blue_yellow.level(2)};
  std::visit([&](auto& low) { low.read(frame, level2); }, low_levels);
  for (Pyramid* pyramid : {&intensity, &red_green, &blue_yellow}) pyramid->build();

  return surroundedness ? surrounded() : centre_surround();
}

PlaneView<std::int32_t> Saliency::State::centre_surround() {
  fill(intensity_conspicuity.view(), 0);
  fill(colour_conspicuity.view(), 0);
  if (settings.intensity_weight > 0.0)
    feature_maps.add(intensity, CentreSurround::difference, intensity_floor,
                     intensity_conspicuity.view());
  if (settings.colour_weight > 0.0) add_colour();
  return sum.add(intensity_conspicuity.view(), colour_conspicuity.view());
}

PlaneView<std::int32_t> Saliency::State::surrounded() {
  const double per_opponent =
      settings.colour_weight / std::max(settings.red_green_weight, settings.blue_yellow_weight);
  const std::array<double, 3> weights{settings.intensity_weight,
                                      settings.red_green_weight * per_opponent,
                                      settings.blue_yellow_weight * per_opponent};
  const double largest = std::max({weights[0], weights[1], weights[2]});
  const std::array planes{&intensity, &red_green, &blue_yellow};
  surroundedness->begin();
  for (std::size_t i = 0; i < planes.size(); ++i)
    surroundedness->add(planes[i]->level(surroundedness_level),
                        i == 0 ? intensity_floor : colour_floor, weights[i] / largest);
  surroundedness->add(texture->of(intensity), intensity_floor,
                      texture_share * weights[0] / largest);
  return surroundedness->saliency();
}

// N scales the sum of the two opponents, so only the ratio of their weights matters: the one with
// the smaller weight is scaled down by that ratio and added first.
void Saliency::State::add_colour() {
  const Pyramid *less = &red_green, *more = &blue_yellow;
  double less_weight = settings.red_green_weight, more_weight = settings.blue_yellow_weight;
  if (less_weight > more_weight) {
    std::swap(less, more);
    std::swap(less_weight, more_weight);
  }
  const std::int32_t share = to_q16(less_weight / more_weight);
  const ConspicuityMap colour = colour_conspicuity.view();
  if (share > 0) feature_maps.add(*less, mode, colour_floor, colour);
  if (share < one_q16) {
    std::for_each(colour.data, colour.row(colour.height), [share](std::int32_t& sample) {
      sample = static_cast<std::int32_t>((std::int64_t{sample} * share) >> q16_bits);
    });
  }
  feature_maps.add(*more, mode, colour_floor, colour);
}

PlanesAtMapLevel Saliency::State::planes_at_map_level() const {
  return {intensity.level(map_level), red_green.level(map_level), blue_yellow.level(map_level)};
}

FramePlanes Saliency::State::frame_planes() const {
  FramePlanes out;
  const PlanesAtMapLevel planes = planes_at_map_level();
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {planes[i].data, planes[i].width, planes[i].height, planes[i].stride,
              static_cast<float>(plane_samples_per_grey_level[i])};
  return out;
}

bool Saliency::State::near_border(const geometry::Pixel& pixel) const {
  const geometry::CameraModel frame{.width_px = width_px, .height_px = height_px};
  return !frame.contains(pixel, width_px * border_share);
}

// Removes what is not an object.
void Saliency::State::leave_out(const PlaneView<std::int32_t>& plane, const FrameContext& context) {
  inhibit(plane, context.without_own_parts);
  if (overexposed) overexposed->weaken(plane, intensity.level(map_level));
}

// For profile surround, before inhibition. Objects cut by the frame's border are not surrounded, so
// if nothing whole stands out clearly, the centre-surround maps are used, but only where
// surroundedness cannot see.
Judgement Saliency::State::judge(PlaneView<std::int32_t>& plane, const FrameContext& context) {
  const PlanesAtMapLevel planes = planes_at_map_level();
  const Attention attention = surroundedness->attention();
  const Judgement whole{distinctness.of(plane, attention, planes), attention.peak_share()};
  if (whole.distinctness >= settings.distinctness_min / 3.0) return whole;
  const PlaneView<std::int32_t> other = centre_surround();
  leave_out(other, context);
  const Winner winner = find_winner(other);
  if (!near_border(winner.pixel)) return whole;
  const Judgement cut{distinctness.of(other, winner, planes), 1.0};
  if (cut.distinctness < cut_distinctness_min) return whole;
  plane = other;
  return cut;
}

Winner Saliency::State::winner_of(const SaliencyPlane& plane, const FrameContext& context) const {
  if (hysteresis == 0 || !context.previous_winner_px) return find_winner(plane);
  return find_winner(plane, *context.previous_winner_px, hysteresis);
}

Saliency::Saliency(const SaliencySettings& settings, int width_px, int height_px) {
  require_settings(settings);
  require_size(width_px, height_px);
  state_ = std::make_unique<State>(settings, width_px, height_px);
}

Saliency::~Saliency() = default;
Saliency::Saliency(Saliency&&) noexcept = default;
Saliency& Saliency::operator=(Saliency&&) noexcept = default;

SaliencyResult Saliency::examine(const base::ImageView& frame, const FrameContext& context) {
  State& state = *state_;
  require_frame(frame, state.width_px, state.height_px);
  require_context(context, state.map.size());
  PlaneView<std::int32_t> plane = state.saliency_of(frame);
  if (state.flicker)
    state.flicker->add_to(plane, state.intensity.level(flicker_level), context.head_is_still);
  state.leave_out(plane, context);
  const Judgement judged = state.surroundedness ? state.judge(plane, context) : Judgement{};
  inhibit(plane, context.kept);
  constexpr int shift = conspicuity_fraction_bits - map_fraction_bits;
  auto to = state.map.begin();
  for (int y = 0; y < plane.height; ++y)
    to = std::transform(plane.row(y), plane.row(y) + plane.width, to, [](std::int32_t s) {
      return static_cast<std::uint16_t>(rounding_shift<shift>(s));
    });

  const Winner winner = state.winner_of(plane, context);
  constexpr double full_saliency = double{map_maximum} * (1 << conspicuity_fraction_bits);
  SaliencyResult result;
  result.map = {state.map, state.map_width, state.map_height};
  result.planes = state.frame_planes();
  result.peak_px = state.surroundedness
                       ? middle_of_object(plane, winner, state.intensity_conspicuity.view(),
                                          state.colour_conspicuity.view())
                       : winner.pixel;
  result.saliency =
      static_cast<float>(judged.full_saliency * plane.row(winner.y)[winner.x] / full_saliency);
  result.distinctness = static_cast<float>(
      state.surroundedness ? judged.distinctness
                           : state.distinctness.of(plane, winner, state.planes_at_map_level()));
  return result;
}

}  // namespace gazed::saliency
