#include "drivers/sim/render.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "drivers/sim/coverage.hpp"

namespace gazed {

namespace {

constexpr double near_m = 0.005;              // nothing nearer is drawn
constexpr double least_inverse_depth = 1e-4;  // 1/m: nothing farther is drawn
constexpr double same_plane = 1e-6;           // relative difference of depth
constexpr double box_border_px = 2.0;
constexpr int block_px = 16;  // pixels of a run that share one texture footprint

using Rgb = std::array<float, 3>;

PlanePoint meet(const PlacedSurface& surface, double x, double y) {
  const Eigen::Matrix3d& m = surface.plane_from_cam;
  const double inverse_depth = m(2, 0) * x + m(2, 1) * y + m(2, 2);
  const double depth = 1.0 / inverse_depth;
  return {(m(0, 0) * x + m(0, 1) * y + m(0, 2)) * depth,
          (m(1, 0) * x + m(1, 1) * y + m(1, 2)) * depth, inverse_depth};
}

/// d(u, v) / d(column, row), m/px.
Eigen::Matrix2d plane_jacobian(const PlacedSurface& surface, const PlanePoint& point,
                               const Ray& ray) {
  const Eigen::Matrix3d& m = surface.plane_from_cam;
  Eigen::Matrix2d by_normalised;
  by_normalised << m(0, 0) - point.u_m * m(2, 0), m(0, 1) - point.u_m * m(2, 1),
      m(1, 0) - point.v_m * m(2, 0), m(1, 1) - point.v_m * m(2, 1);
  Eigen::Matrix2d by_pixel;
  by_pixel.col(0) = by_normalised * ray.next_column;
  by_pixel.col(1) = by_normalised * ray.next_row;
  return by_pixel / point.inverse_depth;
}

double footprint_m(const Eigen::Matrix2d& jacobian) {
  return std::sqrt(std::max(jacobian.col(0).squaredNorm(), jacobian.col(1).squaredNorm()));
}

/// The share of the pixel between two parallel edges, `below` and `above` away in the unit of the
/// coordinate whose change by pixel is `gradient`.
double band_coverage(double below, double above, const Eigen::RowVector2d& gradient) {
  const double steepness = gradient.norm();
  if (steepness <= 0.0) return below >= 0.0 && above >= 0.0 ? 1.0 : 0.0;
  const Eigen::RowVector2d normal = gradient / steepness;
  return half_plane_coverage(below / steepness, normal.x(), normal.y()) +
         half_plane_coverage(above / steepness, normal.x(), normal.y()) - 1.0;
}

/// The share of a pixel that a surface covers, its border taken as straight inside the pixel.
double coverage(const PlacedSurface& surface, const PlanePoint& point,
                const Eigen::Matrix2d& jacobian) {
  const double u = point.u_m / surface.half_width_m, v = point.v_m / surface.half_height_m;
  const Eigen::RowVector2d du = jacobian.row(0) / surface.half_width_m;
  const Eigen::RowVector2d dv = jacobian.row(1) / surface.half_height_m;
  if (surface.shape == Shape::rectangle)
    return band_coverage(1.0 + u, 1.0 - u, du) * band_coverage(1.0 + v, 1.0 - v, dv);
  const double radius = std::sqrt(u * u + v * v);
  if (radius < 1e-9) return surface.hole > 0.0 ? 0.0 : 1.0;
  const Eigen::RowVector2d d_radius = (u * du + v * dv) / radius;
  const double inner = surface.hole > 0.0 ? radius - surface.hole : 2.0 + radius;
  return std::max(band_coverage(inner, 1.0 - radius, d_radius), 0.0);
}

std::optional<PixelLayer> layer(const PlacedSurface& surface, const Ray& ray) {
  const PlanePoint point = meet(surface, ray.at.x(), ray.at.y());
  if (!(point.inverse_depth > least_inverse_depth)) return std::nullopt;
  const Eigen::Matrix2d jacobian = plane_jacobian(surface, point, ray);
  const double share = coverage(surface, point, jacobian);
  if (!(share > 0.0)) return std::nullopt;
  return PixelLayer{&surface, point, share, footprint_m(jacobian)};
}

Rgb paint(const PlacedSurface& surface, const PlanePoint& point, double footprint) {
  const double u = std::clamp(point.u_m, -surface.half_width_m, surface.half_width_m);
  const double v = std::clamp(point.v_m, -surface.half_height_m, surface.half_height_m);
  return surface.texture.sample(static_cast<float>(u), static_cast<float>(v),
                                static_cast<float>(footprint));
}

/// How a surface lies to a pixel, with a few pixels to spare.
struct Lie {
  bool inside = false;         // the pixel sees nothing of its border
  unsigned beyond = 0;         // the borders that the pixel lies beyond, one bit each
  double footprint_m = 0.0;    // where it is inside
  double inverse_depth = 0.0;  // 0: not in front of the camera
};

Lie lie_of(const PlacedSurface& surface, const Ray& ray) {
  const PlanePoint point = meet(surface, ray.at.x(), ray.at.y());
  if (!(point.inverse_depth > least_inverse_depth)) return {};
  const double footprint = footprint_m(plane_jacobian(surface, point, ray));
  const double border_m = 3.0 * footprint;
  const std::array<double, 4> within_m{
      surface.half_width_m - point.u_m, surface.half_width_m + point.u_m,
      surface.half_height_m - point.v_m, surface.half_height_m + point.v_m};
  Lie lie{surface.shape == Shape::rectangle, 0, footprint, point.inverse_depth};
  for (std::size_t i = 0; i < within_m.size(); ++i) {
    if (within_m[i] < border_m) lie.inside = false;
    if (within_m[i] < -border_m) lie.beyond |= 1U << i;
  }
  return lie;
}

/// What a row of pixels sees between two of them.
struct OnlySurface {
  const PlacedSurface* surface = nullptr;  // nullptr: not a single one, or its border is near
  double footprint_m = 0.0;
};

/// Surfaces are convex and inverse depth is linear along a row: what holds at both ends holds in
/// between.
OnlySurface only_surface(std::span<const PlacedSurface> surfaces,
                         std::span<const std::uint8_t> candidates, const Ray& first,
                         const Ray& last) {
  OnlySurface nearest;
  std::array<double, 2> depths{};
  bool whole = true;
  // Front surfaces mostly come last: in one plane the later is on top.
  for (std::size_t i = candidates.size(); i-- > 0 && whole;) {
    const PlacedSurface& surface = surfaces[candidates[i]];
    const Lie a = lie_of(surface, first), b = lie_of(surface, last);
    const bool seen = a.inverse_depth > 0.0 || b.inverse_depth > 0.0;
    if (!seen || (a.beyond & b.beyond) != 0) continue;
    const auto behind = [&](double share) {
      return nearest.surface != nullptr && a.inverse_depth > 0.0 && b.inverse_depth > 0.0 &&
             a.inverse_depth * share < depths[0] && b.inverse_depth * share < depths[1];
    };
    if (behind(1.0 - same_plane)) continue;
    const bool in_front =
        nearest.surface == nullptr || (a.inverse_depth > depths[0] * (1.0 + same_plane) &&
                                       b.inverse_depth > depths[1] * (1.0 + same_plane));
    whole = a.inside && b.inside && in_front;
    nearest = {&surface, b.footprint_m};
    depths = {a.inverse_depth, b.inverse_depth};
  }
  return whole ? nearest : OnlySurface{};
}

/// All that a pixel sees, from front to back.
Rgb mix(std::span<const PlacedSurface> surfaces, std::span<const std::uint8_t> candidates,
        const Ray& ray, const Rgb& background, std::span<PixelLayer> layers) {
  std::size_t count = 0;
  for (const std::uint8_t index : candidates) {
    const std::optional<PixelLayer> added = layer(surfaces[index], ray);
    if (!added) continue;
    // In front of every earlier one that is not clearly nearer: in one plane the later is on top.
    std::size_t place = count++;
    const double nearness = added->point.inverse_depth * (1.0 + same_plane);
    for (; place > 0 && layers[place - 1].point.inverse_depth <= nearness; --place)
      layers[place] = layers[place - 1];
    layers[place] = *added;
  }
  Rgb sum{};
  double left = 1.0;
  const auto add = [&](const Rgb& colour, double share) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<float>(share) * colour[c];
    left -= share;
  };
  for (std::size_t i = 0; i < count && left > 0.0; ++i)
    add(paint(*layers[i].surface, layers[i].point, layers[i].footprint_m),
        std::min(layers[i].coverage, left));
  if (left > 0.0) add(background, left);
  return sum;
}

/// Takes what is seen of a straight edge, from a to b in the camera's frame, into the box.
void add_edge(PlacedSurface& surface, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const auto add = [&surface](const Eigen::Vector3d& point) {
    const Eigen::Array2d seen_at = point.head<2>().array() / point.z();
    surface.box_min = surface.box_min.min(seen_at);
    surface.box_max = surface.box_max.max(seen_at);
  };
  if (a.z() >= near_m) add(a);
  if ((a.z() >= near_m) != (b.z() >= near_m)) add(a + (near_m - a.z()) / (b.z() - a.z()) * (b - a));
}

void place(PlacedSurface& surface, const Pose& cam_from_torso) {
  const Eigen::Vector3d right = cam_from_torso.rotation * surface.right;
  const Eigen::Vector3d down = cam_from_torso.rotation * surface.down;
  const Eigen::Vector3d centre = cam_from_torso * surface.centre_m;
  surface.box_min.setConstant(std::numeric_limits<double>::infinity());
  surface.box_max.setConstant(-std::numeric_limits<double>::infinity());
  Eigen::Matrix3d cam_from_plane;
  cam_from_plane << right, down, centre;
  // The determinant is the camera's distance from the plane.
  if (std::abs(cam_from_plane.determinant()) < 1e-6) return;
  surface.plane_from_cam = cam_from_plane.inverse();
  const Eigen::Vector3d u = surface.half_width_m * right, v = surface.half_height_m * down;
  const std::array<Eigen::Vector3d, 4> corners{centre - u - v, centre + u - v, centre + u + v,
                                               centre - u + v};
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_edge(surface, corners[i], corners[(i + 1) % corners.size()]);
}

}  // namespace

