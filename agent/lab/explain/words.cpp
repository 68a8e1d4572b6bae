#include "agent/lab/explain/words.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/lab/explain/charts.hpp"
#include "agent/lab/explain/look_pair.hpp"

namespace gazed::lab::explain {

namespace {

using base::text;
using triangulation::all_looks::BelievedRobot;

constexpr double degrees = 180.0 / std::numbers::pi;  // in a radian

/// A number of a table; a dash where it has no meaning.
std::string number(const char* format, double value) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 40> out{};
  std::snprintf(out.data(), out.size(), format, value);
  return out.data();
}

std::string pixel_text(const geometry::Pixel& pixel) {
  return pixel.allFinite() ? text("%.1f, %.1f", pixel.x(), pixel.y()) : "–";
}

std::string interval_text(const triangulation::PointEstimate& estimate, double sigmas) {
  const auto interval =
      interval_of(estimate.inverse_range_per_m, estimate.inverse_range_sigma_per_m, sigmas);
  if (!interval) return "behind the camera";
  if (std::isinf(interval->far_m)) return text("from %.3f m to infinity", interval->near_m);
  return text("%.3f to %.3f m", interval->near_m, interval->far_m);
}

/// Of the registration, the longer axis: along an edge it is large.
double pixel_sigma_px(const Eigen::Matrix2d& covariance_px2) {
  const double mean = 0.5 * covariance_px2.trace();
  const double apart =
      std::hypot(0.5 * (covariance_px2(0, 0) - covariance_px2(1, 1)), covariance_px2(0, 1));
  return std::sqrt(mean + apart);
}

Cells row_of_look(const cycle::Fixation& fixation, std::size_t k) {
  const cycle::FixationLook& look = fixation.looks[k];
  const geometry::HeadAngles corrected = look.refined - look.measured;
  const auto corners = std::span(look.corners).first(look.corner_count);
  const auto used = std::ranges::count_if(corners, &cycle::LookCorner::used);
  return {text("%zu", k + 1),
          number("%.2f", base::seconds_between(fixation.looks.front().utime_us, look.utime_us)),
          number("%.4f", look.measured.yaw_rad),
          number("%.4f", look.measured.pitch_rad),
          number("%+.2f", 1e3 * corrected.yaw_rad),
          number("%+.2f", 1e3 * corrected.pitch_rad),
          geometry::finite(look.refined)
              ? number("%.2f", 1e3 * look.torso_1_from_torso.translation.norm())
              : "–",
          pixel_text(look.pixel),
          k == 0 ? "defines it" : number("%.3f", pixel_sigma_px(look.covariance_px2)),
          number("%.2f", look.chi2),
          number("%.3f", 1.0 / look.pair_inverse_range_per_m),
          text("%td of %zu", used, look.corner_count),
          look.used ? "yes" : "no",
          look.reason};
}

struct Parameter {
  const char* name;
  const char* unit;
  double scale;  // from the program's unit
  double before, sigma_before, after, sigma_after;
};

std::vector<Parameter> parameters(const BelievedRobot& b, const BelievedRobot& a) {
  std::vector<Parameter> out;
  const auto add = [&out](const char* name, const char* unit, double scale, double before,
                          double sigma_before, double after, double sigma_after) {
    out.push_back({name, unit, scale, before, sigma_before, after, sigma_after});
  };
  add("focal length", "px", 1.0, b.camera.focal_px.mean(), b.focal_sigma_px,
      a.camera.focal_px.mean(), a.focal_sigma_px);
  constexpr std::array<const char*, 2> centre{"image centre x", "image centre y"};
  constexpr std::array<const char*, 2> lens{"distortion k1", "distortion k2"};
  constexpr std::array<const char*, 3> arm{"lever arm x", "lever arm y", "lever arm z"};
  constexpr std::array<const char*, 3> mount{"mount roll", "mount pitch", "mount yaw"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    add(centre.at(i), "px", 1.0, b.camera.centre_px(e), b.centre_sigma_px(e), a.camera.centre_px(e),
        a.centre_sigma_px(e));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    add(lens.at(i), "", 1.0, b.camera.distortion.at(i), b.distortion_sigma(e),
        a.camera.distortion.at(i), a.distortion_sigma(e));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    add(arm.at(i), "mm", 1e3, b.head.mount_offset_m(e), b.mount_offset_sigma_m(e),
        a.head.mount_offset_m(e), a.mount_offset_sigma_m(e));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    add(mount.at(i), "mrad", 1e3, b.head.mount_rotation_rad(e), b.mount_rotation_sigma_rad(e),
        a.head.mount_rotation_rad(e), a.mount_rotation_sigma_rad(e));
  }
  add("zero of the yaw", "mrad", 1e3, b.head.zero.yaw_rad, b.zero_sigma_rad(0), a.head.zero.yaw_rad,
      a.zero_sigma_rad(0));
  add("zero of the pitch", "mrad", 1e3, b.head.zero.pitch_rad, b.zero_sigma_rad(1),
      a.head.zero.pitch_rad, a.zero_sigma_rad(1));
  return out;
}

}  // namespace

