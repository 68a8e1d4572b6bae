#include "agent/daemon/report.hpp"

#include <Eigen/Core>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <poll.h>

#include "agent/base/text.hpp"

namespace gazed::daemon {

namespace {

using Json = nlohmann::ordered_json;

std::string away(const triangulation::PointEstimate& estimate) {
  if (std::isnan(estimate.range_m)) {
    if (std::isnan(estimate.inverse_range_per_m)) return {};
    return base::text("  inverse range %.3f +- %.3f per metre: too uncertain for a position",
                      estimate.inverse_range_per_m, estimate.inverse_range_sigma_per_m);
  }
  // The interval is symmetric in inverse range, so it is longer on the far side.
  const double near_m = 1.0 / (estimate.inverse_range_per_m + estimate.inverse_range_sigma_per_m);
  const double far_m = 1.0 / (estimate.inverse_range_per_m - estimate.inverse_range_sigma_per_m);
  return base::text("  %.3f m away +- %.3f m (%.1f %%), 68 %% interval %.3f to %.3f m",
                    estimate.range_m, estimate.range_sigma_m,
                    100.0 * estimate.range_sigma_m / estimate.range_m, near_m, far_m);
}

std::string where(const triangulation::PointEstimate& estimate) {
  if (!estimate.torso_point_m.allFinite()) return {};
  const Eigen::Vector3d& point = estimate.torso_point_m;
  const Eigen::Vector3d sigma = estimate.torso_covariance_m2.diagonal().cwiseSqrt();
  return base::text("\n    torso frame: x %.3f  y %.3f  z %.3f m   +- %.3f  %.3f  %.3f", point.x(),
                    point.y(), point.z(), sigma.x(), sigma.y(), sigma.z());
}

std::string how(const cycle::Fixation& fixation) {
  std::string line;
  if (fixation.pixel_1.allFinite()) {
    line += base::text("\n    seen at (%.1f, %.1f) px with the head at (%.3f, %.3f) rad",
                       fixation.pixel_1.x(), fixation.pixel_1.y(), fixation.head_1.yaw_rad,
                       fixation.head_1.pitch_rad);
  }
  if (fixation.pixel_2.allFinite()) {
    line += fixation.views > 2 ? base::text(",\n    in %d looks, the last at", fixation.views)
                               : std::string(", then at");
    line += base::text(" (%.2f, %.2f) px with (%.3f, %.3f) rad", fixation.pixel_2.x(),
                       fixation.pixel_2.y(), fixation.head_2.yaw_rad, fixation.head_2.pitch_rad);
  }
  if (!std::isnan(fixation.estimate.parallax_rad)) {
    line += base::text("\n    parallax %.4f rad, residual %.2f px", fixation.estimate.parallax_rad,
                       fixation.estimate.residual_px);
  }
  return line;
}

/// Only if the report's own steps were requested.
std::string by_the_report(const cycle::Fixation& fixation) {
  if (fixation.method != cycle::LocateMethod::report || fixation.look_count < 2) return {};
  const Eigen::Vector3d& point = fixation.report_position_m;
  if (!point.allFinite()) return "\n    by the report's six steps: no answer";
  return base::text(
      "\n    by the report's six steps: %.3f m away; torso frame: x %.3f  y %.3f  z %.3f m",
      fixation.report_range_m, point.x(), point.y(), point.z());
}

}  // namespace

std::string to_json(const located_point_t& point) {
  Json json;
  json["utime"] = point.utime;
  json["fixation"] = point.fixation;
  json["status"] = cycle::name(static_cast<cycle::Status>(point.status));
  json["reason"] = point.reason;
  json["views"] = point.views;
  json["position_m"] = point.position_m;
  json["covariance_m2"] = point.covariance_m2;
  json["camera_position_m"] = point.camera_position_m;
  json["range_m"] = point.range_m;
  json["range_sigma_m"] = point.range_sigma_m;
  json["inverse_range_per_m"] = point.inverse_range_per_m;
  json["inverse_range_sigma_per_m"] = point.inverse_range_sigma_per_m;
  json["parallax_rad"] = point.parallax_rad;
  json["residual_px"] = point.residual_px;
  json["pixel_1"] = point.pixel_1;
  json["pixel_2"] = point.pixel_2;
  json["head_1_rad"] = point.head_1_rad;
  json["head_2_rad"] = point.head_2_rad;
  json["saliency"] = point.saliency;
  json["distinctness"] = point.distinctness;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_text(const cycle::Fixation& fixation, const Effort& effort) {
  const triangulation::PointEstimate& estimate = fixation.estimate;
  std::string lines =
      (fixation.counts ? "fixation " + std::to_string(fixation.number) : "between fixations") +
      ": " + std::string(cycle::name(fixation.status));
  lines += away(estimate);
  if (fixation.status != cycle::Status::located && !fixation.reason.empty())
    lines += "\n    " + fixation.reason;
  lines += where(estimate) + by_the_report(fixation) + how(fixation);
  if (fixation.views > 0) {
    lines += base::text(
        "\n    took %.2f s from the first look; saliency %.1f ms, locating %.1f ms of this "
        "computer",
        fixation.duration_s, effort.saliency_ms, effort.locate_ms);
  }
  return lines;
}

void Report::print(std::FILE* out, const std::string& lines) {
  // A pipe is writable if it has room for 4096 bytes (PIPE_BUF), more than is ever printed at once.
  pollfd room{fileno(out), POLLOUT, 0};
  if (poll(&room, 1, 0) == 0) {
    ++dropped_;
    return;
  }
  const bool written = std::fprintf(out, "%s\n", lines.c_str()) >= 0 && std::fflush(out) == 0;
  if (!written && out == out_ && output_error_ == 0) {
    output_error_ = errno;
    note(base::text("what is printed is lost: %s", std::strerror(output_error_)));
  }
}

void Report::begin(const settings::Settings& settings, const std::string& lcm_url) {
  if (format_ != settings::PrintFormat::text) return;
  print(out_,
        base::text("gazed: %s, camera %s, head %s; publishing %s_* on %s", settings.robot.c_str(),
                   settings.camera.source.text().c_str(), settings.head.source.text().c_str(),
                   settings.lcm.prefix.c_str(), lcm_url.c_str()));
}

void Report::fixation(const cycle::Fixation& fixation, const located_point_t& message,
                      const Effort& effort) {
  if (fixation.counts) {
    ++counts_[static_cast<std::size_t>(fixation.status)];
  } else {
    ++faults_between_;
  }
  if (format_ == settings::PrintFormat::none) return;
  print(out_,
        format_ == settings::PrintFormat::json ? to_json(message) : to_text(fixation, effort));
}

void Report::note(const std::string& text) {
  print(stderr, "gazed: " + text);
}

void Report::faults(const std::string& line) {
  constexpr std::chrono::seconds pause{10};
  const auto now = std::chrono::steady_clock::now();
  if (now < faults_not_before_) return;
  if (!line.empty() && line != last_line_) {
    note(line);
    faults_not_before_ = now + pause;
  }
  last_line_ = line;
}

void Report::end(double elapsed_s, const std::string& frames) {
  const auto count = [&](cycle::Status status) {
    return counts_[static_cast<std::size_t>(status)];
  };
  if (count(cycle::Status::located) + count(cycle::Status::uncertain) == 0 && !frames.empty())
    note("nothing was located: " + frames);
  if (dropped_ > 0) note(base::text("%d messages were not printed: nobody read them", dropped_));
  if (format_ == settings::PrintFormat::none) return;
  std::string sum;
  int total = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    total += counts_[i];
    sum += (sum.empty() ? ": " : ", ") + std::to_string(counts_[i]) + " " +
           std::string(cycle::name(static_cast<cycle::Status>(i)));
  }
  if (faults_between_ > 0) sum += "; faults between fixations: " + std::to_string(faults_between_);
  // With JSON, standard output holds one object per line and nothing else.
  print(format_ == settings::PrintFormat::text ? out_ : stderr,
        base::text("%d fixation%s in %.1f s%s", total, total == 1 ? "" : "s", elapsed_s,
                   sum.c_str()));
}

}  // namespace gazed::daemon
