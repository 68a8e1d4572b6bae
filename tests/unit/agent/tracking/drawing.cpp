#include "drawing.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "scene.hpp"

namespace gazed::tracking {

namespace {

constexpr int width = 640, height = 480;
// A colour that stands out differs from every colour around by this.
constexpr double contrast_min = 60.0, pale_contrast_min = 35.0;

double between(base::Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

Colour hue(double turns, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double t = std::abs(6.0 * (turns + shift - std::floor(turns + shift)) - 3.0) - 1.0;
    return value * (1.0 - saturation + saturation * std::clamp(t, 0.0, 1.0));
  };
  return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)};
}

using Colouring = std::function<Colour(double x, double y)>;

Colouring plain(base::Random& random) {
  const Colour colour =
      hue(random.uniform(), between(random, 0.0, 0.15), between(random, 110, 220));
  return [=](double, double) { return colour; };
}

// Cupboards, boards and boxes, one before the other.
Colouring furniture(base::Random& random) {
  struct Board {
    double x, y, width, height;
    Colour colour, edge;
  };
  std::vector<Board> boards;
  for (int i = 0; i < 30; ++i) {
    const Colour colour =
        hue(random.uniform(), between(random, 0.0, 0.7), between(random, 50, 220));
    boards.push_back({between(random, -60, width), between(random, -60, height),
                      between(random, 50, 260), between(random, 40, 200), colour, 0.6 * colour});
  }
  const Colour wall = hue(random.uniform(), 0.1, between(random, 110, 200));
  return [=](double x, double y) {
    Colour seen = wall;
    for (const Board& board : boards) {
      const double u = x - board.x, v = y - board.y;
      if (u < 0 || v < 0 || u > board.width || v > board.height) continue;
      const double rim = std::min({u, v, board.width - u, board.height - v});
      seen = rim < 2.0 ? board.edge : board.colour;
    }
    return seen;
  };
}

Colouring books(base::Random& random) {
  struct Book {
    double end, top;
    Colour colour, label;
  };
  std::vector<Book> row;
  double end = -5.0;
  while (end < width) {
    end += between(random, 9, 45);
    row.push_back({end, between(random, 5, 40),
                   hue(random.uniform(), between(random, 0.1, 0.8), between(random, 40, 220)),
                   hue(random.uniform(), 0.2, between(random, 150, 240))});
  }
  const double shelf = between(random, 130, 220);
  return [=](double x, double y) -> Colour {
    const double v = y - shelf * std::floor(y / shelf);
    if (v > shelf - 9.0) return {120, 85, 50};
    const auto book = std::lower_bound(row.begin(), row.end(), x,
                                       [](const Book& b, double at) { return b.end < at; });
    if (book == row.end() || v < book->top) return {40, 32, 25};
    return v > 0.5 * shelf && v < 0.5 * shelf + 14.0 ? book->label : book->colour;
  };
}

Colouring photo(base::Random& random) {
  const std::uint64_t seed = random.bits();
  const Colour mean = hue(random.uniform(), 0.2, between(random, 100, 160));
  return [=](double x, double y) -> Colour {
    double luma = 0.0;
    for (const double cell : {5.0, 13.0, 37.0, 110.0})
      luma += (value_noise(x, y, cell, seed) - 0.5) * 9.0 * std::sqrt(cell);
    const double warm = 60.0 * (value_noise(x, y, 50.0, seed + 1) - 0.5);
    return mean + Colour(luma + warm, luma, luma - warm);
  };
}

Colouring backdrop_of(Backdrop backdrop, base::Random& random) {
  switch (backdrop) {
    case Backdrop::plain:
      return plain(random);
    case Backdrop::furniture:
      return furniture(random);
    case Backdrop::books:
      return books(random);
    case Backdrop::photo:
      break;
  }
  return photo(random);
}

// Where the object is, in units of its half size; its colour there.
struct Figure {
  std::function<bool(double u, double v)> covers;
  Colouring paint;
};