std::string answer_sentence(const cycle::Fixation& fixation) {
  const triangulation::PointEstimate& estimate = fixation.estimate;
  if (!std::isfinite(estimate.range_m)) {
    if (!std::isfinite(estimate.inverse_range_per_m)) return "No range: " + fixation.reason + ".";
    return text("No range: inverse range %.3f ± %.3f per metre, 68 %% interval %s. ",
                estimate.inverse_range_per_m, estimate.inverse_range_sigma_per_m,
                interval_text(estimate, 1.0).c_str()) +
           fixation.reason;
  }
  std::string out = text(
      "%.3f m away ± %.3f m (%.1f %%); 68 %% interval %s, 95 %% interval %s.", estimate.range_m,
      estimate.range_sigma_m, 100.0 * estimate.range_sigma_m / estimate.range_m,
      interval_text(estimate, 1.0).c_str(), interval_text(estimate, 2.0).c_str());
  if (estimate.torso_point_m.allFinite()) {
    const Eigen::Vector3d& point = estimate.torso_point_m;
    const Eigen::Vector3d sigma = estimate.torso_covariance_m2.diagonal().cwiseSqrt();
    out += text(" Torso frame: x %.3f, y %.3f, z %.3f m (± %.3f, %.3f, %.3f).", point.x(),
                point.y(), point.z(), sigma.x(), sigma.y(), sigma.z());
  }
  return fixation.reason.empty() ? out : out + " Because: " + fixation.reason + ".";
}

std::string summary_line(const cycle::Fixation& fixation) {
  const triangulation::PointEstimate& estimate = fixation.estimate;
  std::string out =
      text("fixation %d: ", fixation.number) + std::string(cycle::name(fixation.status));
  if (std::isfinite(estimate.range_m))
    out += text(", %.3f m +- %.3f m", estimate.range_m, estimate.range_sigma_m);
  return out + ", " + base::counted(static_cast<std::int64_t>(fixation.look_count), "look");
}

Table table_of_looks(const cycle::Fixation& fixation) {
  Table out{{"look", "after s", "yaw rad", "pitch rad", "yaw corrected by mrad",
             "pitch corrected by mrad", "torso moved mm", "found at px", "± px", "chi² (2 dof)",
             "range with look 1 alone, m", "corners used", "used", "why not"},
            {}};
  for (std::size_t k = 0; k < fixation.look_count; ++k)
    out.rows.push_back(row_of_look(fixation, k));
  return out;
}