Renderer::Renderer(const CameraModel& camera) : camera_(camera) {
  rays_.reserve(static_cast<std::size_t>(camera.width_px) *
                static_cast<std::size_t>(camera.height_px));
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) {
      const std::optional<Eigen::Vector2d> n = normalise(camera, Pixel(x, y));
      if (!n)
        throw std::invalid_argument("robot.distortion: no ray through pixel (" + std::to_string(x) +
                                    ", " + std::to_string(y) +
                                    ") found; allowed: a distortion that can be undone");
      rays_.emplace_back(n->cast<float>());
    }
}

void Renderer::set_world(const World& world) {
  if (world.surfaces.size() > most_surfaces)
    throw std::invalid_argument("scene: " + std::to_string(world.surfaces.size()) +
                                " surfaces found; allowed: up to " + std::to_string(most_surfaces));
  const auto tile = [this](const Texture& texture) -> std::shared_ptr<const MipMap> {
    if (!is_tiled(texture.pattern)) return nullptr;
    const std::pair key(texture.pattern, texture.seed);
    for (const auto& [made, map] : tiles_)
      if (made == key) return map;
    tiles_.emplace_back(key, make_noise_tile(texture.pattern, texture.seed));
    return tiles_.back().second;
  };
  surfaces_.clear();
  for (const Surface& s : world.surfaces) {
    PlacedSurface placed{
        s.shape,
        s.half_width_m,
        s.half_height_m,
        s.hole,
        s.right,
        s.down,
        s.centre_m,
        TextureSampler(s.texture, s.half_width_m, s.half_height_m, tile(s.texture))};
    surfaces_.push_back(std::move(placed));
  }
  layers_.resize(surfaces_.size());
  for (std::size_t c = 0; c < 3; ++c) background_[c] = static_cast<float>(world.background[c]);
}