Figure figure_of(Shape shape, const Colour& colour, base::Random& random) {
  const auto disc = [](double u, double v) { return std::hypot(u, v) <= 1.0; };
  const double aspect = between(random, 0.5, 1.0), turn = between(random, 0, std::numbers::pi);
  const auto turned = [=](double u, double v) {
    return Eigen::Vector2d(std::cos(turn) * u + std::sin(turn) * v,
                           (std::cos(turn) * v - std::sin(turn) * u) / aspect);
  };
  const auto rectangle = [=](double u, double v) {
    return turned(u, v).lpNorm<Eigen::Infinity>() <= 0.75;
  };
  const bool light = random.uniform() < 0.5;
  const Colour ink = light ? Colour(0.4 * colour + Colour(140, 140, 140)) : Colour(0.45 * colour);
  const auto inked = [=](bool mark) { return mark ? ink : colour; };
  switch (shape) {
    case Shape::disc:
    case Shape::pale:
      return {disc, [=](double, double) { return colour; }};
    case Shape::rectangle:
      return {rectangle, [=](double, double) { return colour; }};
    case Shape::ball: {
      const Eigen::Vector3d lamp =
          Eigen::Vector3d(between(random, -0.7, 0.7), -0.8, between(random, 0.4, 1.0)).normalized();
      return {disc, [=](double u, double v) -> Colour {
                const double w = std::sqrt(std::max(0.0, 1.0 - u * u - v * v));
                return (0.45 + 0.65 * std::max(0.0, lamp.dot(Eigen::Vector3d(u, v, w)))) * colour;
              }};
    }
    case Shape::ring_on_disc:
      return {disc,
              [=](double u, double v) { return inked(std::abs(std::hypot(u, v) - 0.55) < 0.1); }};
    case Shape::cross_on_disc:
      return {disc, [=](double u, double v) {
                const Eigen::Vector2d at(std::abs(u), std::abs(v));
                return inked(at.minCoeff() < 0.12 && at.maxCoeff() < 0.6);
              }};
    case Shape::print_on_rectangle:
      break;
  }
  return {rectangle, [=](double u, double v) {
            const Eigen::Vector2d at = turned(u, v);
            const double lines = at.y() * 4.0 - std::floor(at.y() * 4.0);
            return inked(at.lpNorm<Eigen::Infinity>() < 0.55 && lines < 0.45);
          }};
}

}  // namespace

std::string name(Shape shape) {
  constexpr std::array names = {"disc",          "rectangle",          "ball", "ring on disc",
                                "cross on disc", "print on rectangle", "pale"};
  return names[static_cast<std::size_t>(shape)];
}

std::string name(Backdrop backdrop) {
  constexpr std::array names = {"plain", "furniture", "books", "photo"};
  return names[static_cast<std::size_t>(backdrop)];
}

Drawing draw(Shape shape, Backdrop backdrop, double noise_levels, base::Random& random) {
  const Colouring behind = backdrop_of(backdrop, random);
  const double half_size = 12.0 * std::exp(random.uniform() * std::log(75.0 / 12.0));
  const geometry::Pixel centre(between(random, 120, width - 120),
                               between(random, 110, height - 110));
  const bool pale = shape == Shape::pale;
  Colour colour;
  for (int attempt = 0;; ++attempt) {
    colour = pale ? hue(random.uniform(), between(random, 0.05, 0.25), between(random, 150, 235))
                  : hue(random.uniform(), between(random, 0.6, 1.0), between(random, 120, 230));
    double nearest = 1e9;
    for (double a = 0.0; a < 2.0 * std::numbers::pi; a += 0.1) {
      for (const double radius : {1.03, 1.15, 1.3}) {
        const geometry::Pixel at =
            centre + radius * half_size * geometry::Pixel(std::cos(a), std::sin(a));
        nearest = std::min(nearest, (behind(at.x(), at.y()) - colour).norm());
      }
    }
    if (nearest > (pale ? pale_contrast_min : contrast_min) || attempt == 300) break;
  }
  const Figure figure = figure_of(shape, colour, random);
  const Colour specks = Colour::Constant(noise_levels / NormalRow::one);
  Drawing drawing{base::Image(width, height, base::PixelFormat::rgb24),
                  std::vector<bool>(static_cast<std::size_t>(width * height)), centre};
  const double bearing = between(random, 0, 2.0 * std::numbers::pi);
  drawing.winner += between(random, 0.0, std::min(16.0, half_size)) *
                    geometry::Pixel(std::cos(bearing), std::sin(bearing));
  for (int y = 0; y < height; ++y) {
    NormalRow normals(random);
    for (int x = 0; x < width; ++x) {
      Colour sum = Colour::Zero();
      int covered = 0;
      const bool near =
          (geometry::Pixel(x, y) - centre).lpNorm<Eigen::Infinity>() < half_size + 2.0;
      for (int ray = 0; near && ray < 16; ++ray) {
        const double u = (x - centre.x() + 0.25 * (ray % 4) - 0.375) / half_size;
        const double v = (y - centre.y() + 0.25 * (ray / 4) - 0.375) / half_size;
        if (!figure.covers(u, v)) continue;
        ++covered;
        sum += figure.paint(u, v);
      }
      sum = (sum + (16 - covered) * behind(x, y)) / 16.0;
      drawing.object[static_cast<std::size_t>(y * width + x)] = covered >= 8;
      for (int c = 0; c < 3; ++c) {
        const double value = sum[c] + specks[c] * normals.next();
        drawing.image.row(y)[3 * x + c] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      }
    }
  }
  return drawing;
}

}  // namespace gazed::tracking
