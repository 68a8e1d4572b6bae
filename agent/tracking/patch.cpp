#include "agent/tracking/patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "agent/geometry/singular_values.hpp"

namespace gazed::tracking {

namespace {

// Slopes below this share of the patch's steepest add nothing to what the steep ones tell.
constexpr float edge_share = 0.15F;
// More samples do not improve the answer: the error is then the model's, not the noise's.
constexpr int edge_samples_max = 2400;
constexpr int reduced_edge_samples_max = 900;
// Flat places per side of the patch; they determine gain and bias.
constexpr int flat_samples_per_side = 20;
// On coarser levels the nearest pure background is too far from the edge.
constexpr int behind_step_max_px = 2;
// Samples that show more background than this are left out.
constexpr double share_behind_max = 0.9;
// Below this a sample counts as inside.
constexpr double share_inside_max = 0.003;
// Distance from the frame's border, where interpolation would use repeated pixels.
constexpr double frame_border_px = 2.0;
// The coarsest level keeps at least about this many samples to each side of the reference point.
constexpr double coarsest_half_size = 4.0;

PixelBox box_around(const geometry::Pixel& centre, double half_size_px) {
  return {static_cast<int>(std::floor(centre.x() - half_size_px)),
          static_cast<int>(std::floor(centre.y() - half_size_px)),
          static_cast<int>(std::ceil(centre.x() + half_size_px)) + 1,
          static_cast<int>(std::ceil(centre.y() + half_size_px)) + 1};
}

// The colour direction with most gradient energy on the object and across its outline: the leading
// eigenvector of the gradients' covariance (Di Zenzo, CVGIP 33, 1986). Zero if there is no
// gradient.
Eigen::Vector3f strongest_colour_axis(const base::ImageView& image, const ObjectMask& object,
                                      const Patch& patch) {
  const int step = std::max(1, static_cast<int>(patch.half_size_px) / 24);
  const int reach = std::max(2, step);  // at least two pixels: yuyv has half as many chroma columns
  const PixelBox box = box_around(patch.reference_px, patch.half_size_px);
  Eigen::Matrix3f energy = Eigen::Matrix3f::Zero();
  for (int y = std::max(box.y_begin, reach); y < std::min(box.y_end, image.height_px - reach);
       y += step) {
    for (int x = std::max(box.x_begin, reach); x < std::min(box.x_end, image.width_px - reach);
         x += step) {
      if (object.distance_px(x, y) > patch.margin_px) continue;
      const Eigen::Vector3f across =
          colour_at(image, x + reach, y) - colour_at(image, x - reach, y);
      const Eigen::Vector3f down = colour_at(image, x, y + reach) - colour_at(image, x, y - reach);
      energy += across * across.transpose() + down * down.transpose();
    }
  }
  if (!(energy.trace() > 0.0F)) return Eigen::Vector3f::Zero();
  Eigen::Matrix3d scaled = energy.cast<double>(), axes;
  geometry::decompose(scaled, axes);
  const Eigen::Vector3f axis = axes.col(2).cast<float>();
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0F ? Eigen::Vector3f(-axis) : axis;
}

// Squared slope at a sample, as read() computes it there.
float slope2_at(const PlaneLevel& plane, int x, int y) {
  const float* above = plane.row(y - 1) + x;
  const float* here = plane.row(y) + x;
  const float* below = plane.row(y + 1) + x;
  const float dx = (above[1] - above[-1] + below[1] - below[-1] + 4.0F * (here[1] - here[-1])) / 12;
  const float dy =
      (below[-1] - above[-1] + below[1] - above[1] + 4.0F * (below[0] - above[0])) / 12;
  return dx * dx + dy * dy;
}

// Lists the level's samples on the patch. Returns the largest squared slope.
float list_places(const PlaneLevel& plane, const geometry::CameraModel& camera,
                  const ObjectMask& object, Patch& patch) {
  const double border = std::max<double>(frame_border_px, plane.step_px);
  const geometry::Pixel reach(patch.half_size_px, patch.half_size_px);
  const geometry::Pixel frame(camera.width_px - 1 - border, camera.height_px - 1 - border);
  const Eigen::Vector2d readable(plane.width - 3, plane.height - 3);
  const Eigen::Array2i first = plane.to_samples((patch.reference_px - reach).cwiseMax(border))
                                   .cwiseMax(1.0)
                                   .array()
                                   .ceil()
                                   .cast<int>();
  const Eigen::Array2i last = plane.to_samples((patch.reference_px + reach).cwiseMin(frame))
                                  .cwiseMin(readable)
                                  .array()
                                  .floor()
                                  .cast<int>();
  const Eigen::Array2i origin = plane.origin_px.array().cast<int>();
  PatchPlaces& places = patch.places;
  places.column = first.x();
  places.row = first.y();
  places.width = std::max(0, last.x() - first.x() + 1);
  places.height = std::max(0, last.y() - first.y() + 1);
  places.slope2.clear();
  float steepest2 = 0.0F;
  for (int row = first.y(); row <= last.y(); ++row) {
    for (int column = first.x(); column <= last.x(); ++column) {
      const Eigen::Array2i pixel = origin + plane.step_px * Eigen::Array2i(column, row);
      const bool on_patch = object.distance_px(pixel.x(), pixel.y()) <= patch.margin_px;
      places.slope2.push_back(on_patch ? slope2_at(plane, column, row) : -1.0F);
      steepest2 = std::max(steepest2, places.slope2.back());
    }
  }
  return steepest2;
}

// Calls use(column, row, squared slope) for each of them, row by row.
template <typename Use>
void for_each(const PatchPlaces& places, const Use& use) {
  const float* slope2 = places.slope2.data();
  for (int y = 0; y < places.height; ++y) {
    for (int x = 0; x < places.width; ++x, ++slope2) {
      if (*slope2 >= 0.0F) use(places.column + x, places.row + y, *slope2);
    }
  }
}

// Samples the places with gradient first, thinned evenly to at most `limit`, then flat ones on a
// coarse grid.
void sample_level(const PlaneLevel& plane, const geometry::CameraModel& camera,
                  const ObjectMask& object, Patch& patch, std::ptrdiff_t limit, PatchLevel& level) {
  level.samples.clear();
  level.pixels.clear();
  const float steepest2 = list_places(plane, camera, object, patch);
  const float steep2 = edge_share * edge_share * steepest2;
  const auto take = [&](int column, int row) {
    if (level.samples.size() == PatchLevel::samples_max) return;
    const Eigen::Vector2d at(column, row);
    const geometry::Pixel pixel = plane.to_pixel(at);
    const auto normalised = geometry::normalise(camera, pixel);
    if (!normalised) return;
    PatchSample sample{*normalised, plane.read(at).value};
    const auto outline = patch.rim.place(pixel, plane.step_px);
    if (outline && !level.behind.empty()) {
      if (outline->share_behind > share_behind_max) return;
      sample.share_behind = static_cast<float>(outline->share_behind);
      sample.behind = outline->nearest;
    }
    // Within the blur the place is on the outline itself, where the relief is 0.
    if (!outline || outline->share_behind < share_inside_max)
      sample.relief = static_cast<float>(patch.relief.at(pixel));
    level.samples.push_back(sample);
    level.pixels.push_back(pixel);
  };
  const auto edges = std::count_if(patch.places.slope2.begin(), patch.places.slope2.end(),
                                   [&](float slope2) { return slope2 > steep2; });
  level.edge_stride = static_cast<int>(std::max<std::ptrdiff_t>(1, (edges + limit - 1) / limit));
  int seen = 0;
  for_each(patch.places, [&](int column, int row, float slope2) {
    if (slope2 > steep2 && seen++ % level.edge_stride == 0) take(column, row);
  });
  level.edges = level.samples.size();
  const double across = 2.0 * patch.half_size_px / plane.step_px;
  const int grid = std::max(1, static_cast<int>(across / flat_samples_per_side));
  for_each(patch.places, [&](int column, int row, float slope2) {
    if (column % grid == 0 && row % grid == 0 && !(slope2 > steep2)) take(column, row);
  });
}

// Lists the background places behind the outline, as view 1 shows them.
void list_behind(const PlaneLevel& plane, const geometry::CameraModel& camera, const Patch& patch,
                 PatchLevel& level) {
  level.behind.clear();
  if (plane.step_px > behind_step_max_px) return;
  for (const RimPoint& point : patch.rim.points()) {
    for (int place = 0; place < Rim::places_behind; ++place) {
      PatchSample& sample = level.behind.emplace_back();
      const geometry::Pixel pixel = patch.rim.behind(point, place, plane.step_px);
      const Eigen::Vector2d at = plane.to_samples(pixel);
      const auto normalised = geometry::normalise(camera, pixel);
      const bool seen = normalised && camera.contains(pixel) && plane.readable(at);
      sample.normalised = normalised.value_or(Eigen::Vector2d::Zero());
      sample.value = seen ? plane.read(at).value : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

double variance(const PatchLevel& level) {
  double n = 0.0, sum = 0.0, sum2 = 0.0;
  for (const PatchSample& sample : level.samples) {
    const double value = sample.value;
    n += 1.0;
    sum += value;
    sum2 += value * value;
  }
  return n > 0.0 ? sum2 / n - (sum / n) * (sum / n) : 0.0;
}

}  // namespace

void Patch::reserve() {
  constexpr int support_px = 4 << PlanePyramid::max_levels;
  const int size_px = 2 * static_cast<int>(patch_half_size_max_px) + support_px;
  planes.reserve_reduced(size_px, size_px);
  places.slope2.reserve(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px));
  for (PatchLevel& level : levels) {
    level.samples.reserve(PatchLevel::samples_max);
    level.pixels.reserve(PatchLevel::samples_max);
    level.behind.reserve(Rim::points_max * Rim::places_behind);
  }
}

bool sample_patch(const base::ImageView& image, const geometry::CameraModel& camera,
                  const ObjectMask& object, Patch& patch) {
  patch.format = image.format;
  patch.axis = strongest_colour_axis(image, object, patch);
  if (patch.axis.isZero()) return false;
  int levels = 2;
  while (levels < PlanePyramid::max_levels &&
         patch.half_size_px / (1 << levels) >= coarsest_half_size) {
    ++levels;
  }
  const double support_px = 4.0 * (1 << (levels - 1));
  patch.planes.build(image, patch.axis,
                     box_around(patch.reference_px, patch.half_size_px + support_px), levels);
  patch.rim.clear();
  patch.relief = {};
  if (patch.margin_px > 0.0) {
    patch.rim.find(object, patch.planes.level(0));
    patch.relief = Relief(object, camera);
  }
  for (int i = 0; i < levels; ++i) {
    list_behind(patch.planes.level(i), camera, patch, patch.levels[static_cast<std::size_t>(i)]);
    sample_level(patch.planes.level(i), camera, object, patch,
                 i == 0 ? edge_samples_max : reduced_edge_samples_max,
                 patch.levels[static_cast<std::size_t>(i)]);
  }
  patch.contrast = colour_contrast(image, patch.levels[0].samples, patch.levels[0].pixels);
  return true;
}

PredictedSigma predicted_sigma(const Patch& patch, double noise_levels) {
  // At half resolution noise has less gradient than structure. The filters before it act about like
  // a Gaussian of variance v = 2.8 px^2. It leaves 1 / sqrt(4 pi v) of white noise's standard
  // deviation and slopes of 1 / sqrt(8 pi v^2) per pixel: 0.35 grey levels from noise of 5. The
  // largest of thousands of slopes stays below four times that.
  constexpr double noise_share = 0.17;
  constexpr double slope_min_per_px = 1.5;
  constexpr double slope_noise_per_px = 0.07;  // per grey level of noise
  const PlaneLevel& plane = patch.planes.level(1);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  double noisy = 0.0;
  for (const geometry::Pixel& pixel : patch.levels[1].pixels) {
    const PlaneSample read = plane.read(plane.to_samples(pixel));
    Eigen::Vector4d jacobian(read.dx / plane.step_px, read.dy / plane.step_px, read.value, 1.0);
    if (jacobian.head<2>().norm() < slope_min_per_px) jacobian.head<2>().setZero();
    normal += jacobian * jacobian.transpose();
    if (!jacobian.head<2>().isZero()) noisy += 1.0;
  }
  const Eigen::Matrix2d gain_and_bias = normal.bottomRightCorner<2, 2>();
  const Eigen::Matrix2d mixed = normal.topRightCorner<2, 2>();
  const Eigen::Matrix2d place =
      normal.topLeftCorner<2, 2>() - mixed * gain_and_bias.inverse() * mixed.transpose();
  if (!place.allFinite()) return {infinite, infinite};
  const double by_noise = noisy * std::pow(slope_noise_per_px * noise_levels, 2);
  const double mean = 0.5 * place.trace() - by_noise;
  const double spread = std::hypot(0.5 * (place(0, 0) - place(1, 1)), place(0, 1));
  const auto sigma_px = [&](double information) {
    return information > 0.0
               ? noise_share * noise_levels * std::sqrt(patch.levels[1].edge_stride / information)
               : infinite;
  };
  return {sigma_px(mean + spread), sigma_px(mean - spread)};
}

int coarsest_useful_level(const Patch& patch) {
  constexpr double share_kept = 0.3;
  // for eight unknowns, when half of them may be out of sight
  constexpr std::size_t samples_min = 48;
  int level = patch.planes.levels() - 1;
  const double least = share_kept * variance(patch.levels[1]);
  const auto useful = [&](const PatchLevel& at) {
    return at.samples.size() >= samples_min && variance(at) >= least;
  };
  while (level > 1 && !useful(patch.levels[static_cast<std::size_t>(level)])) --level;
  return level;
}

Eigen::Vector3d colour_contrast(const base::ImageView& image, std::span<const PatchSample> samples,
                                std::span<const geometry::Pixel> pixels) {
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

}  // namespace gazed::tracking
