// Looks at a picture and locates a point with nothing but find_package(gazed): ends with 0 when
// both are where they were put.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "agent/base/image.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/saliency/saliency.hpp"
#include "agent/triangulation/estimate.hpp"

namespace {

constexpr int width_px = 320;
constexpr int height_px = 240;
// A sample of the saliency map: it says which object, not where in it.
constexpr double peak_tolerance_px = gazed::saliency::saliency_cell_px;
// Of a point a metre away, seen without noise: rounding.
constexpr double point_tolerance_m = 1e-9;

bool finds_a_red_square() {
  constexpr int left = 200, top = 96, side = 32;
  gazed::base::Image image(width_px, height_px, gazed::base::PixelFormat::rgb24);
  std::ranges::fill(image.pixels(), 128);
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      std::uint8_t* pixel = image.row(y) + static_cast<std::ptrdiff_t>(3 * x);
      pixel[0] = 200;
      pixel[1] = pixel[2] = 30;
    }
  }
  gazed::saliency::Saliency saliency({}, width_px, height_px);
  const auto result = saliency.examine(image.view());
  const gazed::geometry::Pixel centre(left + (side - 1) / 2.0, top + (side - 1) / 2.0);
  std::printf("peak at (%.1f, %.1f) px, distinctness %.2f\n", result.peak_px.x(),
              result.peak_px.y(), static_cast<double>(result.distinctness));
  return (result.peak_px - centre).cwiseAbs().maxCoeff() < peak_tolerance_px &&
         result.distinctness > gazed::saliency::SaliencySettings{}.distinctness_min;
}

bool locates_a_point() {
  const auto robot = gazed::geometry::robot_profile("nao-v6");
  if (!robot) return false;
  gazed::geometry::Rig rig = robot->rig;
  rig.uncertainty = {.pixel_sigma_px = 0.1};    // calibrated to perfection
  const Eigen::Vector3d truth(0.5, 0.05, 0.2);  // in the torso's frame, metres
  gazed::triangulation::TwoLooks looks;
  looks.head_1 = {0.0, 0.0};
  looks.head_2 = {0.3, -0.2};
  const auto seen_1 = gazed::geometry::project(
      rig.camera, gazed::geometry::cam_from_torso(rig.head, looks.head_1) * truth);
  const auto seen_2 = gazed::geometry::project(
      rig.camera, gazed::geometry::cam_from_torso(rig.head, looks.head_2) * truth);
  if (!seen_1 || !seen_2) return false;
  looks.pixel_1 = *seen_1;
  looks.pixel_2 = *seen_2;
  const auto estimate = gazed::triangulation::estimate_point(rig, looks, {});
  std::printf("%s: (%.6f, %.6f, %.6f) m\n",
              std::string(gazed::triangulation::name(estimate.status)).c_str(),
              estimate.torso_point_m.x(), estimate.torso_point_m.y(), estimate.torso_point_m.z());
  return estimate.status == gazed::triangulation::Status::located &&
         (estimate.torso_point_m - truth).cwiseAbs().maxCoeff() < point_tolerance_m;
}

}  // namespace

int main() {
  const bool found = finds_a_red_square();
  const bool located = locates_a_point();
  return found && located ? EXIT_SUCCESS : EXIT_FAILURE;
}
