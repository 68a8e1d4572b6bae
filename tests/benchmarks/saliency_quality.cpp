// saliency_quality DATA: what the saliency map is worth, each figure beside its bound; exit code 1
// when one is missed. DATA holds osie, ecssd and nao_canteen, and may hold ecssd_more,
// nao_canteen_more and seven_scenes; pop-out displays are drawn here.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/lab/io/picture.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/benchmarks/fixations.hpp"
#include "tests/benchmarks/metrics.hpp"
#include "tests/benchmarks/photographs.hpp"
#include "tests/benchmarks/popout.hpp"
#include "tests/benchmarks/winners.hpp"
#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::benchmarks {
namespace {

namespace fs = std::filesystem;

struct Bound {
  enum class Side { least, most } side;
  double value;

  [[nodiscard]] bool holds(double x) const { return side == Side::least ? x >= value : x <= value; }
};
Bound at_least(double value) {
  return {Bound::Side::least, value};
}
Bound at_most(double value) {
  return {Bound::Side::most, value};
}

/// Prints figures, and remembers whether one missed its bound.
class Sheet {
 public:
  void title(const std::string& text) { std::printf("%s\n", text.c_str()); }

  void figure(const std::string& what, double value, std::optional<Bound> bound = std::nullopt) {
    std::printf("  %-52s %8.4f", what.c_str(), value);
    if (bound) {
      const bool held = bound->holds(value);
      std::printf("   %s %.4f  %s", bound->side == Bound::Side::least ? ">=" : "<=", bound->value,
                  held ? "ok" : "MISSED");
      missed_ = missed_ || !held;
    }
    std::printf("\n");
  }

  [[nodiscard]] bool missed() const { return missed_; }

 private:
  bool missed_ = false;
};

/// A profile, and what is asked of it.
struct Profile {
  std::string name;
  saliency::SaliencyProfile profile;
  bool has_reference;
  std::optional<Bound> nss, popout, in_mask, border_winners;

  [[nodiscard]] saliency::SaliencySettings settings() const {
    saliency::SaliencySettings settings;
    settings.profile = profile;
    return settings;
  }
};

const std::array profiles{
    Profile{"report", saliency::SaliencyProfile::report, true, {}, {}, {}, {}},
    Profile{"robust", saliency::SaliencyProfile::robust, true, at_least(1.15), at_least(0.75),
            at_least(0.68), at_most(0.0)},
    Profile{"surround", saliency::SaliencyProfile::surround, false, at_least(1.60), at_least(0.93),
            at_least(0.74), at_most(0.0)},
};
constexpr double nss_to_reference = 0.005;  // of either profile

cv::Mat map_of(const saliency::SaliencySettings& settings, const cv::Mat& frame) {
  saliency::Saliency stage(settings, frame.cols, frame.rows);
  const saliency::SaliencyMap map = stage.examine(lab::io::view_of(frame)).map;
  cv::Mat out(map.height, map.width, CV_64F);
  std::copy(map.samples.begin(), map.samples.end(), out.begin<double>());
  return out;
}

struct Scores {
  double nss = 0.0, shuffled_auc = 0.0, auc_judd = 0.0;

