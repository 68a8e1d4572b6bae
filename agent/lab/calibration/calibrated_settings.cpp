#include "agent/lab/calibration/calibrated_settings.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "agent/base/text.hpp"
#include "agent/settings/table.hpp"

namespace gazed::lab::calibration {

namespace {

/// gazed takes axes that meet. Across the head (y) an offset of the pitch axis is one of the
/// camera, upwards (z) one of the neck: both exact at every angle. Forward (x) it is one of the
/// camera at pitch 0 only.
geometry::HeadGeometry with_meeting_axes(geometry::HeadGeometry head,
                                         const Eigen::Vector3d& axis_offset_m) {
  head.mount_offset_m.x() += axis_offset_m.x();
  head.mount_offset_m.y() += axis_offset_m.y();
  head.neck_offset_m.z() += axis_offset_m.z();
  return head;
}

double greatest(const Parameters& sigma, int at, int count) {
  return sigma.segment(at, count).maxCoeff();
}

/// To a fraction of the unit: no more digits than mean something, for a person who reads the file.
double rounded(double value, double parts_of_unit) {
  return std::round(value * parts_of_unit) / parts_of_unit + 0.0;  // no -0
}
constexpr double thousandths = 1e3, millionths = 1e6;

geometry::CameraModel rounded(geometry::CameraModel camera) {
  for (double& f : camera.focal_px) f = rounded(f, thousandths);
  for (double& c : camera.centre_px) c = rounded(c, thousandths);
  for (double& d : camera.distortion) d = rounded(d, millionths);
  return camera;
}

geometry::HeadGeometry rounded(geometry::HeadGeometry head) {
  for (double& x : head.mount_offset_m) x = rounded(x, millionths);
  for (double& x : head.neck_offset_m) x = rounded(x, millionths);
  for (double& angle : head.mount_rotation_rad) angle = rounded(angle, millionths);
  head.zero = {rounded(head.zero.yaw_rad, millionths), rounded(head.zero.pitch_rad, millionths)};
  return head;
}

/// Two digits, upwards: a sigma is never written smaller than it is.
double rounded_sigma(double sigma) {
  if (!(sigma > 0.0)) return sigma;
  const double parts = std::pow(10.0, 1.0 - std::floor(std::log10(sigma)));
  return std::ceil(sigma * parts - 1e-6) / parts;
}

// What gazed reads of a camera and a head.
constexpr auto calibrated_keys = std::to_array<std::string_view>(
    {"robot", "camera.position", "camera.width_px", "camera.height_px", "camera.focal_px",
     "camera.centre_px", "camera.distortion", "camera.mount_offset_m", "camera.mount_rotation_rad",
     "head.neck_offset_m", "head.zero_rad", "uncertainty.encoder_sigma_rad",
     "uncertainty.zero_sigma_rad", "uncertainty.focal_sigma_px", "uncertainty.centre_sigma_px",
     "uncertainty.distortion_sigma", "uncertainty.mount_offset_sigma_m",
     "uncertainty.mount_rotation_sigma_rad"});

bool is_calibrated(const settings::Key& key) {
  return std::ranges::find(calibrated_keys, key.path) != calibrated_keys.end();
}

}  // namespace

double left_by_meeting_axes_m(const Eigen::Vector3d& axis_offset_m) {
  return std::abs(axis_offset_m.x());
}

settings::Settings calibrated_settings(settings::Settings settings, const HeadCalibration& c) {
  settings.rig.camera = rounded(c.after.camera);
  settings.rig.head = rounded(with_meeting_axes(c.after.head, c.after.axis_offset_m));
  geometry::Uncertainty& u = settings.rig.uncertainty;
  // A turned zero of pitch is a turned mount: the mount's sigmas are those with the zeros held.
  const Parameters& sigma = c.certainty.sigma;
  const Parameters& mount = c.certainty.sigma_given_zeros;
  u.focal_sigma_px = rounded_sigma(greatest(sigma, focal_at, 2));
  u.centre_sigma_px = rounded_sigma(greatest(sigma, centre_at, 2));
  u.distortion_sigma = {rounded_sigma(greatest(sigma, distortion_at, 1)),
                        rounded_sigma(greatest(sigma, distortion_at + 1, 1))};
  u.mount_offset_sigma_m = rounded_sigma(greatest(mount, mount_offset_at, 3) +
                                         left_by_meeting_axes_m(c.after.axis_offset_m));
  u.mount_rotation_sigma_rad = rounded_sigma(greatest(mount, mount_rotation_at, 3));
  u.zero_sigma_rad = rounded_sigma(greatest(sigma, zero_at, 2));
  u.encoder_sigma_rad = rounded_sigma(std::max(u.encoder_sigma_rad, c.fit.encoder_sigma_rad));
  return settings;
}

settings::Settings calibrated_settings(settings::Settings settings, const Intrinsics& result) {
  settings.rig.camera = rounded(result.camera);
  settings.rig.uncertainty.focal_sigma_px = rounded_sigma(result.sigma.focal_px.maxCoeff());
  settings.rig.uncertainty.centre_sigma_px = rounded_sigma(result.sigma.centre_px.maxCoeff());
  settings.rig.uncertainty.distortion_sigma = {rounded_sigma(result.sigma.distortion[0]),
                                               rounded_sigma(result.sigma.distortion[1])};
  return settings;
}

void scale_camera(settings::Settings& settings, int width_px) {
  geometry::CameraModel& camera = settings.rig.camera;
  geometry::Uncertainty& u = settings.rig.uncertainty;
  const double scale = static_cast<double>(width_px) / camera.width_px;
  camera.width_px = width_px;
  camera.height_px = static_cast<int>(std::lround(scale * camera.height_px));
  camera.focal_px *= scale;
  camera.centre_px = (camera.centre_px.array() + 0.5) * scale - 0.5;  // (0, 0): a pixel's centre
  camera = rounded(camera);
  u.focal_sigma_px = rounded_sigma(scale * u.focal_sigma_px);
  u.centre_sigma_px = rounded_sigma(scale * u.centre_sigma_px);
}

void check_read_back(const settings::Settings& settings) {
  settings::SettingsLayers layers;
  for (const settings::Key& key : settings::all_keys()) {
    if (!is_calibrated(key)) continue;
    layers.command_line.push_back({.key = std::string(key.path),
                                   .text = settings::toml_text(settings::read(settings, key)),
                                   .where = "the calibration makes no sense",
                                   .written = settings::Written::as_toml});
  }
  try {
    static_cast<void>(settings::load_settings(layers, {}));
  } catch (const settings::SettingsError& error) {
    std::string advice;
    if (settings.rig.camera.focal_px.minCoeff() < 0.0) {
      advice =
          "; a negative focal length comes of an axis that counts the wrong way: yaw is "
          "positive left, pitch positive down";
    }
    throw std::invalid_argument(error.what() + advice);
  }
}

std::string calibration_toml(const settings::Settings& settings, const std::string& comment,
                             Timing timing) {
  std::string toml;
  for (std::size_t begin = 0; begin < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', begin), comment.size());
    toml += "# " + comment.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  std::string_view table;
  for (const settings::Key& key : settings::all_keys()) {
    const bool is_time = key.path == "camera.delay_s" || key.path == "camera.readout_s";
    if (!is_calibrated(key) && !(is_time && timing == Timing::written)) continue;
    if (key.table() != table) {
      table = key.table();
      toml.append("\n[").append(table).append("]\n");
    }
    toml.append(key.name())
        .append(" = ")
        .append(settings::toml_text(settings::read(settings, key)))
        .append("\n");
  }
  return toml;
}

}  // namespace gazed::lab::calibration
