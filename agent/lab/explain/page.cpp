#include "agent/lab/explain/page.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/core/mat.hpp>

#include "agent/base/text.hpp"
#include "agent/lab/analysis/gnuplot.hpp"
#include "agent/lab/explain/charts.hpp"
#include "agent/lab/explain/html.hpp"
#include "agent/lab/explain/painting.hpp"
#include "agent/lab/explain/words.hpp"
#include "agent/lab/io/output_files.hpp"

namespace gazed::lab::explain {

namespace {

namespace fs = std::filesystem;
using base::text;

std::string heading(const char* words) {
  return std::string("<h2>") + words + "</h2>\n";
}
std::string paragraph(const std::string& words) {
  return "<p>" + html::escaped(words) + "</p>\n";
}
std::string shown(const Table& table) {
  return html::table(table.header, table.rows);
}

std::string percent(double share) {
  return text("%.2f", 100.0 * share);
}

/// One page on its way.
class Page {
 public:
  Page(const ReplayedFixation& replayed, const settings::Settings& settings, const fs::path& folder)
      : replayed_(replayed),
        fixation_(replayed.fixation),
        settings_(settings),
        folder_(folder),
        stem_(text("fixation-%d", fixation_.number)) {}

  std::string answer(const std::string& log_file) const;
  std::string looks();
  std::string patches();
  std::string range();
  std::string costs();
  std::string epipoles() const;
  std::string robot() const;

  [[nodiscard]] fs::path file(const std::string& ending) const {
    return folder_ / (stem_ + ending);
  }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  std::string figure(const cv::Mat& picture, const std::string& ending, const std::string& caption);
  std::string chart(const std::string& script, const std::string& ending,
                    const std::string& caption);

