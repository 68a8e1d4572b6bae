// What is remembered of an object: its patch in view 1, as samples to compare with later views.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"
#include "agent/tracking/plane.hpp"
#include "agent/tracking/relief.hpp"
#include "agent/tracking/rim.hpp"

namespace gazed::tracking {

inline constexpr double patch_half_size_min_px = 8.0;
inline constexpr double patch_half_size_max_px = 160.0;

/// A place in view 1 (normalised coordinates) and its value there.
struct PatchSample {
  Eigen::Vector2d normalised = Eigen::Vector2d::Zero();
  float value = 0.0F;
  float share_behind = 0.0F;  // share of the background in the value, 0 to 1
  std::uint16_t behind = 0;   // the outline point next to which that background is seen alone
  float relief = 0.0F;        // how far a ball would stand out there, as in Relief
};

/// The patch at one reduction. Samples with gradient come first, then flat ones.
struct PatchLevel {
  static constexpr std::size_t samples_max = 4096;

  std::vector<PatchSample> samples;
  std::vector<geometry::Pixel> pixels;  // in view 1, one per sample
  std::vector<PatchSample> behind;  // background samples: Rim::places_behind for each outline point
  std::size_t edges = 0;            // how many of the samples have gradient
  int edge_stride = 1;              // one in edge_stride places with gradient was taken
};

/// A box of a plane's samples to choose from.
struct PatchPlaces {
  int column = 0, row = 0, width = 0, height = 0;  // first sample and size
  std::vector<float> slope2;  // squared slope per sample spacing; negative off the patch
};

/// The patch around a reference point. It covers the object and margin_px around it, clipped to the
/// frame and to the square of half_size_px.
struct Patch {
  geometry::Pixel reference_px = geometry::Pixel::Zero();
  base::PixelFormat format = base::PixelFormat::rgb24;
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();  // direction in colour space, unit length
  double half_size_px = 0.0;
  double margin_px = 0.0;
  Eigen::Vector3d contrast = Eigen::Vector3d::Zero();  // colour_contrast() in view 1
  PlanePyramid planes;  // view 1 around it; level 0 is used only while sampling
  std::array<PatchLevel, PlanePyramid::max_levels> levels;
  Rim rim;
  Relief relief;
  PatchPlaces places;  // scratch

  /// Allocates for the largest patch.
  void reserve();
};

/// Fills in a patch that has its reference point, half size and margin. Returns false if it has no
/// gradient at all.
[[nodiscard]] bool sample_patch(const base::ImageView& image, const geometry::CameraModel& camera,
                                const ObjectMask& object, Patch& patch);

/// Standard deviations, px, with which a patch can be expected to be found again.
struct PredictedSigma {
  double across_px = 0.0;  // in the direction that is known best
  double along_px = 0.0;   // perpendicular to it
};

/// For white noise of `noise_levels` grey levels in the frame. The noise's own slopes are
/// subtracted. Gain and bias count as unknown, so a ramp has gradient but no position. Infinite
/// without structure.
[[nodiscard]] PredictedSigma predicted_sigma(const Patch& patch, double noise_levels);

/// The coarsest level that still has the patch's contrast.
[[nodiscard]] int coarsest_useful_level(const Patch& patch);

/// d colour / d patch value by least squares: how each channel of `image` varies with the patch's
/// samples, each seen at its entry of `pixels`. Entries outside the frame or NaN are left out. Zero
/// if none is left.
[[nodiscard]] Eigen::Vector3d colour_contrast(const base::ImageView& image,
                                              std::span<const PatchSample> samples,
                                              std::span<const geometry::Pixel> pixels);

}  // namespace gazed::tracking
