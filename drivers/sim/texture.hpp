// What a surface looks like, and the filtered look-up that a renderer needs.
//
// A surface has coordinates u to the right and v downwards, metres, (0, 0) at its centre. Colours
// are r, g, b in grey levels, 0 to 255.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gazed {

/// A picture at full size and halved again and again, so that a far look-up costs as much as a near
/// one and averages over what one pixel sees (Williams 1983).
class MipMap {
 public:
  static constexpr float sample_scale = 64.0F;  // samples are Q9.6

  /// Rows of 1 or 3 (`channels`) interleaved samples. `wraps`: the picture repeats in both
  /// directions (its sides are then powers of two), else its border goes on for ever.
  MipMap(int width, int height, int channels, bool wraps, std::vector<std::int16_t> samples);

  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }
  /// Trilinear. x and y in samples of level 0, (0, 0) at the picture's top left corner; `footprint`
  /// is the side of what the pixel sees, in samples of level 0. Writes `channels` values.
  void sample(float x, float y, float footprint, float* values) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::int16_t> samples;
  };

  [[nodiscard]] Level half(const Level& level) const;
  template <int channels>
  void sample_channels(float x, float y, float footprint, float* values) const;
  template <int channels>
  void add_bilinear(const Level& level, float x, float y, float weight, float* values) const;

  std::vector<Level> levels_;
  int channels_;
  bool wraps_;
};

/// Reads a binary PGM or PPM file (P5, P6; 8 bit). Throws std::invalid_argument that names the file
/// for anything else.
[[nodiscard]] std::shared_ptr<const MipMap> load_pnm(const std::string& path);

enum class Pattern : std::uint8_t {
  solid,
  checker,  // squares of two colours
  noise,    // value noise: blobs of one size
  natural,  // noise of all sizes with the same energy in every octave: the 1/f amplitude spectrum
            // of photographs (Field 1987)
  leaves,   // opaque discs of all sizes, one on the other: the same spectrum, and with it the
            // edges and corners of photographs, which overlapping things make (dead leaves: Lee,
            // Mumford and Huang 2001)
  image,
};

struct Texture {
  Pattern pattern = Pattern::solid;
  std::array<double, 3> colour{255, 255, 255};
  std::array<double, 3> colour_2{0, 0, 0};  // of the checker's other squares
  double cell_m = 0.05;                     // side of a checker's square
  double tile_m = 0.4;                      // noise, natural and leaves repeat after this length
  double contrast = 20.0;                   // their standard deviation, grey levels
  std::uint32_t seed = 1;                   // of noise, natural and leaves
  std::array<double, 2> gradient{};  // relative change of brightness from the centre to the right
                                     // and to the bottom border
  double vignette = 0.0;             // relative loss of brightness from the centre to the corners
  std::shared_ptr<const MipMap> image;  // stretched over the surface, in place of the colour
};

/// Whether a pattern is a tile that repeats: noise, natural, leaves.
[[nodiscard]] bool is_tiled(Pattern pattern);

/// The tile of such a pattern: mean 0, standard deviation 1 (times `scale`).
[[nodiscard]] std::shared_ptr<const MipMap> make_noise_tile(Pattern pattern, std::uint32_t seed);

/// A texture laid on a surface of a given size, ready for look-ups.
class TextureSampler {
 public:
  TextureSampler(const Texture& texture, double half_width_m, double half_height_m,
                 std::shared_ptr<const MipMap> noise_tile);

  /// The mean colour around (u, v); `footprint_m` is the side of what the pixel sees there.
  [[nodiscard]] std::array<float, 3> sample(float u_m, float v_m, float footprint_m) const;

 private:
  Pattern pattern_;
  std::array<float, 3> colour_{}, colour_2_{};
  std::shared_ptr<const MipMap> map_;
  float per_m_x_ = 0.0F, per_m_y_ = 0.0F;        // pattern units in a metre
  float offset_x_ = 0.0F, offset_y_ = 0.0F;      // pattern units
  float contrast_ = 0.0F;                        // grey levels for one unit of the tile
  float gradient_u_ = 0.0F, gradient_v_ = 0.0F;  // 1/m
  float vignette_u_ = 0.0F, vignette_v_ = 0.0F;  // 1/m^2
  bool shaded_ = false;
};

}  // namespace gazed
