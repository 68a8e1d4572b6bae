// Drawn pictures of one object before a background, with the truth of which pixels are the
// object's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/base/random.hpp"
#include "agent/geometry/camera.hpp"

namespace gazed::tracking {

enum class Shape { disc, rectangle, ball, ring_on_disc, cross_on_disc, print_on_rectangle, pale };
inline constexpr std::array all_shapes = {
    Shape::disc,          Shape::rectangle,          Shape::ball, Shape::ring_on_disc,
    Shape::cross_on_disc, Shape::print_on_rectangle, Shape::pale};

enum class Backdrop { plain, furniture, books, photo };
inline constexpr std::array all_backdrops = {Backdrop::plain, Backdrop::furniture, Backdrop::books,
                                             Backdrop::photo};

std::string name(Shape shape);
std::string name(Backdrop backdrop);

struct Drawing {
  base::Image image;
  std::vector<bool> object;         // by pixel, row by row
  geometry::Pixel winner = {0, 0};  // on the object or next to it, up to 16 px from its centre
};

/// An object of 24 to 150 px, of a colour that the backdrop around it does not have; 640 x 480.
[[nodiscard]] Drawing draw(Shape shape, Backdrop backdrop, double noise_levels,
                           base::Random& random);

/// Pixels that are the object's in truth and in the mask, by those that are in either.
template <class Mask>
double overlap(const Drawing& drawing, const Mask& mask) {
  int both = 0, either = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const bool truth = drawing.object[static_cast<std::size_t>(y * 640 + x)];
      const bool found = mask.distance_px(x, y) == 0.0F;
      both += truth && found;
      either += truth || found;
    }
  }
  return either > 0 ? static_cast<double>(both) / either : 0.0;
}

}  // namespace gazed::tracking
