#include "scene.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "agent/geometry/chain.hpp"

namespace gazed::tracking {

namespace {

// The object's plane in camera 1's frame: origin and two unit axes.
struct Plane {
  Eigen::Vector3d origin, u, v, normal;
};

Plane object_plane(const Scene& scene) {
  const Eigen::Vector3d ray = geometry::normalise(scene.camera, scene.object_px)->homogeneous();
  const Eigen::Matrix3d axes =
      geometry::about_x(scene.tilt_rad.x()) * geometry::about_y(scene.tilt_rad.y());
  return {scene.range_m * ray.normalized(), axes.col(0), axes.col(1), axes.col(2)};
}

// Plane coordinates of where a ray meets the plane moved `behind` along its normal.
Eigen::Vector2d cut(const Plane& plane, double behind, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& along) {
  const Eigen::Vector3d origin = plane.origin + behind * plane.normal;
  const double depth = (origin - from).dot(plane.normal) / along.dot(plane.normal);
  const Eigen::Vector3d offset = from + depth * along - origin;
  return {offset.dot(plane.u), offset.dot(plane.v)};
}

bool inside(const Scene& scene, const Eigen::Vector2d& at) {
  return scene.round ? at.norm() <= scene.half_size_m
                     : at.lpNorm<Eigen::Infinity>() <= scene.half_size_m;
}

constexpr double fixed_one = 256.0;  // FixedColour's level

// Factors of colours, like NormalRow's.
constexpr double factor_one = NormalRow::one;
constexpr int factor_bits = 10;

std::int32_t fixed(double value, double one) {
  return static_cast<std::int32_t>(std::lround(value * one));
}

FixedColour fixed(const Colour& colour) {
  return {fixed(colour[0], fixed_one), fixed(colour[1], fixed_one), fixed(colour[2], fixed_one)};
}

std::uint8_t byte(std::int32_t value) {
  return static_cast<std::uint8_t>(std::clamp(value + 128, 0, 0xFFFF) >> 8);
}

// BT.601, limited range; chroma of the pair's mean.
struct Yuv {
  // 1/16384: luma, and its excursion of 219 in 255; the colour differences' 224 in 255, over 1.772
  // and 1.402.
  static constexpr std::int64_t red = 4899, green = 9617, blue = 1868, excursion = 14071,
                                blue_difference = 8122, red_difference = 10265;

  static std::int32_t luma(const FixedColour& c) {
    return static_cast<std::int32_t>((red * c[0] + green * c[1] + blue * c[2]) >> 14);
  }
  static std::uint8_t limited(std::int32_t luma) {
    return byte((16 << 8) + static_cast<std::int32_t>((excursion * luma) >> 14));
  }
  static std::uint8_t chroma(std::int64_t factor, std::int32_t difference) {
    return byte((128 << 8) + static_cast<std::int32_t>((factor * difference) >> 14));
  }
};

void write_row(const std::vector<FixedColour>& row, base::PixelFormat format, std::uint8_t* out) {
  for (std::size_t x = 0; x < row.size(); ++x) {
    if (format == base::PixelFormat::rgb24) {
      for (const std::int32_t channel : row[x]) *out++ = byte(channel);
    } else if (format == base::PixelFormat::grey) {
      *out++ = byte(Yuv::luma(row[x]));
    } else {
      const FixedColour &even = row[x & ~std::size_t{1}], &odd = row[x | 1];
      const FixedColour pair = {(even[0] + odd[0]) / 2, (even[1] + odd[1]) / 2,
                                (even[2] + odd[2]) / 2};
      const std::int32_t luma = Yuv::luma(pair);
      *out++ = Yuv::limited(Yuv::luma(row[x]));
      *out++ = x % 2 == 0 ? Yuv::chroma(Yuv::blue_difference, pair[2] - luma)
                          : Yuv::chroma(Yuv::red_difference, pair[0] - luma);
    }
  }
}

// What rays of a look meet.
class Eye {
 public:
  Eye(const Scene& scene, geometry::HeadAngles head) : scene_(scene), plane_(object_plane(scene)) {
    const geometry::Pose from_1 = geometry::cam2_from_cam1(scene.head, scene.head_1, head);
    back_ = from_1.rotation.transpose();
    eye_ = geometry::origin(from_1);
  }