  const ReplayedFixation& replayed_;
  const cycle::Fixation& fixation_;
  const settings::Settings& settings_;
  fs::path folder_;
  std::string stem_;
  std::string complaint_;
};

std::string Page::figure(const cv::Mat& picture, const std::string& ending,
                         const std::string& caption) {
  if (picture.empty()) return {};
  io::write_png(file(ending + ".png"), picture);
  return "<figure>" + html::image(picture, caption) + "<figcaption>" + html::escaped(caption) +
         "</figcaption></figure>\n";
}

std::string Page::chart(const std::string& script, const std::string& ending,
                        const std::string& caption) {
  if (script.empty()) return {};
  io::write_text_file(file(ending + ".gp"), script);
  switch (analysis::run_gnuplot(folder_, stem_ + ending + ".gp")) {
    case analysis::Gnuplot::drawn: {
      std::ifstream in(file(ending + ".svg"));
      const std::string svg(std::istreambuf_iterator<char>(in), {});
      if (!svg.empty())
        return "<figure>" + html::svg_image(svg, caption) + "<figcaption>" +
               html::escaped(caption) + "</figcaption></figure>\n";
      complaint_ = "the charts are missing: gnuplot wrote none";
      break;
    }
    case analysis::Gnuplot::not_installed:
      complaint_ =
          "the charts are missing: gnuplot is not installed (Debian: apt-get install gnuplot-nox)";
      break;
    case analysis::Gnuplot::failed:
      complaint_ = "the charts are missing: gnuplot failed";
      break;
  }
  return paragraph("No chart: " + complaint_ + ".");
}

std::string Page::answer(const std::string& log_file) const {
  const char* kind = fixation_.status == cycle::Status::located     ? "good"
                     : fixation_.status == cycle::Status::uncertain ? "doubt"
                                                                    : "bad";
  return text("<h1>Fixation %d of ", fixation_.number) +
         html::escaped(fs::path(log_file).filename().string()) +
         "</h1>\n<p class=\"answer\"><span class=\"status " + kind + "\">" +
         std::string(cycle::name(fixation_.status)) + "</span> " +
         html::escaped(answer_sentence(fixation_)) + "</p>\n<p class=\"quiet\">" +
         html::escaped(text("Robot %s; %zu looks in %.2f s; distinctness %.2f where %.2f is "
                            "needed; saliency of the winner %.2f. "
                            "Replayed from the recording by the same code as gazed.",
                            settings_.robot.c_str(), fixation_.look_count, fixation_.duration_s,
                            static_cast<double>(fixation_.distinctness),
                            settings_.cycle.saliency.distinctness_min,
                            static_cast<double>(fixation_.saliency))) +
         "</p>\n";
}

std::string Page::looks() {
  std::string out = heading("What it saw");
  out += "<ul class=\"legend\">\n";
  for (const Ink* ink : all_inks())
    out += "<li><span style=\"background:" + std::string(ink->html) + "\"></span>" +
           html::escaped(ink->what) + "</li>\n";
  out += "</ul>\n";
  if (fixation_.look_count == 0) {
    for (const SeenFrame& frame : replayed_.frames) {
      out += figure(painted_map(frame, settings_.cycle.saliency.distinctness_min), "-map-1",
                    "The frame, and its saliency map: nothing was looked at");
    }
    return replayed_.frames.empty() ? out + paragraph("No frame was looked at.") : out;
  }
  const Painting painting{.nearest_m = settings_.cycle.locate.registration.range_min_m};
  for (std::size_t k = 0; k < fixation_.look_count; ++k) {
    const cycle::FixationLook& look = fixation_.looks[k];
    const SeenFrame* frame = replayed_.frame_at(look.utime_us);
    if (frame == nullptr) continue;
    const std::string name = text("Look %zu", k + 1);
    const std::string what =
        look.reason.empty()
            ? text(", head at (%.3f, %.3f) rad", look.measured.yaw_rad, look.measured.pitch_rad)
            : ": " + look.reason;
    out += "<div class=\"pair\">\n" +
           figure(painted_look(replayed_, k, painting), text("-look-%zu", k + 1), name + what) +
           figure(painted_map(*frame, settings_.cycle.saliency.distinctness_min),
                  text("-map-%zu", k + 1), name + ": its saliency map") +
           "</div>\n";
  }
  return out;
}

std::string Page::patches() {
  const std::string pictures = figure(painted_patches(replayed_), "-patches",
                                      "The patch as each look that found it saw it, enlarged; the "
                                      "cross is the same point of the object");
  const std::string table =
      fixation_.look_count > 0
          ? heading("The looks") + shown(table_of_looks(fixation_)) +
                paragraph(text("Corners of the background: %zu used, %zu rejected.",
                               fixation_.features_used, fixation_.features_rejected))
          : std::string();
  return (pictures.empty() ? "" : heading("The patch that is found again") + pictures) + table;
}

std::string Page::range() {
  const std::string script = interval_script(fixation_, stem_ + "-range");
  std::string out = heading("How far away");
  if (script.empty())
    return out + paragraph("No two looks saw the target: there is no interval to show.");
  return out +
         chart(script, "-range",
               "Thick: 68 %, thin: 95 %; an arrow goes on to infinity. The intervals are of "
               "inverse range, and so longer on the far side") +
         heading("The report's own answer") + paragraph(report_sentence(fixation_));
}

std::string Page::costs() {
  const std::vector<Cost> costs = costs_of(fixation_);
  std::string out = heading("What each source of error costs");
  if (costs.empty()) return out + paragraph("There is no answer whose error could be split.");
  Table table{{"source", "sigma by it alone, % of the range", "sigma without it, % of the range",
               "share of the variance, %"},
              {}};
  for (const Cost& cost : costs)
    table.rows.push_back({std::string(cost.cause), percent(cost.alone), percent(cost.without),
                          text("%.1f", 100.0 * cost.share)});
  return out +
         paragraph(
             "Of what the looks left of each: the background tells much of the head's angles, and "
             "of the robot. The squares of the second column add up to the square of the whole.") +
         chart(costs_script(costs, stem_ + "-costs"), "-costs",
               "One sigma of the range that each source would leave by itself") +
         shown(table);
}

std::string Page::epipoles() const {
  return heading("Do the epipoles coincide?") +
         paragraph(epipoles_sentence(fixation_, settings_.rig)) +
         shown(table_of_epipoles(fixation_));
}

std::string Page::robot() const {
  return heading("What is believed of the robot") + shown(table_of_robot(fixation_, settings_.rig));
}

}  // namespace

Explained write_page(const ReplayedFixation& replayed, const settings::Settings& settings,
                     const std::string& log_file, const std::vector<std::string>& all,
                     const fs::path& folder) {
  Page page(replayed, settings, folder);
  std::string body =
      page.answer(log_file) + page.looks() + page.patches() + page.range() + page.costs();
  if (replayed.fixation.look_count > 1) body += page.epipoles() + page.robot();
  body += heading("All fixations of this recording") + "<ul>\n";
  for (const std::string& line : all) body += "<li>" + html::escaped(line) + "</li>\n";
  body += "</ul>\n";
  const fs::path file = page.file(".html");
  io::write_text_file(file,
                      html::page(text("Fixation %d: %s", replayed.fixation.number,
                                      std::string(cycle::name(replayed.fixation.status)).c_str()),
                                 body));
  return {file, page.complaint()};
}

}  // namespace gazed::lab::explain
