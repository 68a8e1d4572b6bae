#include "agent/lab/calibration/calibration_report.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"
#include "agent/lab/calibration/calibrated_settings.hpp"

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

std::string list_of_unused(const std::vector<std::string>& unused) {
  std::string lines;
  for (const std::string& name : unused) lines += "not used: " + name + "\n";
  return lines;
}

}  // namespace

std::string scale_condition(const HeadCalibration& c) {
  constexpr std::array<const char*, 2> axes = {"yaw", "pitch"};
  std::string condition;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!c.scale_is_wrong[i]) continue;
    condition +=
        base::text(condition.empty() ? "%s angles are multiplied by %.5f" : ", %s angles by %.5f",
                   axes[i], c.encoder_scale[static_cast<Eigen::Index>(i)]);
  }
  return condition;
}

std::string report_of(const HeadCalibration& c) {
  std::string report = list_of_unused(c.unused);
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

std::string report_of(const Intrinsics& result) {
  std::string report = list_of_unused(result.unused);
  report += base::text("%-12s %s\n", "rms px", "picture");
  for (std::size_t i = 0; i < result.names.size(); ++i) {
    report += base::text("%-12.3f %s\n", result.picture_rms_px[i], result.names[i].c_str());
  }
  const geometry::CameraModel& camera = result.camera;
  const geometry::CameraModel& sigma = result.sigma;
  report += base::text("%-12.3f all %zu", result.rms_px, result.names.size());
  if (result.corners_left_out > 0) {
    report += base::text("; %d corners were left out of the fit", result.corners_left_out);
  }
  report += "\n\n";
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
  if (focal_length_is_vague(result)) {
    report += base::text(
        "warning: the pictures hardly determine the focal length: it is known to %.1f %%: tilt the "
        "board by 20 to 40 degrees, each way, in 5 pictures\n",
        100.0 * sigma.focal_px.maxCoeff() / camera.focal_px.minCoeff());
  }
  if (result.names.size() < fewest_boards) {
    report += "warning: the board is seen in " + base::counted(std::ssize(result.names), "place") +
              " only: move it, and tilt it, between pictures\n";
  }
  constexpr double enough = 0.6;
  if (result.covered < enough) {
    report += "warning: towards the borders that no board reached, the distortion is a guess\n";
  }
  return report;
}

std::string report_of(const DelayEstimate& result) {
  std::string report = base::text(
      "%zu pairs of frames while the head moved, %zu points followed, %.2f px rms\n"
      "delay    %8.2f +- %.2f ms from a frame's stamp to the start of its exposure\n"
      "readout  %8.2f +- %.2f ms from its first row to its last\n",
      result.pairs, result.points, result.rms_px, 1e3 * result.delay_s, 1e3 * result.delay_sigma_s,
      1e3 * result.readout_s, 1e3 * result.readout_sigma_s);
  constexpr double vague_s = 0.005;  // at 1 rad/s 5 mrad, as much as a joint's zero
  if (result.delay_sigma_s > vague_s || result.readout_sigma_s > vague_s) {
    report += "warning: that is vague: record a head that moves faster and longer, both joints\n";
  }
  return report;
}

}  // namespace gazed::lab::calibration