  [[nodiscard]] Colour along(const Eigen::Vector2d& normalised) const {
    const Eigen::Vector3d ray = back_ * normalised.homogeneous();
    if (scene_.ball && scene_.present) {
      if (const auto colour = on_ball(ray.normalized())) return *colour;
    }
    const Eigen::Vector2d at = cut(plane_, 0.0, eye_, ray);
    if (scene_.present && !scene_.ball && inside(scene_, at)) return scene_.paint(at.x(), at.y());
    if (!scene_.wall) return scene_.wall_colour;
    const Eigen::Vector2d on_wall = cut(plane_, scene_.wall_behind_m, eye_, ray);
    return scene_.wall(on_wall.x(), on_wall.y());
  }

  [[nodiscard]] std::optional<Colour> on_ball(const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d to_centre = plane_.origin - eye_;
    const double along_m = ray.dot(to_centre);
    const double depth2_m2 =
        scene_.half_size_m * scene_.half_size_m - (to_centre.squaredNorm() - along_m * along_m);
    if (depth2_m2 < 0.0) return std::nullopt;
    const Eigen::Vector3d off = (along_m - std::sqrt(depth2_m2)) * ray - to_centre;
    return lit(scene_.paint(off.dot(plane_.u), off.dot(plane_.v)), off.normalized(), ray);
  }

  [[nodiscard]] Colour lit(const Colour& paint, const Eigen::Vector3d& normal,
                           const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d to_lamp = scene_.to_lamp.normalized();
    const double facing_lamp = std::max(0.0, normal.dot(to_lamp));
    const double mirrored = std::max(0.0, normal.dot((to_lamp - ray).normalized()));
    return (1.0 - scene_.shading * (1.0 - facing_lamp)) * paint +
           Colour::Constant(scene_.gloss_levels * std::pow(mirrored, scene_.shininess));
  }

  [[nodiscard]] Colour at(const geometry::Pixel& pixel) const {
    return along(*geometry::normalise(scene_.camera, pixel));
  }

  // Whole pixels: the object and its outline, or the frame when the wall is not plain.
  [[nodiscard]] Eigen::AlignedBox2i painted() const {
    const geometry::CameraModel& camera = scene_.camera;
    const Eigen::AlignedBox2i frame(Eigen::Vector2i(0, 0),
                                    Eigen::Vector2i(camera.width_px - 1, camera.height_px - 1));
    if (scene_.wall) return frame;
    Eigen::AlignedBox2d box;
    for (const double u : {-1.1, 1.1}) {
      for (const double v : {-1.1, 1.1}) {
        const Eigen::Vector3d corner =
            plane_.origin + scene_.half_size_m * (u * plane_.u + v * plane_.v);
        const auto pixel = geometry::project(camera, back_.transpose() * (corner - eye_));
        if (!pixel) return frame;
        box.extend(*pixel + geometry::Pixel(3, 3));
        box.extend(*pixel - geometry::Pixel(3, 3));
      }
    }
    const Eigen::AlignedBox2d seen = box.intersection(frame.cast<double>());
    if (seen.isEmpty()) return {};
    return {seen.min().array().ceil().matrix().cast<int>(),
            seen.max().array().floor().matrix().cast<int>()};
  }

  [[nodiscard]] Colour mean_over(const geometry::Pixel& pixel) const {
    constexpr int rays = 8;  // per axis
    const Eigen::Vector2d middle = *geometry::normalise(scene_.camera, pixel);
    const Eigen::Matrix2d spread = geometry::pixel_jacobian(scene_.camera, middle).inverse();
    Colour sum = Colour::Zero();
    for (int j = 0; j < rays; ++j) {
      for (int i = 0; i < rays; ++i) {
        // Sheared, so that an edge along rows or columns crosses 64 places, not 8.
        const Eigen::Vector2d offset((i + (j + 0.5) / rays) / rays - 0.5,
                                     (j + (i + 0.5) / rays) / rays - 0.5);
        sum += along(middle + spread * offset);
      }
    }
    return sum / (rays * rays);
  }

