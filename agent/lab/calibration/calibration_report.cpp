#include "agent/lab/calibration/calibration_report.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/settings/table.hpp"

namespace gazed::lab::calibration {

namespace {

std::string residual_table(const BundleResult& fit) {
  return base::text("residual, px rms            before      after\n") +
         base::text("  angles as measured    %10.3f %10.3f\n", fit.before.measured_px,
                    fit.after.measured_px) +
         (fit.encoder_sigma_rad > 0.0 ? base::text("  angles refined        %10.3f %10.3f\n",
                                                   fit.before.refined_px, fit.after.refined_px)
                                      : std::string());
}

std::string parameter_table(const HeadCalibration& c) {
  std::string table = base::text("%-32s %12s %12s %11s %11s\n", "parameter", "before", "after",
                                 "+- sigma", "prior sigma");
  for (int i = 0; i < parameter_count; ++i) {
    const bool is_scale = i == encoder_scale_at || i == encoder_scale_at + 1;
    if (is_scale) continue;
    const double before = c.prior.mean[i], after = c.fit.estimate[i];
    const bool held = !(c.prior.sigma[i] > 0.0);
    if (held && before == 0.0) continue;
    const auto& name = parameter_names()[static_cast<std::size_t>(i)].text;
    table += base::text("%-32.*s %12.6g %12.6g ", static_cast<int>(name.size()), name.data(),
                        before, after);
    table += held ? "       held\n"
                  : base::text("%11.2g %11.2g\n", c.certainty.sigma[i], c.prior.sigma[i]);
  }
  return table;
}

std::string scale_lines(const HeadCalibration& c) {
  std::string lines;
  constexpr std::array<const char*, 2> axes = {"yaw", "pitch"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    lines +=
        base::text("encoder scale %-18s %12d %12.6g %11.2g %11s\n", axes[i], 1, c.encoder_scale[at],
                   c.encoder_scale_sigma[at], c.scale_is_wrong[i] ? "" : "1 is taken");
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!c.scale_is_wrong[i]) continue;
    const double scale = c.encoder_scale[static_cast<Eigen::Index>(i)];
    lines += base::text(
        "warning: the head turns %.2f %% %s in %s than its encoder says. gazed has no key "
        "for that: multiply the measured angles by %.5f where they are read; the other "
        "numbers hold for that\n",
        100.0 * std::abs(scale - 1.0), scale > 1.0 ? "more" : "less", axes[i], scale);
  }
  return lines;
}

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

/// What with_meeting_axes() leaves at any pitch from -60 to 60 degrees, at most: 2 sin(pitch / 2)
/// times the offset's x.
double left_by_meeting_axes_m(const Eigen::Vector3d& axis_offset_m) {
  return std::abs(axis_offset_m.x());
}

std::string axis_lines(const HeadCalibration& c) {
  const Eigen::Vector3d& offset_m = c.after.axis_offset_m;
  if (offset_m.isZero(0.0)) return {};
  std::string lines = base::text(
      "gazed has no key for an axis offset: the TOML holds its x and y (%.5f, %.5f m) in "
      "mount_offset_m, its z (%.5f m) in neck_offset_m\n",
      offset_m.x(), offset_m.y(), offset_m.z());
  if (offset_m.x() == 0.0) return lines;
  constexpr double pitch_rad = 0.5;  // as far down as a NAO looks
  return lines + base::text(
                     "warning: the axis offset's x, %.2f mm, is right in mount_offset_m at pitch 0 "
                     "only: at %.1f rad gazed has the camera %.2f mm off. mount_offset_sigma_m is "
                     "larger by %.2f mm for that\n",
                     1e3 * offset_m.x(), pitch_rad,
                     1e3 * std::abs(offset_m.x()) * 2.0 * std::sin(pitch_rad / 2.0),
                     1e3 * left_by_meeting_axes_m(offset_m));
}

std::string weak_lines(const Certainty& certainty) {
  std::string unobservable, weak;
  for (const WeakDirection& direction : certainty.weak) {
    const std::string line = base::text("  %s (%.1f %% from the pictures)\n",
                                        direction.name.c_str(), 100.0 * direction.data_share);
    (direction.data_share < unobservable_share ? unobservable : weak) += line;
  }
  std::string lines;
  if (!unobservable.empty()) lines += "unobservable, the prior's value stays:\n" + unobservable;
  if (!weak.empty()) lines += "known more from the prior than from the pictures:\n" + weak;
  if (lines.empty()) lines = "every direction is observable\n";
  return lines;
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

/// Pictures that fit the camera far worse than the others.
std::string bad_pictures(const Intrinsics& result, std::span<const std::string> names) {
  std::vector<double> sorted = result.picture_rms_px;
  std::ranges::sort(sorted);
  constexpr double far_worse = 3.0;
  const double limit_px = far_worse * sorted[sorted.size() / 2];
  std::string lines;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (result.picture_rms_px[i] <= limit_px) continue;
    lines += "warning: " + names[i] +
             base::text(
                 " fits %.0f times worse than most: leave it out, or, where squares are smaller "
                 "than 25 px, try --corner-window auto\n",
                 result.picture_rms_px[i] / sorted[sorted.size() / 2]);
  }
  return lines;
}

}  // namespace

