// What a surface looks like, and the filtered look-up that a renderer needs.
//
// A surface has coordinates u to the right and v downwards, metres, (0, 0) at its centre. Colours
// are r, g, b in grey levels, 0 to 255.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "drivers/sim/course.hpp"
#include "drivers/sim/light.hpp"
#include "drivers/sim/mipmap.hpp"

namespace gazed::sim {

enum class Pattern : std::uint8_t {
  solid,
  checker,  // squares of two colours
  noise,    // value noise: blobs of one size
  natural,  // noise of all sizes with the same energy in every octave: the 1/f amplitude spectrum
            // of photographs (Field 1987)
  leaves,   // opaque discs of all sizes, one on the other: the same spectrum, and with it the
            // edges and corners of photographs, which overlapping things make (dead leaves: Lee,
            // Mumford and Huang 2001)
  collage,  // leaves of all colours
  image,
};

struct Texture {
  Pattern pattern = Pattern::solid;
  std::array<double, 3> colour{255, 255, 255};
  std::array<double, 3> colour_2{0, 0, 0};  // of the checker's other squares
  double cell_m = 0.05;                     // side of a checker's square
  double tile_m = 0.4;                      // noise, natural, leaves, collage repeat after this
  double contrast = 20.0;                   // their standard deviation in each channel
  std::uint32_t seed = 1;                   // of noise, natural, leaves, collage
  std::array<double, 2> gradient{};  // relative change of brightness from the centre to the right
                                     // and to the bottom border
  double vignette = 0.0;             // relative loss of brightness from the centre to the corners
  double light = 1.0;                // factor on its brightness; no key: a box's faces differ
  std::shared_ptr<const MipMap> image;  // stretched over the surface, in place of the colour
};

/// Whether a pattern is a tile that repeats: noise, natural, leaves, collage.
[[nodiscard]] bool is_tiled(Pattern pattern);

/// The tile of such a pattern: mean 0, standard deviation 8. One channel; three for a collage.
[[nodiscard]] std::shared_ptr<const MipMap> make_noise_tile(Pattern pattern, std::uint32_t seed);

/// A place on a surface.
struct SurfacePoint {
  double u_m = 0.0, v_m = 0.0;
};

/// A texture laid on a surface of a given size, ready for look-ups.
class TextureSampler {
 public:
  TextureSampler(const Texture& texture, double half_width_m, double half_height_m,
                 std::shared_ptr<const MipMap> noise_tile);

  static constexpr int longest_run_px = 16;

  /// What a run of pixels sees, the mean colour around each: r, g, b, r, ... until `rgb` is full,
  /// of up to longest_run_px pixels. `first`, `middle` and `last` are where pixels 0, last / 2 and
  /// last meet the surface; `footprint_m` is the side of what each sees there.
  void sample(const SurfacePoint& first, const SurfacePoint& middle, const SurfacePoint& last,
              float footprint_m, std::span<Light> rgb) const;
  /// What one pixel sees.
  [[nodiscard]] std::array<Light, 3> sample(const SurfacePoint& point, float footprint_m) const;

 private:
  /// Two squares' colours, mixed by how much a pixel sees of each.
  void paint_checker(Course x, Course y, float footprint_m, std::span<Light> rgb) const;
  /// The tile's grey, or colours, on the colour, or the picture in its place.
  void paint_map(Course x, Course y, float footprint_m, std::span<Light> rgb) const;
  [[nodiscard]] double light_at(const SurfacePoint& point) const;

  Pattern pattern_;
  std::array<Light, 3> colour_{}, colour_2_{};
  std::shared_ptr<const MipMap> map_;
  double per_m_x_ = 0.0, per_m_y_ = 0.0;        // pattern units in a metre
  double offset_x_ = 0.0, offset_y_ = 0.0;      // pattern units
  std::int64_t contrast_q12_ = 0;               // light for one unit of the tile
  double gradient_u_ = 0.0, gradient_v_ = 0.0;  // 1/m
  double vignette_u_ = 0.0, vignette_v_ = 0.0;  // 1/m^2
  double light_ = 1.0;
  bool shaded_ = false;
};

}  // namespace gazed::sim
