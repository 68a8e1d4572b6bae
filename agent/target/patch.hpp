// What is remembered of an object: its patch in view 1, as samples to compare.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/target/object.hpp"
#include "agent/target/plane.hpp"

namespace gazed {

/// A place of view 1, normalised, and what is seen there.
struct PatchSample {
  Eigen::Vector2d normalised = Eigen::Vector2d::Zero();
  float value = 0.0F;
};

/// The patch at one reduction.
struct PatchLevel {
  std::vector<PatchSample> samples;
  std::vector<Pixel> pixels;  // of view 1, one for each sample
  int edge_samples = 0;       // the first so many have gradient, the others are flat
  int edge_stride = 1;        // every how many-th sample with gradient was taken
};

/// The patch around a reference point.
struct Patch {
  Pixel reference_px = Pixel::Zero();
  PixelFormat format = PixelFormat::rgb24;
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();  // of the colour space, unit length
  double half_size_px = 0.0;                       // of the smallest square that holds it
  double margin_px = 0.0;                          // how far it reaches over the object's outline
  Eigen::Vector3d contrast = Eigen::Vector3d::Zero();  // colour_contrast in view 1
  PlanePyramid planes;                                 // view 1 around it
  std::array<PatchLevel, PlanePyramid::max_levels> levels;
};

/// The colour direction with most gradient energy on the object and across its outline: the leading
/// eigenvector of the gradients' covariance (Di Zenzo, CVGIP 33, 1986). Unit length; zero for a
/// region without any gradient.
[[nodiscard]] Eigen::Vector3f strongest_colour_axis(const ImageView& image,
                                                    const ObjectMask& object, const Pixel& centre,
                                                    double half_size_px, double margin_px);

/// Fills `patch.planes` and `patch.levels` from reference_px, format, axis, half_size_px and
/// margin_px.
void sample_patch(const ImageView& image, const CameraModel& camera, const ObjectMask& object,
                  Patch& patch);

/// d colour / d patch value by least squares: how each channel of `image` changes with the patch's
/// samples when each is seen at its entry of `pixels`; those outside the frame (or NaN) are left
/// out. Zero when nothing is left.
[[nodiscard]] Eigen::Vector3d colour_contrast(const ImageView& image,
                                              std::span<const PatchSample> samples,
                                              std::span<const Pixel> pixels);

}  // namespace gazed