  void add(const cv::Mat& map, const std::vector<cv::Point>& here,
           const std::vector<cv::Point>& elsewhere) {
    const cv::Mat scored = at_scored_size(map);
    nss += benchmarks::nss(scored, here);
    shuffled_auc += benchmarks::shuffled_auc(scored, here, elsewhere);
    auc_judd += benchmarks::auc_judd(scored, here);
  }
  void divide_by(std::size_t count) {
    for (double* sum : {&nss, &shuffled_auc, &auc_judd}) *sum /= static_cast<double>(count);
  }
};

void score_fixations(const Profile& profile, const fs::path& folder, Sheet& sheet) {
  const fs::path csv = folder / "fixations.csv";
  std::ifstream stream(csv);
  if (!stream) throw std::runtime_error(csv.string() + ": cannot be read");
  const Fixations fixations = read_fixations(stream);

  const std::vector<fs::path> files = pictures(folder / "images");
  Scores fixed, reference;
  for (const fs::path& file : files) {
    const Picture picture(file);
    const std::string name = file.filename().string();
    const std::vector<cv::Point> elsewhere = fixations_elsewhere(fixations, name);
    fixed.add(map_of(profile.settings(), picture.frame), fixations.at(name), elsewhere);
    if (profile.has_reference)
      reference.add(saliency::reference::look_rgb(picture.frame, profile.settings()).map,
                    fixations.at(name), elsewhere);
  }
  fixed.divide_by(files.size());
  reference.divide_by(files.size());

  sheet.title(profile.name + ": fixations on " + std::to_string(files.size()) +
              " pictures of OSIE");
  sheet.figure("NSS", fixed.nss, profile.nss);
  sheet.figure("shuffled AUC", fixed.shuffled_auc);
  sheet.figure("AUC-J", fixed.auc_judd);
  if (!profile.has_reference) return;
  sheet.figure("NSS of the double-precision reference", reference.nss);
  sheet.figure("NSS, distance to the reference", std::abs(fixed.nss - reference.nss),
               at_most(nss_to_reference));
  sheet.figure("shuffled AUC of the reference", reference.shuffled_auc);
  sheet.figure("AUC-J of the reference", reference.auc_judd);
}

void score_winners(const Profile& profile, const fs::path& data, Sheet& sheet) {
  const std::vector<fs::path> objects = pictures(data / "ecssd" / "images");
  int inside = 0;
  for (const fs::path& file : objects)
    inside += inside_mask(Picture(file).winner(profile.settings()),
                          mask_of(file, data / "ecssd" / "masks"));
  const std::vector<fs::path> canteen = pictures(data / "nao_canteen");
  int on_border = 0;
  for (const fs::path& file : canteen) {
    const Picture picture(file);
    on_border += near_border(picture.winner(profile.settings()), picture.original);
  }
  sheet.title(profile.name + ": winners");
  sheet.figure("inside the object, share of " + std::to_string(objects.size()) + " of ECSSD",
               static_cast<double>(inside) / static_cast<double>(objects.size()), profile.in_mask);
  sheet.figure("within 24 px of the border, of " + std::to_string(canteen.size()) + " NAO frames",
               on_border, profile.border_winners);
}

std::vector<double> distinctness_of(const Profile& profile, const std::vector<fs::path>& files) {
  std::vector<double> values;
  for (const fs::path& file : files) {
    const cv::Mat frame = Picture(file).frame;
    saliency::Saliency stage(profile.settings(), frame.cols, frame.rows);
    values.push_back(stage.examine(lab::io::view_of(frame)).distinctness);
  }
  return values;
}

double share_above(double threshold, const std::vector<double>& values) {
  const auto above = std::ranges::count_if(values, [&](double v) { return v >= threshold; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

// Whether pictures of an object are told from those of none that people would agree on.
void score_distinctness(const Profile& profile, const fs::path& data, Sheet& sheet) {
  std::vector<double> objects =
      distinctness_of(profile, pictures_of(data, {"ecssd/images", "ecssd_more/images"}));
  const double threshold = profile.settings().distinctness_min;
  sheet.title(profile.name + ": distinctness, " + std::to_string(objects.size()) +
              " pictures of an object (ECSSD)");
  sheet.figure("objects at or above distinctness_min", share_above(threshold, objects));
  std::ranges::sort(objects);
  const double nine_in_ten = objects[objects.size() / 10];
  for (const auto& [what, folders] : {std::pair<std::string, std::vector<std::string>>{
                                          "a canteen", {"nao_canteen", "nao_canteen_more"}},
                                      {"a desk", {"seven_scenes"}}}) {
    const std::vector<double> none = distinctness_of(profile, pictures_of(data, folders));
    if (none.empty()) continue;
    const std::string frames = std::to_string(none.size()) + " frames of " + what;
    sheet.figure(frames + " at or above distinctness_min", share_above(threshold, none));
    sheet.figure(frames + " where 9 objects of 10 are", share_above(nine_in_ten, none));
    sheet.figure("AUC, objects against " + frames, area_under_curve(objects, none));
  }
}

void score_popout(const Profile& profile, Sheet& sheet) {
  constexpr int displays = 30;
  sheet.title(profile.name + ": odd item found at the first fixation, share of " +
              std::to_string(displays) + " displays each");
  double found_of_all = 0.0, reference_of_all = 0.0;
  for (const Oddity oddity : oddities) {
    int found = 0;
    for (int seed = 1; seed <= displays; ++seed) {
      const PopOut display = popout_display(oddity, static_cast<std::uint64_t>(seed));
      const base::ImageView frame = display.canvas.view();
      saliency::Saliency stage(profile.settings(), frame.width_px, frame.height_px);
      found += is_found(display, stage.examine(frame).peak_px);

      if (!profile.has_reference) continue;
      cv::Mat rgb(frame.height_px, frame.width_px, CV_8UC3);
      std::copy_n(frame.data, rgb.total() * rgb.elemSize(), rgb.data);
      const cv::Point winner = saliency::reference::look_rgb(rgb, profile.settings()).winner;
      reference_of_all +=
          is_found(display, saliency::saliency_cell_px * geometry::Pixel(winner.x, winner.y));
    }
    sheet.figure(std::string(name(oddity)), static_cast<double>(found) / displays);
    found_of_all += found;
  }
  constexpr double all = double{displays} * oddities.size();
  sheet.figure("all four", found_of_all / all, profile.popout);
  if (profile.has_reference)
    sheet.figure("all four, double-precision reference", reference_of_all / all);
}

int run(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: saliency_quality DATA\n");
    return 2;
  }
  const fs::path data = argv[1];
  Sheet sheet;
  for (const Profile& profile : profiles) {
    score_fixations(profile, data / "osie", sheet);
    score_winners(profile, data, sheet);
    score_distinctness(profile, data, sheet);
    score_popout(profile, sheet);
  }
  return sheet.missed() ? 1 : 0;
}

}  // namespace
}  // namespace gazed::benchmarks

int main(int argc, char** argv) {
  try {
    return gazed::benchmarks::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "saliency_quality: %s\n", error.what());
    return 2;
  }
}