 private:
  const Scene& scene_;
  Plane plane_;
  Eigen::Matrix3d back_;
  Eigen::Vector3d eye_;
};

}  // namespace

const std::vector<std::int32_t>& NormalRow::table() {
  static const std::vector<std::int32_t> table = [] {
    base::Random random(99);
    std::vector<std::int32_t> numbers(table_size);
    for (std::int32_t& number : numbers) number = fixed(random.normal(), one);
    return numbers;
  }();
  return table;
}

double value_noise(double u_m, double v_m, double cell_m, std::uint64_t seed) {
  const double u = u_m / cell_m, v = v_m / cell_m, u0 = std::floor(u), v0 = std::floor(v);
  const auto knot = [&](double i, double j) {
    std::uint64_t h =
        seed +
        0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(static_cast<std::int64_t>(i) + 1000) +
        0xC2B2AE3D27D4EB4FU * static_cast<std::uint64_t>(static_cast<std::int64_t>(j) + 1000);
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9U;
    h = (h ^ (h >> 32)) * 0x94D049BB133111EBU;
    return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
  };
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double a = smooth(u - u0), b = smooth(v - v0);
  return (1.0 - b) * ((1.0 - a) * knot(u0, v0) + a * knot(u0 + 1, v0)) +
         b * ((1.0 - a) * knot(u0, v0 + 1) + a * knot(u0 + 1, v0 + 1));
}

Radiance look(const Scene& scene, geometry::HeadAngles head) {
  constexpr double smooth_levels = 10.0;  // between a pixel's corners: a shade, no edge
  const geometry::CameraModel& camera = scene.camera;
  const Eye eye(scene, head);
  Radiance radiance{camera.width_px, camera.height_px, head, {}};
  const auto width = static_cast<std::size_t>(camera.width_px);
  radiance.pixels.assign(width * static_cast<std::size_t>(camera.height_px),
                         fixed(scene.wall_colour));
  const Eigen::AlignedBox2i painted = eye.painted();
  // The colours at the corners of a row's pixels, above and below.
  std::vector<Colour> above, below;
  const auto corners_at = [&](double y, std::vector<Colour>& corners) {
    corners.clear();
    for (int x = painted.min().x(); x <= painted.max().x() + 1; ++x)
      corners.push_back(eye.at({x - 0.5, y}));
  };
  if (painted.isEmpty()) return radiance;
  corners_at(painted.min().y() - 0.5, below);
  for (int y = painted.min().y(); y <= painted.max().y(); ++y) {
    above.swap(below);
    corners_at(y + 0.5, below);
    for (std::size_t i = 0; i + 1 < above.size(); ++i) {
      const int x = painted.min().x() + static_cast<int>(i);
      double contrast = 0.0;
      for (const Colour& corner : {above[i + 1], below[i], below[i + 1]})
        contrast = std::max(contrast, (corner - above[i]).lpNorm<Eigen::Infinity>());
      radiance.pixels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
          fixed(contrast < smooth_levels
                    ? Colour(0.25 * (above[i] + above[i + 1] + below[i] + below[i + 1]))
                    : eye.mean_over({x, y}));
    }
  }
  return radiance;
}

Shot expose(const Radiance& radiance, const Capture& capture, base::Random& random) {
  Shot shot{base::Image(radiance.width_px, radiance.height_px, capture.format), radiance.head};
  const auto width = static_cast<std::size_t>(radiance.width_px);
  std::vector<FixedColour> row(width);
  const std::int32_t gain = fixed(capture.gain, factor_one);
  const std::int32_t bias = fixed(capture.bias_levels, fixed_one);
  const std::int32_t noise = fixed(capture.noise_levels, fixed_one);
  for (int y = 0; y < radiance.height_px; ++y) {
    NormalRow normals(random);
    for (std::size_t x = 0; x < width; ++x) {
      const FixedColour& pixel = radiance.pixels[static_cast<std::size_t>(y) * width + x];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::int32_t scaled = gain * pixel[c] + noise * normals.next();
        row[x][c] = bias + (scaled >> factor_bits);
      }
    }
    write_row(row, capture.format, shot.image.row(y));
  }
  return shot;
}

geometry::Pixel true_pixel_2(const Scene& scene, geometry::HeadAngles head_2,
                             const geometry::Pixel& pixel_1) {
  const Plane plane = object_plane(scene);
  const Eigen::Vector3d along = geometry::normalise(scene.camera, pixel_1)->homogeneous();
  const Eigen::Vector2d at = cut(plane, 0.0, Eigen::Vector3d::Zero(), along);
  const Eigen::Vector3d point = plane.origin + at.x() * plane.u + at.y() * plane.v;
  return *geometry::project(scene.camera,
                            geometry::cam2_from_cam1(scene.head, scene.head_1, head_2) * point);
}

bool on_object(const Scene& scene, const geometry::Pixel& pixel_1) {
  return inside(scene, cut(object_plane(scene), 0.0, Eigen::Vector3d::Zero(),
                           geometry::normalise(scene.camera, pixel_1)->homogeneous()));
}

}  // namespace gazed::tracking
