#include "drivers/sim/render.hpp"

#include <algorithm>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>

#include "drivers/sim/paint.hpp"

namespace gazed::sim {

namespace {

constexpr double box_border_px = 2.0;
// Pixels that share one texture footprint; and one quadratic for where they look, if the depth
// changes by less than a twentieth over them: its error is below 0.0024 px then (Course). On a
// steeper plane runs are of three pixels, which are the first, the middle and the last.
constexpr int block_px = TextureSampler::longest_run_px;
constexpr double most_depth_change = 0.05;
constexpr int exact_run_px = 3;

using Rgb = std::array<Light, 3>;

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
  std::array<double, 3> sum{};
  double left = 1.0;
  const auto add = [&](const Rgb& colour, double share) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += share * levels_of(colour[c]);
    left -= share;
  };
  for (std::size_t i = 0; i < count && left > 0.0; ++i)
    add(paint(*layers[i].surface, layers[i].point, layers[i].footprint_m),
        std::min(layers[i].coverage, left));
  if (left > 0.0) add(background, left);
  return {light_of(sum[0]), light_of(sum[1]), light_of(sum[2])};
}

}  // namespace

Renderer::Renderer(const geometry::CameraModel& camera) : camera_(camera) {
  const auto normalised = [&](int x, int y) -> Eigen::Vector2f {
    const std::optional<Eigen::Vector2d> n = geometry::normalise(camera, geometry::Pixel(x, y));
    if (!n)
      throw std::invalid_argument("robot.distortion: no ray through pixel (" + std::to_string(x) +
                                  ", " + std::to_string(y) +
                                  ") found; allowed: a distortion that can be undone");
    return n->cast<float>();
  };
  if (camera.distortion == decltype(camera.distortion){}) {
    for (int x = 0; x < camera.width_px; ++x) columns_.push_back(normalised(x, 0).x());
    for (int y = 0; y < camera.height_px; ++y) rows_.push_back(normalised(0, y).y());
    return;
  }
  rays_.reserve(static_cast<std::size_t>(camera.width_px) *
                static_cast<std::size_t>(camera.height_px));
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) rays_.push_back(normalised(x, y));
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
        s.motion,
        TextureSampler(s.texture, s.half_width_m, s.half_height_m, tile(s.texture)),
        s.finish,
        world.lamp_m,
        s.shape == Shape::ball ? s.half_width_m : 0.0};
    surfaces_.push_back(std::move(placed));
  }
  layers_.resize(surfaces_.size());
  for (std::size_t c = 0; c < 3; ++c) background_[c] = light_of(world.background[c]);
}

void Renderer::set_pose(const geometry::Pose& cam_from_torso, double time_s) {
  for (PlacedSurface& surface : surfaces_) place(surface, cam_from_torso, time_s);
}

std::pair<int, int> Renderer::columns(const PlacedSurface& surface, int y) const {
  const int width = camera_.width_px;
  const Eigen::Array2d border = box_border_px / camera_.focal_px.array();
  // A distorted row is not straight: its ends and its middle bound it, with the border.
  const std::array<float, 3> rows{ray(0, y).y(), ray(width / 2, y).y(), ray(width - 1, y).y()};
  const auto [top, bottom] = std::minmax_element(rows.begin(), rows.end());
  if (*bottom < surface.box_min.y() - border.y() || *top > surface.box_max.y() + border.y())
    return {0, 0};
  const auto begins = [&](int x) { return ray(x, y).x() < surface.box_min.x() - border.x(); };
  const auto goes_on = [&](int x) { return !(surface.box_max.x() + border.x() < ray(x, y).x()); };
  const auto all = std::views::iota(0, width);
  const int first = *std::ranges::partition_point(all, begins);
  const int last = *std::ranges::partition_point(std::views::iota(first, width), goes_on);
  return {first, last};
}

void Renderer::render_row(int y, std::span<Light> rgb) {
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

void Renderer::paint_block(int y, int x_begin, const OnlySurface& only,
                           std::span<Light> rgb) const {
  const auto met_at = [&](int column) {
    const Eigen::Vector2d n = ray(column, y).cast<double>();
    const PlanePoint point = meet(*only.surface, n.x(), n.y());
    return SurfacePoint{point.u_m, point.v_m};
  };
  const int longest = only.depth_change > most_depth_change ? exact_run_px : block_px;
  for (int x = x_begin; !rgb.empty();) {
    const int count = std::min(longest, static_cast<int>(rgb.size() / 3)), last = count - 1;
    const std::size_t values = 3 * static_cast<std::size_t>(count);
    only.surface->texture.sample(met_at(x), met_at(x + last / 2), met_at(x + last),
                                 static_cast<float>(only.footprint_m), rgb.first(values));
    if (only.surface->finish.gloss > 0.0)
      for (int i = 0; i < count; ++i)
        add_highlight(*only.surface, met_at(x + i),
                      rgb.subspan(3 * static_cast<std::size_t>(i), 3));
    x += count;
    rgb = rgb.subspan(values);
  }
}

void Renderer::render_run(int y, int x_begin, int x_end, std::span<const std::uint8_t> candidates,
                          std::span<Light> rgb) {
  for (int x = x_begin; x < x_end;) {
    const int block_end = std::min(x + block_px, x_end);
    const std::span block =
        rgb.subspan(3 * static_cast<std::size_t>(x), 3 * static_cast<std::size_t>(block_end - x));
    // Well inside a single surface nothing has to be mixed.
    const OnlySurface only =
        only_surface(surfaces_, candidates, ray_with_steps(x, y), ray_with_steps(block_end - 1, y));
    if (only.surface != nullptr) {
      paint_block(y, x, only, block);
      x = block_end;
      continue;
    }
    for (auto out = block.begin(); x < block_end; ++x, out += 3) {
      const Rgb colour = mix(surfaces_, candidates, ray_with_steps(x, y), background_, layers_);
      std::copy(colour.begin(), colour.end(), out);
    }
  }
}

}  // namespace gazed::sim