void Renderer::set_pose(const Pose& cam_from_torso) {
  for (PlacedSurface& surface : surfaces_) place(surface, cam_from_torso);
}

std::pair<int, int> Renderer::columns(const PlacedSurface& surface, int y) const {
  const int width = camera_.width_px;
  const Eigen::Array2d border = box_border_px / camera_.focal_px.array();
  // A distorted row is not straight: its ends and its middle bound it, with the border.
  const std::array<float, 3> rows{ray(0, y).y(), ray(width / 2, y).y(), ray(width - 1, y).y()};
  const auto [top, bottom] = std::minmax_element(rows.begin(), rows.end());
  if (*bottom < surface.box_min.y() - border.y() || *top > surface.box_max.y() + border.y())
    return {0, 0};
  const Eigen::Vector2f* row = &ray(0, y);
  const auto first = std::lower_bound(
      row, row + width, surface.box_min.x() - border.x(),
      [](const Eigen::Vector2f& n, double bound) { return static_cast<double>(n.x()) < bound; });
  const auto last = std::upper_bound(
      first, row + width, surface.box_max.x() + border.x(),
      [](double bound, const Eigen::Vector2f& n) { return bound < static_cast<double>(n.x()); });
  return {static_cast<int>(first - row), static_cast<int>(last - row)};
}

