// Settings of the saliency stage.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "agent/base/range.hpp"

namespace gazed::saliency {

enum class SaliencyProfile : std::uint8_t {
  report,    // the 2011 report, sums of opponents as printed
  robust,    // differences, border ramp, reduction before N, late colour
  surround,  // planes of robust, plus texture, cut at many thresholds: what is enclosed
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> profile_names{"report", "robust", "surround"};
/// None for a name that is not one of profile_names.
[[nodiscard]] constexpr std::optional<SaliencyProfile> profile_of(std::string_view name) {
  for (std::size_t i = 0; i < profile_names.size(); ++i)
    if (profile_names[i] == name) return static_cast<SaliencyProfile>(i);
  return std::nullopt;
}

/// All profiles share the same defaults.
struct SaliencySettings {
  SaliencyProfile profile = SaliencyProfile::surround;
  bool clamp_negative = false;    // report profile: R, G, B, Y below 0 become 0
  double intensity_weight = 1.0;  // of the conspicuity map; only the ratio of the two counts
  double colour_weight = 1.0;
  double red_green_weight = 1.0;  // of the colour map's parts, likewise
  double blue_yellow_weight = 1.0;
  double flicker_weight = 0.0;  // relative to intensity and colour; 0: off

  /// Below it there is no salient object. Share of pictures at or above 0.3, surround / robust /
  /// report profile (tests/unit/agent/saliency: distinctness_test, photographs_test; the others,
  /// surround on the half that nothing was fitted to: tests/benchmarks/quality none):
  ///   86 photographs of one object (ECSSD)                   0.91 / 0.95 / 0.83
  ///   268 of them, and 268 parts that cut the object         0.95, 0.81
  ///   5 photographs with red objects                         1 / 1 / 1, lowest 0.76 / 0.37 / 0.37
  ///   drawn discs of 16 to 120 px on a shaded wall           0.98 / 1 / 0.95
  ///   78 frames of a canteen                                 0.41 / 0.85 /
  ///   20 frames of a desk, which surround was fitted to      0.40 / 0.75 /
  ///   154 parts of photographs without their object          0.49 / 0.74 /
  ///   5 pictures of turf from a NAO's bottom camera          0 / 0 / 0, highest 0.29 / 0.26 / 0.17
  ///   54 empty walls, shaded by 15 to 70 %, and noise        0 / 0 / 0, highest 0.11 / 0.03 / 0.04
  ///   grey with noise of up to 3 grey levels                 0 / 0 / 0
  /// Clutter cannot always be told from a single object: things on a desk do stand out.
  double distinctness_min = 0.3;

  /// A centre-surround map whose maximum is below this is ignored; grey levels. White noise of
  /// standard deviation 2, equal in r, g and b, leaves less than 0.5 in robust maps, noise of 4
  /// less than 1. In the report profile, whose finest maps are not reduced before N, noise of 2
  /// leaves about 1, but such a map has many equal maxima, so N and the distinctness suppress it.
  /// NSS on OSIE is the same to four digits without the two floors and with twice their values.
  double intensity_noise_floor = 1.0;

  /// The same for opponent maps; full scale, a pure colour, counts as 255. The same noise,
  /// independent in r, g and b, leaves less than 0.5 in robust maps, noise of 4 less than 1. In the
  /// report profile it is divided by the intensity: noise of 2 leaves less than 2 at grey level
  /// 128, less than 8 where r + g + b is barely enough for a hue.
  double colour_noise_floor = 2.5;

  /// Smaller changes between two frames of a still head, in grey levels at level 3, count as noise:
  /// white noise of standard deviation 4 leaves less than 1 (flicker_test.cpp).
  double flicker_noise_floor = 2.0;

  /// The previous winner, followed through turns of the head, is only replaced by a place that is
  /// more salient by this share; 0: by any. After the step rule's move the same place wins in 0.92
  /// of 598 pictures with 0.5, and in 0.78 with 0 (the border then cuts other things).
  double hysteresis = 0.5;

  /// Share of S that is kept where a frame is overexposed, in profiles robust and surround: 1 all,
  /// 0 none.
  double overexposed_weight = 0.5;

  /// The robot's own shoulders and chest do not count as objects where the head's angles put them
  /// in view, nor do its feet while it stands. Not in the report profile. Used by the cycle.
  bool exclude_body = true;
  bool exclude_feet = false;

  /// After each fixation the place is inhibited, so that the gaze moves on to the next object. Off
  /// as in the report, where both views must choose the same object (they do either way, since a
  /// place is added only after both). Used by the cycle, not here.
  bool scan = false;
  double inhibition_radius_rad = 0.1;  // of an object of 0.1 m at 1 m, including its surroundings
  double inhibition_decay_s = 10.0;    // after this time 37 % of the inhibition is left
};

inline constexpr base::Range frame_width_range_px{160, 2560};
inline constexpr base::Range frame_height_range_px{120, 1920};

inline constexpr base::Range weight_range{0, 10};
inline constexpr base::Range distinctness_range{0, 1};
inline constexpr base::Range noise_floor_range{0, 255};  // grey levels
inline constexpr base::Range overexposed_weight_range{0, 1};
inline constexpr base::Range hysteresis_range{0, 10};
inline constexpr base::Range inhibition_radius_range_rad{0.01, 1};
inline constexpr base::Range inhibition_decay_range_s{0.1, 3600};

}  // namespace gazed::saliency
