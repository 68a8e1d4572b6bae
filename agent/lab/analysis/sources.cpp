#include "agent/lab/analysis/sources.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "agent/base/text.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/lab/analysis/setup.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::lab::analysis {

namespace {

struct Source {
  std::string_view name;
  double& (*sigma)(geometry::Uncertainty&);
  ShownUnit unit;
};

using Sigmas = geometry::Uncertainty;
constexpr ShownUnit px{"px"}, mm{"mm", 1000.0}, mrad{"mrad", 1000.0}, none{"1"};
constexpr std::array<Source, 9> all_sources{{
    {"focal length", [](Sigmas& u) -> double& { return u.focal_sigma_px; }, px},
    {"image centre", [](Sigmas& u) -> double& { return u.centre_sigma_px; }, px},
    {"distortion k1", [](Sigmas& u) -> double& { return u.distortion_sigma[0]; }, none},
    {"distortion k2", [](Sigmas& u) -> double& { return u.distortion_sigma[1]; }, none},
    {"encoders", [](Sigmas& u) -> double& { return u.encoder_sigma_rad; }, mrad},
    {"joint zeros", [](Sigmas& u) -> double& { return u.zero_sigma_rad; }, mrad},
    {"lever arm", [](Sigmas& u) -> double& { return u.mount_offset_sigma_m; }, mm},
    {"mount rotation", [](Sigmas& u) -> double& { return u.mount_rotation_sigma_rad; }, mrad},
    {"image points", [](Sigmas& u) -> double& { return u.pixel_sigma_px; }, px},
}};
constexpr std::array<std::size_t, source_points> indices{1, 3, 4};  // of scene_points_m()

std::array<double, source_points> relative_sigmas(const geometry::Rig& rig) {
  // Only the sigma is asked for: the points are exact, and what is left of a residual is rounding.
  constexpr double any = std::numeric_limits<double>::infinity();
  const triangulation::Gate gate{
      .relative_sigma_max = any, .epipolar_chi2_max = any, .baseline_sigmas = 0.0};
  const geometry::Pose second = geometry::cam2_from_cam1(rig.head, nao_look_1, nao_look_2);
  std::array<double, source_points> sigmas{};
  for (std::size_t i = 0; i < source_points; ++i) {
    const Eigen::Vector3d point_m = scene_points_m()[indices.at(i)];
    triangulation::TwoLooks looks{
        .head_1 = nao_look_1, .head_2 = nao_look_2, .pixel_1 = {}, .pixel_2 = {}};
    looks.pixel_1 = geometry::pixel_of(rig.camera, point_m.hnormalized());
    looks.pixel_2 = geometry::pixel_of(rig.camera, (second * point_m).hnormalized());
    const triangulation::PointEstimate estimate = triangulation::estimate_point(rig, looks, gate);
    sigmas.at(i) = estimate.inverse_range_sigma_per_m / estimate.inverse_range_per_m;
  }
  return sigmas;
}

}  // namespace

std::vector<SourceRow> nao_sources() {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  std::vector<SourceRow> rows;
  for (const Source& source : all_sources) {
    geometry::Rig alone{rig.camera, rig.head, {}};
    double& sigma = source.sigma(alone.uncertainty);
    sigma = source.sigma(rig.uncertainty);
    rows.push_back({.source = source.name,
                    .sigma = source.unit.scale * sigma,
                    .unit = source.unit.name,
                    .relative_sigma = relative_sigmas(alone)});
  }
  std::ranges::stable_sort(rows, std::ranges::greater(),
                           [](const SourceRow& row) { return row.relative_sigma.back(); });
  rows.push_back({.source = "all",
                  .sigma = triangulation::not_a_number,
                  .unit = "",
                  .relative_sigma = relative_sigmas(rig)});
  return rows;
}

std::string sources_csv(std::span<const SourceRow> rows) {
  std::string out = "source,sigma,unit,at_0.3_m,at_0.75_m,at_1.5_m\n";
  for (const SourceRow& row : rows) {
    out.append(row.source).append(",");
    if (!row.unit.empty()) out += base::text("%g", row.sigma);
    out.append(",").append(row.unit);
    for (const double sigma : row.relative_sigma) out += base::text(",%.6g", sigma);
    out += '\n';
  }
  return out;
}

std::string sources_text(std::span<const SourceRow> rows) {
  std::string out =
      "nao-v6: one sigma of the range, % of it, by estimate_point; head (yaw, pitch) from (0, 0) "
      "to "
      "(-0.35, 0.1) rad\n  one sigma of                  at 0.3 m  at 0.75 m   at 1.5 m\n";
  for (const SourceRow& row : rows) {
    const std::string sigma =
        row.unit.empty() ? "" : base::text("%g %s", row.sigma, std::string(row.unit).c_str());
    out += base::text("  %-16s %-10s", std::string(row.source).c_str(), sigma.c_str());
    for (const double part : row.relative_sigma) out += base::text(" %10.2f", 100.0 * part);
    out += '\n';
  }
  return out;
}

}  // namespace gazed::lab::analysis