std::string report_of(const HeadCalibration& c) {
  std::string report;
  for (const std::string& name : c.unused) report += "not used: " + name + "\n";
  report +=
      c.input + base::text("; %zu image points, %zu used\n", c.sightings, c.fit.sightings_used);
  report += residual_table(c.fit);
  report += base::text("noise of an image coordinate %.3f px", c.fit.pixel_sigma_px);
  if (c.fit.encoder_sigma_rad > 0.0) {
    report += base::text(", of a joint angle %.2f mrad at most", 1e3 * c.fit.encoder_sigma_rad);
  }
  if (c.neck_in_pattern_m) {
    report += base::text(
        "\nthe neck stands at (%.4f, %.4f, %.4f) m in the frame of the board or the marks",
        c.neck_in_pattern_m->x(), c.neck_in_pattern_m->y(), c.neck_in_pattern_m->z());
  }
  return report + "\n\n" + parameter_table(c) + scale_lines(c) + axis_lines(c) + "\n" +
         weak_lines(c.certainty);
}

std::string report_of(const Intrinsics& result, std::span<const std::string> names) {
  std::string report = base::text("%-12s %s\n", "rms px", "picture");
  for (std::size_t i = 0; i < names.size(); ++i) {
    report += base::text("%-12.3f %s\n", result.picture_rms_px[i], names[i].c_str());
  }
  const geometry::CameraModel& camera = result.camera;
  const geometry::CameraModel& sigma = result.sigma;
  report += bad_pictures(result, names);
  report += base::text("%-12.3f all %zu\n\n", result.rms_px, names.size());
  report += base::text("focal_px    %10.3f +- %.3f %10.3f +- %.3f\n", camera.focal_px.x(),
                       sigma.focal_px.x(), camera.focal_px.y(), sigma.focal_px.y());
  report += base::text("centre_px   %10.3f +- %.3f %10.3f +- %.3f\n", camera.centre_px.x(),
                       sigma.centre_px.x(), camera.centre_px.y(), sigma.centre_px.y());
  constexpr std::array<const char*, 5> coefficients = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    report += base::text("%-11s %10.5f +- %.5f\n", coefficients[i], camera.distortion[i],
                         sigma.distortion[i]);
  }
  report += base::text("the boards cover %.0f %% of the image\n", 100.0 * result.covered);
  constexpr double enough = 0.6;
  if (result.covered < enough) {
    report += "warning: towards the borders that no board reached, the distortion is a guess\n";
  }
  return report;
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

std::string calibration_toml(const settings::Settings& settings, const std::string& comment) {
  constexpr auto paths = std::to_array<std::string_view>(
      {"robot", "camera.position", "camera.width_px", "camera.height_px", "camera.focal_px",
       "camera.centre_px", "camera.distortion", "camera.mount_offset_m",
       "camera.mount_rotation_rad", "head.neck_offset_m", "head.zero_rad",
       "uncertainty.encoder_sigma_rad", "uncertainty.zero_sigma_rad", "uncertainty.focal_sigma_px",
       "uncertainty.centre_sigma_px", "uncertainty.distortion_sigma",
       "uncertainty.mount_offset_sigma_m", "uncertainty.mount_rotation_sigma_rad"});
  std::string toml;
  for (std::size_t begin = 0; begin < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', begin), comment.size());
    toml += "# " + comment.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  std::string_view table;
  for (const settings::Key& key : settings::all_keys()) {
    if (std::ranges::find(paths, key.path) == paths.end()) continue;
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
