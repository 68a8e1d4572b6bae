#include "agent/lab/pair_file.hpp"

#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "agent/base/regular_file.hpp"
#include "agent/base/strict_toml.hpp"
#include "agent/base/text.hpp"
#include "agent/geometry/singular_values.hpp"

namespace gazed::lab {

namespace {

constexpr double greatest_number = 1e9;  // of a matrix; beyond it nothing is meant
/// A picture of as few as 2 pixels would still be 90 degrees wide.
constexpr double shortest_focal_px = 1.0;
/// Of R^T R from the identity, per element: a matrix written with six decimals is within it.
constexpr double rotation_tolerance = 1e-5;
constexpr double longest_baseline_m = 10.0;  // a longer one is taken for a slip of the unit

constexpr base::Range any_number{-greatest_number, greatest_number};

void check_required(base::StrictTable& table) {
  constexpr const char* rows = "3 rows, [[...], ...], each of 3 numbers";
  constexpr std::array<std::array<const char*, 2>, 5> required{
      {{"K1", rows},
       {"K2", rows},
       {"R", rows},
       {"t", "an array of 3 numbers, metres"},
       {"pixel_sigma_px", "a number, 1e-06 to 1000, pixels"}}};
  for (const auto& [key, allowed] : required)
    if (!table.has(key)) table.fail(key, allowed);
}

std::optional<Eigen::Matrix3d> matrix(base::StrictTable& table, std::string_view key) {
  const auto values = table.matrix<3, 3>(key, any_number);
  if (!values) return std::nullopt;
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values->data());
}

void check_matrix(base::StrictTable& table, std::string_view key, const Eigen::Matrix3d& k) {
  if (k.determinant() == 0.0) {
    table.fail(key, "a calibration matrix, [[fx, skew, cx], [0, fy, cy], [0, 0, 1]], not singular");
  } else if (k(1, 0) != 0.0 || k(2, 0) != 0.0 || k(2, 1) != 0.0 || k(2, 2) != 1.0) {
    table.fail(key, "[[fx, skew, cx], [0, fy, cy], [0, 0, 1]]");
  } else if (!(k(0, 0) >= shortest_focal_px && k(1, 1) >= shortest_focal_px)) {
    table.refuse(key, base::text("focal lengths %g and %g found; allowed: from %g px", k(0, 0),
                                 k(1, 1), shortest_focal_px));
  }
}

void read_camera(base::StrictTable& table, std::string_view matrix_key,
                 std::string_view distortion_key, PairCamera& camera) {
  if (const std::optional<Eigen::Matrix3d> k = matrix(table, matrix_key)) {
    check_matrix(table, matrix_key, *k);
    camera.model.focal_px = {(*k)(0, 0), (*k)(1, 1)};
    camera.model.centre_px = {(*k)(0, 2), (*k)(1, 2)};
    camera.skew_px = (*k)(0, 1);
  }
  camera.model.distortion =
      table
          .numbers_and_zeros<5>(distortion_key, any_number, 4,
                                "an array of 5 numbers, k1, k2, p1, p2, k3 (the last one may be "
                                "missing, zeros may follow; the rational model is not gazed's: "
                                "calibrate with 5)")
          .value_or(std::array<double, 5>{});
}

/// The rotation nearest to R (Frobenius norm), which must be one but for rounding.
void read_rotation(base::StrictTable& table, Eigen::Matrix3d& rotation) {
  const std::optional<Eigen::Matrix3d> r = matrix(table, "R");
  if (!r) return;
  const double off = (r->transpose() * *r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = r->determinant();
  if (!(off <= rotation_tolerance) || determinant < 0.0) {
    table.refuse("R", base::text("no rotation: R^T R is up to %.3g off the identity, the "
                                 "determinant is %.6g; allowed: up to %g off, determinant 1",
                                 off, determinant, rotation_tolerance));
    return;
  }
  // U S V^T without S.
  Eigen::Matrix3d u = *r, v;
  geometry::decompose(u, v);
  u.colwise().normalize();
  rotation = u * v.transpose();
}

void read_translation(base::StrictTable& table, CameraPair& pair) {
  constexpr std::string_view key = "t";
  const auto values = table.numbers<3>(key, any_number);
  if (!values) return;
  const Eigen::Vector3d t((*values)[0], (*values)[1], (*values)[2]);
  const double baseline_m = t.norm();
  if (baseline_m > longest_baseline_m) {
    pair.warnings.push_back(table.place(key) +
                            base::text("the baseline is %.3g m: t is in metres; were these "
                                       "millimetres or another unit?",
                                       baseline_m));
  } else if (baseline_m == 0.0) {
    pair.warnings.push_back(table.place(key) + "no baseline: every point will be DEGENERATE");
  }
  pair.cam2_from_cam1.translation = t;
}

/// The pixel as the same camera without skew has it.
geometry::Pixel without_skew(const PairCamera& camera, const geometry::Pixel& pixel) {
  const geometry::CameraModel& model = camera.model;
  const double y = (pixel.y() - model.centre_px.y()) / model.focal_px.y();
  return {pixel.x() - camera.skew_px * y, pixel.y()};
}

triangulation::ImagePoint image_point_of(const PairCamera& camera, const geometry::Pixel& pixel,
                                         double sigma_px) {
  const Eigen::Matrix2d noise_px2 = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  auto point = triangulation::image_point(camera.model, without_skew(camera, pixel), noise_px2);
  if (!point) return {.covariance_px2 = noise_px2};
  const Eigen::Matrix2d skewed{{1.0, camera.skew_px / camera.model.focal_px.y()}, {0.0, 1.0}};
  point->pixel_jacobian = skewed * point->pixel_jacobian;
  return *point;
}

}  // namespace

CameraPair parse_pair(std::string_view toml_text, const std::string& name) {
  base::TomlDocument document(toml_text, name, base::longest_written_toml);
  base::StrictTable table(document);
  CameraPair pair;
  // Each key is asked for before anything is said of its value: a misspelt one is then named as
  // what it is, and not as a missing other.
  for (const char* key :
       {"K1", "K2", "R", "t", "pixel_sigma_px", "D1", "D2", "rotation_sigma_rad",
        "translation_sigma_m", "focal_sigma_px", "centre_sigma_px", "relative_sigma_max"}) {
    static_cast<void>(table.has(key));
  }
  table.finish();
  if (!document.is_refused()) check_required(table);
  read_camera(table, "K1", "D1", pair.cameras[0]);
  read_camera(table, "K2", "D2", pair.cameras[1]);
  read_rotation(table, pair.cam2_from_cam1.rotation);
  read_translation(table, pair);
  const auto take = [&](double& member, std::string_view key, base::Range range) {
    member = table.number(key, range).value_or(member);
  };
  take(pair.pixel_sigma_px, "pixel_sigma_px", {1e-6, 1000.0});
  take(pair.rotation_sigma_rad, "rotation_sigma_rad", {0.0, 1.0});
  take(pair.translation_sigma_m, "translation_sigma_m", {0.0, longest_baseline_m});
  take(pair.focal_sigma_px, "focal_sigma_px", {0.0, 1000.0});
  take(pair.centre_sigma_px, "centre_sigma_px", {0.0, 1000.0});
  take(pair.relative_sigma_max, "relative_sigma_max", {0.001, 10.0});
  document.check();
  return pair;
}

CameraPair read_pair_file(const std::string& file) {
  return parse_pair(base::read_text(file, base::longest_written_toml),
                    base::excerpt(file, base::longest_file_name));
}

triangulation::TwoViews two_views(const CameraPair& pair, const geometry::Pixel& pixel_1,
                                  const geometry::Pixel& pixel_2) {
  return {.cam2_from_cam1 = pair.cam2_from_cam1,
          .point_1 = image_point_of(pair.cameras[0], pixel_1, pair.pixel_sigma_px),
          .point_2 = image_point_of(pair.cameras[1], pixel_2, pair.pixel_sigma_px),
          .torso_from_cam1 = std::nullopt};
}

triangulation::ErrorSources error_sources(const CameraPair& pair,
                                          const triangulation::TwoViews& views) {
  triangulation::ErrorSources sources;
  if (pair.cameras[0] == pair.cameras[1]) {
    triangulation::add_camera_errors(views, pair.focal_sigma_px, pair.centre_sigma_px, sources);
  } else {
    triangulation::add_separate_camera_errors(views, pair.focal_sigma_px, pair.centre_sigma_px,
                                              sources);
  }
  triangulation::add_relative_pose_errors(pair.rotation_sigma_rad, pair.translation_sigma_m,
                                          sources);
  return sources;
}

}  // namespace gazed::lab