std::string report_sentence(const cycle::Fixation& fixation) {
  if (fixation.look_count < 2) return "The report's six steps need two looks; there were none.";
  const Eigen::Vector3d& report = fixation.report_position_m;
  if (!report.allFinite())
    return "The report's six steps have no answer here: the two rays of the most salient places do "
           "not meet at a finite point.";
  std::string out = text(
      "The report's six steps (Russcher 2011, 4.4: the most salient places of the first two looks, "
      "measured angles, optimal triangulation) say "
      "%.3f m, %s; torso frame: x %.3f, y %.3f, z %.3f m.",
      std::abs(fixation.report_range_m),
      fixation.report_range_m < 0.0 ? "behind the camera" : "in front of it", report.x(),
      report.y(), report.z());
  const triangulation::PointEstimate& estimate = fixation.estimate;
  if (estimate.torso_point_m.allFinite()) {
    const double apart_m = (report - estimate.torso_point_m).norm();
    const double sigmas = std::abs(1.0 / fixation.report_range_m - estimate.inverse_range_per_m) /
                          estimate.inverse_range_sigma_per_m;
    out += text(" That is %.3f m from this answer; in inverse range %.1f of its sigmas.", apart_m,
                sigmas);
  }
  return out;
}

Table table_of_epipoles(const cycle::Fixation& fixation) {
  Table out{{"looks", "cameras apart mm", "epipole in look 1, px", "epipole in the later look, px",
             "the two apart px", "target's ray to the baseline, °"},
            {}};
  for (std::size_t k = 1; k < fixation.look_count; ++k) {
    const auto pair = pair_of(fixation, k);
    if (!pair) continue;
    const double angle_rad = pair->angle_to_baseline_rad(fixation.pixel_1);
    out.rows.push_back({text("1 and %zu", k + 1), number("%.2f", 1e3 * pair->baseline_m()),
                        pixel_text(pair->epipole_in_first()), pixel_text(pair->epipole_in_later()),
                        number("%.0f", epipole_distance_px(*pair)),
                        number("%.1f", angle_rad * degrees)});
  }
  return out;
}

std::string epipoles_sentence(const cycle::Fixation& fixation, const geometry::Rig& before) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double baseline_m = infinity, apart_px = infinity, angle_rad = infinity;
  for (std::size_t k = 1; k < fixation.look_count; ++k) {
    const auto pair = pair_of(fixation, k);
    if (!pair) continue;
    baseline_m = std::min(baseline_m, pair->baseline_m());
    apart_px = std::min(apart_px, epipole_distance_px(*pair));
    angle_rad = std::min(angle_rad, pair->angle_to_baseline_rad(fixation.pixel_1));
  }
  if (std::isinf(baseline_m)) {
    return "There is no second look whose angles are known: nothing can be said of epipoles.";
  }
  // What an angle's error makes of the camera's place; both looks have one.
  const double sigma_m = std::numbers::sqrt2 * before.uncertainty.encoder_sigma_rad *
                         before.head.mount_offset_m.norm();
  constexpr double sure_sigmas = 3.0;
  const bool coincide = baseline_m <= sure_sigmas * sigma_m;
  std::string out =
      "The report ends with a question: do O and O', from where a NAO takes two images, coincide, "
      "and "
      "with them the epipoles? Here they ";
  out += coincide ? "cannot be told apart: " : "do not: ";
  out +=
      text("the camera's centres stood %.1f mm apart or more, which the encoders tell to %.2f mm",
           1e3 * baseline_m, 1e3 * sigma_m);
  if (std::isfinite(apart_px))
    out += text("; the two epipoles of a pair lie %.0f px apart or more", apart_px);
  if (std::isfinite(angle_rad)) {
    out += text(
        "; the target's ray is %.1f° or more off the line that joins the centres, on which a "
        "point has no parallax",
        angle_rad * degrees);
  }
  return out + ".";
}

Table table_of_robot(const cycle::Fixation& fixation, const geometry::Rig& before) {
  Table out{
      {"of the robot", "unit", "believed before", "±", "believed after", "±", "moved by, sigmas"},
      {}};
  for (const Parameter& p :
       parameters(triangulation::all_looks::believed_before(before), fixation.robot)) {
    const char* format = p.scale == 1.0 && *p.unit == '\0' ? "%.4f" : "%.2f";
    out.rows.push_back(
        {p.name, p.unit, number(format, p.scale * p.before),
         number(format, p.scale * p.sigma_before), number(format, p.scale * p.after),
         number(format, p.scale * p.sigma_after),
         p.sigma_before > 0.0 ? number("%+.2f", (p.after - p.before) / p.sigma_before) : "–"});
  }
  return out;
}

}  // namespace gazed::lab::explain