void Renderer::render_row(int y, std::span<float> rgb) {
  std::array<std::pair<int, int>, most_surfaces> spans;
  std::array<int, 2 * most_surfaces + 2> cuts;
  std::size_t cut_count = 0;
  cuts[cut_count++] = 0;
  cuts[cut_count++] = camera_.width_px;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    spans[i] = columns(surfaces_[i], y);
    cuts[cut_count++] = spans[i].first;
    cuts[cut_count++] = spans[i].second;
  }
  std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(cut_count));
  // Between two cuts the surfaces that a pixel may see are the same.
  for (std::size_t cut = 0; cut + 1 < cut_count; ++cut) {
    if (cuts[cut] == cuts[cut + 1]) continue;
    std::array<std::uint8_t, most_surfaces> candidates;
    std::size_t count = 0;
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (spans[i].first <= cuts[cut] && spans[i].second >= cuts[cut + 1])
        candidates[count++] = static_cast<std::uint8_t>(i);
    render_run(y, cuts[cut], cuts[cut + 1], std::span(candidates).first(count), rgb);
  }
}

Ray Renderer::ray_with_steps(int x, int y) const {
  const int column = x + 1 < camera_.width_px ? x + 1 : x - 1;
  const int row = y + 1 < camera_.height_px ? y + 1 : y - 1;
  const Eigen::Vector2d at = ray(x, y).cast<double>();
  return {at, (ray(column, y).cast<double>() - at) * (column - x),
          (ray(x, row).cast<double>() - at) * (row - y)};
}

void Renderer::render_run(int y, int x_begin, int x_end, std::span<const std::uint8_t> candidates,
                          std::span<float> rgb) {
  float* out = rgb.data() + std::ptrdiff_t{3} * x_begin;
  for (int x = x_begin; x < x_end;) {
    const int block_end = std::min(x + block_px, x_end);
    // Well inside a single surface nothing has to be mixed.
    const OnlySurface only =
        only_surface(surfaces_, candidates, ray_with_steps(x, y), ray_with_steps(block_end - 1, y));
    for (; x < block_end; ++x, out += 3) {
      Rgb colour;
      if (only.surface != nullptr) {
        const Eigen::Vector2d n = ray(x, y).cast<double>();
        const PlanePoint point = meet(*only.surface, n.x(), n.y());
        colour = only.surface->texture.sample(static_cast<float>(point.u_m),
                                              static_cast<float>(point.v_m),
                                              static_cast<float>(only.footprint_m));
      } else {
        colour = mix(surfaces_, candidates, ray_with_steps(x, y), background_, layers_);
      }
      std::copy(colour.begin(), colour.end(), out);
    }
  }
}

}  // namespace gazed
