// What is remembered of an object: its patch in view 1, as samples to compare.
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

/// A place of view 1, normalised, and what is seen there.
struct PatchSample {
  Eigen::Vector2d normalised = Eigen::Vector2d::Zero();
  float value = 0.0F;
  float share_behind = 0.0F;  // of what is seen, background
  std::uint16_t behind = 0;   // the point of the outline next to which that is seen by itself
  float relief = 0.0F;        // how far a ball would stand out there, as Relief has it
};

/// The patch at one reduction. Places with gradient come first, then flat ones.
struct PatchLevel {
  static constexpr std::size_t samples_max = 4096;

  std::vector<PatchSample> samples;
  std::vector<geometry::Pixel> pixels;  // of view 1, one for each sample
  std::vector<PatchSample> behind;      // background: Rim::places_behind for each of its points
  std::size_t edges = 0;                // how many of the samples have gradient
  int edge_stride = 1;                  // every how many-th place with gradient was taken
};

/// A box of a plane's samples, to choose from.
struct PatchPlaces {
  int column = 0, row = 0, width = 0, height = 0;  // where it begins, how large it is
  std::vector<float> slope2;  // squared, per sample spacing; negative where the patch is not
};

/// The patch around a reference point. What it covers is the object and margin_px around it, inside
/// the frame and the square of half_size_px.
struct Patch {
  geometry::Pixel reference_px = geometry::Pixel::Zero();
  base::PixelFormat format = base::PixelFormat::rgb24;
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();  // of the colour space, unit length
  double half_size_px = 0.0;
  double margin_px = 0.0;
  Eigen::Vector3d contrast = Eigen::Vector3d::Zero();  // colour_contrast in view 1
  PlanePyramid planes;  // view 1 around it; its level 0 is in use while it is sampled only
  std::array<PatchLevel, PlanePyramid::max_levels> levels;
  Rim rim;
  Relief relief;
  PatchPlaces places;  // scratch

  /// Memory for the largest patch.
  void reserve();
};

/// Fills the rest of a patch that has its reference point, half size and margin. False when it has
/// no gradient at all.
[[nodiscard]] bool sample_patch(const base::ImageView& image, const geometry::CameraModel& camera,
                                const ObjectMask& object, Patch& patch);

/// Standard deviations, px, with which a patch could be found again.
struct PredictedSigma {
  double across_px = 0.0;  // in the direction in which it is known best
  double along_px = 0.0;   // in the other
};

/// With white noise of `noise_levels` grey levels in the frame, which has slopes too: their share
/// is taken off. Gain and bias count as unknown: a ramp has gradient and yet no place. Infinite
/// without structure.
[[nodiscard]] PredictedSigma predicted_sigma(const Patch& patch, double noise_levels);

/// The coarsest level that has not lost the patch's contrast.
[[nodiscard]] int coarsest_useful_level(const Patch& patch);

/// d colour / d patch value by least squares: how each channel of `image` changes with the patch's
/// samples when each is seen at its entry of `pixels`; those outside the frame (or NaN) are left
/// out. Zero when nothing is left.
[[nodiscard]] Eigen::Vector3d colour_contrast(const base::ImageView& image,
                                              std::span<const PatchSample> samples,
                                              std::span<const geometry::Pixel> pixels);

}  // namespace gazed::tracking
