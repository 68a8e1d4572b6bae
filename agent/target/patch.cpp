#include "agent/target/patch.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace gazed {

namespace {

// Slopes under this share of the patch's steepest tell nothing that the steep ones do not.
constexpr float edge_share = 0.15F;
// More samples make the answer no better: the error is then the model's, not the noise's.
constexpr int edge_samples_max = 2400;
constexpr int reduced_edge_samples_max = 900;
// Flat samples per side of the patch: they hold gain and bias.
constexpr int flat_samples_per_side = 20;
// Of the frame's border; the reading there sees repeated pixels.
constexpr double frame_border_px = 2.0;

struct Candidate {
  int x, y;
  float slope2;
};

PixelBox box_around(const Pixel& centre, double half_size_px) {
  return {static_cast<int>(std::floor(centre.x() - half_size_px)),
          static_cast<int>(std::floor(centre.y() - half_size_px)),
          static_cast<int>(std::ceil(centre.x() + half_size_px)) + 1,
          static_cast<int>(std::ceil(centre.y() + half_size_px)) + 1};
}

// Calls visit(column, row, pixel) for the level's samples on the patch, row by row.
template <class Visit>
void for_each_on_patch(const PlaneLevel& plane, const CameraModel& camera, const ObjectMask& object,
                       const Patch& patch, Visit&& visit) {
  const double border = std::max(frame_border_px, 1.0 * plane.step_px);
  const double reach = patch.half_size_px;
  const Eigen::Vector2d low = plane.to_samples(patch.reference_px - Pixel(reach, reach));
  const Eigen::Vector2d high = plane.to_samples(patch.reference_px + Pixel(reach, reach));
  for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y) {
    for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x) {
      const Eigen::Vector2d at(x, y);
      const Pixel pixel = plane.to_pixel(at);
      if (!plane.readable(at) || !camera.contains(pixel, border)) continue;
      if (object.distance_px(pixel) > patch.margin_px) continue;
      visit(x, y, pixel);
    }
  }
}

float slope2_at(const PlaneLevel& plane, int x, int y) {
  const PlaneSample sample = plane.read({x, y});
  return sample.dx * sample.dx + sample.dy * sample.dy;
}

}  // namespace

Eigen::Vector3f strongest_colour_axis(const ImageView& image, const ObjectMask& object,
                                      const Pixel& centre, double half_size_px, double margin_px) {
  const int step = std::max(1, static_cast<int>(half_size_px) / 24);
  const int reach = std::max(2, step);  // two pixels: the chroma of yuyv has half the columns
  const PixelBox box = box_around(centre, half_size_px);
  Eigen::Matrix3f energy = Eigen::Matrix3f::Zero();
  for (int y = std::max(box.y_begin, reach); y < std::min(box.y_end, image.height_px - reach);
       y += step) {
    for (int x = std::max(box.x_begin, reach); x < std::min(box.x_end, image.width_px - reach);
         x += step) {
      if (object.distance_px({x, y}) > margin_px) continue;
      const Eigen::Vector3f across =
          colour_at(image, x + reach, y) - colour_at(image, x - reach, y);
      const Eigen::Vector3f down = colour_at(image, x, y + reach) - colour_at(image, x, y - reach);
      energy += across * across.transpose() + down * down.transpose();
    }
  }
  if (!(energy.trace() > 0.0F)) return Eigen::Vector3f::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(energy);
  Eigen::Vector3f axis = solver.eigenvectors().col(2);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0F ? Eigen::Vector3f(-axis) : axis;
}

namespace {

// The samples with gradient first, thinned evenly to at most `limit`, then flat ones on a wide
// grid.
void sample_level(const PlaneLevel& plane, const CameraModel& camera, const ObjectMask& object,
                  const Patch& patch, int limit, PatchLevel& level) {
  level.samples.clear();
  level.pixels.clear();
  float steepest2 = 0.0F;
  for_each_on_patch(plane, camera, object, patch, [&](int x, int y, const Pixel&) {
    steepest2 = std::max(steepest2, slope2_at(plane, x, y));
  });
  const float threshold2 = edge_share * edge_share * steepest2;
  int edges = 0;
  for_each_on_patch(plane, camera, object, patch, [&](int x, int y, const Pixel&) {
    edges += slope2_at(plane, x, y) > threshold2 ? 1 : 0;
  });
  const auto take = [&](int x, int y, const Pixel& pixel) {
    if (const auto normalised = normalise(camera, pixel)) {
      level.samples.push_back({*normalised, plane.read({x, y}).value});
      level.pixels.push_back(pixel);
    }
  };
  level.edge_stride = std::max(1, (edges + limit - 1) / limit);
  int seen = 0;
  for_each_on_patch(plane, camera, object, patch, [&](int x, int y, const Pixel& pixel) {
    if (slope2_at(plane, x, y) > threshold2 && seen++ % level.edge_stride == 0) take(x, y, pixel);
  });
  level.edge_samples = static_cast<int>(level.samples.size());
  const int grid = std::max(
      1, static_cast<int>(2.0 * patch.half_size_px / plane.step_px / flat_samples_per_side));
  for_each_on_patch(plane, camera, object, patch, [&](int x, int y, const Pixel& pixel) {
    if (x % grid == 0 && y % grid == 0 && slope2_at(plane, x, y) <= threshold2) take(x, y, pixel);
  });
}

}  // namespace

void sample_patch(const ImageView& image, const CameraModel& camera, const ObjectMask& object,
                  Patch& patch) {
  // The coarsest level still has about 8 samples across.
  int levels = 2;
  while (levels < PlanePyramid::max_levels && patch.half_size_px / (1 << levels) >= 4.0) ++levels;
  const double support = 4.0 * (1 << (levels - 1));
  patch.planes.build(image, patch.axis,
                     box_around(patch.reference_px, patch.half_size_px + support), levels);
  for (int i = 0; i < levels; ++i) {
    sample_level(patch.planes.level(i), camera, object, patch,
                 i == 0 ? edge_samples_max : reduced_edge_samples_max,
                 patch.levels[static_cast<std::size_t>(i)]);
  }
}

Eigen::Vector3d colour_contrast(const ImageView& image, std::span<const PatchSample> samples,
                                std::span<const Pixel> pixels) {
  double n = 0.0, sum = 0.0, sum2 = 0.0;
  Eigen::Vector3d colour_sum = Eigen::Vector3d::Zero(), product = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = std::round(pixels[i].x()), y = std::round(pixels[i].y());
    if (!(x >= 0.0 && y >= 0.0 && x < image.width_px && y < image.height_px)) continue;
    const double value = samples[i].value;
    const Eigen::Vector3d colour =
        colour_at(image, static_cast<int>(x), static_cast<int>(y)).cast<double>();
    n += 1.0;
    sum += value;
    sum2 += value * value;
    colour_sum += colour;
    product += value * colour;
  }
  const double spread = n * sum2 - sum * sum;
  if (!(spread > 0.0)) return Eigen::Vector3d::Zero();
  return (n * product - sum * colour_sum) / spread;
}

}  // namespace gazed
