// saliency_held_out confirm|none|winners DATA: what the default profile is worth on the half of the
// pictures that its constants were chosen by and on the other, each share with its standard error
// and its number of pictures, beside its bound. Exit code 1 when the other half misses one.
//
// Pictures are split by scene: those of ECSSD and OSIE are each a scene of their own, every second
// one is held out. All frames of the canteen are one walk and held out, all of the desk another
// one, and fitted.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "agent/lab/io/picture.hpp"
#include "agent/saliency/appearance.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/benchmarks/metrics.hpp"
#include "tests/benchmarks/parts.hpp"
#include "tests/benchmarks/photographs.hpp"
#include "tests/benchmarks/shares.hpp"
#include "tests/benchmarks/turned_view.hpp"
#include "tests/benchmarks/winners.hpp"

namespace gazed::benchmarks {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> photographs{"osie/images", "ecssd/images", "ecssd_more/images"};
const std::vector<std::string> canteen{"nao_canteen", "nao_canteen_more"};

/// Each photograph with its half.
void for_each_picture(const fs::path& data,
                      const std::function<void(const cv::Mat&, std::size_t, std::uint64_t)>& see) {
  std::uint64_t seed = 0;
  for (const fs::path& file : pictures_of(data, photographs)) {
    const std::size_t half = seed % 2 == 0 ? fitted : held_out;
    see(lab::io::read_picture(file), half, ++seed);
  }
  for (const fs::path& file : pictures_of(data, canteen))
    see(lab::io::read_picture(file), held_out, ++seed);
}

constexpr int random_places = 10;

/// Uniform where the border cuts nothing, 48 px from the target at least.
std::vector<geometry::Pixel> elsewhere(const geometry::Pixel& target, const cv::Size& size,
                                       std::uint64_t seed) {
  constexpr double apart_px = 48.0;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double length) {
    return reach_of_border_px + static_cast<double>(random() >> 11) * 0x1p-53 *
                                    (length - 1.0 - 2.0 * reach_of_border_px);
  };
  std::vector<geometry::Pixel> places;
  while (places.size() < random_places) {
    const double x = uniform(size.width), y = uniform(size.height);
    if ((geometry::Pixel(x, y) - target).norm() >= apart_px) places.emplace_back(x, y);
  }
  return places;
}

// Of one object an outline away.
constexpr double same_winner_px = 48.0;

bool confirm(const fs::path& data) {
  const saliency::SaliencySettings settings;
  Trials same, same_without, refused, refused_by_share, moved;
  Values confirmed, confirmed_by_share;
  saliency::Saliency stage(settings, 640, 480);
  for_each_picture(data, [&](const cv::Mat& picture, std::size_t half, std::uint64_t seed) {
    const Picture whole(picture);
    const cv::Mat noisy = with_noise(whole.frame, 4.0, seed);
    saliency::Saliency of_size(settings, noisy.cols, noisy.rows);
    const geometry::Pixel clean = of_size.examine(lab::io::view_of(whole.frame)).peak_px;
    moved[half].push_back((of_size.examine(lab::io::view_of(noisy)).peak_px - clean).norm() >
                          saliency::saliency_cell_px);

    const std::optional<TurnedViews> views = turned_views(picture, settings, seed);
    if (!views) return;
    const geometry::Pixel target = views->winner_turned;
    const saliency::Appearance before = saliency::appearance_at(
        stage.examine(lab::io::view_of(views->first)).planes, views->winner);
    const auto is_same = [&](const saliency::FrameContext& context) {
      const auto seen = stage.examine(lab::io::view_of(views->second), context);
      return (seen.peak_px - target).norm() <= same_winner_px;
    };
    same_without[half].push_back(is_same({}));
    saliency::FrameContext context;
    context.previous_winner_px = target;
    same[half].push_back(is_same(context));
    const auto seen = stage.examine(lab::io::view_of(views->second), context);
    const auto there = saliency::confirm(seen, target, before);
    refused[half].push_back(!there.salient() || !there.alike());
    refused_by_share[half].push_back(!there.salient());
    int others = 0, salient_others = 0;
    for (const geometry::Pixel& place : elsewhere(target, views->second.size(), seed)) {
      const auto other = saliency::confirm(seen, place, before);
      others += other.salient() && other.alike();
      salient_others += other.salient();
    }
    confirmed[half].push_back(static_cast<double>(others) / random_places);
    confirmed_by_share[half].push_back(static_cast<double>(salient_others) / random_places);
  });
  Table table("the same object");
  table.row("the same winner after the step", shares_of(same), 0.85, 1.0);
  table.row("  without hysteresis", shares_of(same_without), 0.0, 1.0);
  table.row("true place refused", shares_of(refused), 0.0, 0.03);
  table.row("random place confirmed", means_of(confirmed), 0.0, 0.10);
  table.row("true place refused, by saliency alone", shares_of(refused_by_share), 0.0, 1.0);
  table.row("random place confirmed, by saliency alone", means_of(confirmed_by_share), 0.0, 1.0);
  table.row("noise of 4 grey levels moves the winner", shares_of(moved), 0.0, 0.04);
  return table.missed();
}

double distinctness_of(const Picture& picture) {
  saliency::Saliency stage(saliency::SaliencySettings{}, picture.frame.cols, picture.frame.rows);
  return stage.examine(lab::io::view_of(picture.frame)).distinctness;
}

/// Area under the curve with the error of Hanley and McNeil, Radiology 143(1), 1982.
Share area(const std::vector<double>& objects, const std::vector<double>& none) {
  if (objects.empty() || none.empty()) return {};
  const double a = area_under_curve(objects, none);
  const double q1 = a / (2.0 - a), q2 = 2.0 * a * a / (1.0 + a);
  const auto m = static_cast<double>(objects.size()), n = static_cast<double>(none.size());
  const double variance =
      (a * (1.0 - a) + (m - 1.0) * (q1 - a * a) + (n - 1.0) * (q2 - a * a)) / (m * n);
  return {a, std::sqrt(variance), none.size()};
}

Share above(double threshold, const std::vector<double>& values) {
  if (values.empty()) return {};
  std::vector<bool> trials;
  trials.reserve(values.size());
  for (const double value : values) trials.push_back(value >= threshold);
  return share_of(trials);
}

/// Numbers from 0 to 1 of frames of one kind.
struct Kind {
  std::string what;
  Values values = {};
};

/// Rooms of several rows, every second one held out.
void add_rooms(Kind& kind, Furnished furnished) {
  constexpr std::uint64_t of_each = 40;
  for (const char* row : {"real_03", "default_10", "real_20", "textured_10", "blank_03"})
    for (std::uint64_t i = 0; i < of_each; ++i)
      kind.values[i % 2].push_back(distinctness_of(Picture(rendered_room(row, i, furnished))));
}

bool none(const fs::path& data) {
  constexpr double least_area = 0.87, most_flagged = 0.38;
  Kind objects{"objects"}, cut{"objects that the border cuts"}, in_rooms{"objects in rooms"};
  Kind parts{"parts of photographs without their object"}, desk{"a desk"}, walk{"a canteen"};
  Kind turf{"turf"}, rooms{"walls of rendered rooms"};
  std::size_t number = 0;
  for (const std::string& folder : {std::string("ecssd"), std::string("ecssd_more")}) {
    for (const fs::path& file : pictures_of(data, {folder + "/images"})) {
      const std::size_t half = number++ % 2;
      const Picture whole(file);
      const cv::Mat mask = mask_of(file, data / folder / "masks");
      objects.values[half].push_back(distinctness_of(whole));
      if (const auto part = without_object(whole.original, mask))
        parts.values[half].push_back(distinctness_of(Picture(*part)));
      if (const auto window = cutting_window(mask, number))
        cut.values[half].push_back(distinctness_of(Picture(whole.original(*window).clone())));
    }
  }
  for (const fs::path& file : pictures_of(data, {"seven_scenes"}))
    desk.values[fitted].push_back(distinctness_of(Picture(file)));
  for (const fs::path& file : pictures_of(data, canteen))
    walk.values[held_out].push_back(distinctness_of(Picture(file)));
  for (int point = 1; point <= 5; ++point) {
    const std::string folder = "nao_v6_optitrack/black1/point" + std::to_string(point);
    if (fs::is_directory(data / folder))
      turf.values[held_out].push_back(distinctness_of(Picture(data / folder / "imagebottom.jpg")));
  }
  add_rooms(in_rooms, Furnished::with_all);
  add_rooms(rooms, Furnished::walls_alone);

  Table table("an object, or none");
  const double threshold = saliency::SaliencySettings{}.distinctness_min;
  std::array<double, 2> nine_in_ten{};
  for (const std::size_t half : {fitted, held_out}) {
    std::ranges::sort(objects.values[half]);
    nine_in_ten[half] = objects.values[half][objects.values[half].size() / 10];
  }
  const auto at_or_above = [](const std::array<double, 2>& least, const Kind& kind) {
    return std::array{above(least[fitted], kind.values[fitted]),
                      above(least[held_out], kind.values[held_out])};
  };
  for (const Kind& kind : {objects, cut, in_rooms})
    table.row(kind.what + " at or above distinctness_min",
              at_or_above({threshold, threshold}, kind), 0.0, 1.0);
  for (const Kind& kind : {parts, desk, walk, turf, rooms}) {
    table.row(kind.what + ": AUC",
              {area(objects.values[fitted], kind.values[fitted]),
               area(objects.values[held_out], kind.values[held_out])},
              least_area, 1.0);
    table.row("  at or above where 9 objects of 10 are", at_or_above(nine_in_ten, kind), 0.0,
              most_flagged);
    table.row("  at or above distinctness_min", at_or_above({threshold, threshold}, kind), 0.0,
              1.0);
  }
  return table.missed();
}

bool winners(const fs::path& data) {
  const saliency::SaliencySettings settings;
  saliency::SaliencySettings all_weight = settings;
  all_weight.overexposed_weight = 1.0;
  Trials inside, inside_all_weight, cut, at_border, moved;
  std::size_t number = 0;
  for (const std::string& folder : {std::string("ecssd"), std::string("ecssd_more")}) {
    for (const fs::path& file : pictures_of(data, {folder + "/images"})) {
      const std::size_t half = number++ % 2;
      const Picture picture(file);
      const cv::Mat mask = mask_of(file, data / folder / "masks");
      const geometry::Pixel winner = picture.winner(settings);
      inside[half].push_back(inside_mask(winner, mask));
      inside_all_weight[half].push_back(inside_mask(picture.winner(all_weight), mask));
      at_border[half].push_back(near_border(winner, picture.original));
      if (const auto window = cutting_window(mask, number)) {
        const Picture part(picture.original(*window).clone());
        cut[half].push_back(inside_mask(part.winner(settings), mask(*window)));
      }
    }
  }
  Trials canteen_at_border;
  for (const fs::path& file : pictures_of(data, canteen)) {
    const Picture picture(file);
    const geometry::Pixel winner = picture.winner(settings);
    canteen_at_border[held_out].push_back(near_border(winner, picture.original));
    const double way_px = (winner - picture.winner(all_weight)).norm() * picture.scale;
    moved[held_out].push_back(way_px > saliency::saliency_cell_px);
  }
  Table table("the right object");
  table.row("winner inside the object, ECSSD", shares_of(inside), 0.75, 1.0);
  table.row("  overexposed_weight = 1", shares_of(inside_all_weight), 0.0, 1.0);
  table.row("winner inside an object that the border cuts", shares_of(cut), 0.0, 1.0);
  table.row("winner within 24 px of the border, ECSSD", shares_of(at_border), 0.0, 1.0);
  table.row("  a canteen", shares_of(canteen_at_border), 0.0, 1.0);
  table.row("  elsewhere with overexposed_weight = 1", shares_of(moved), 0.0, 1.0);
  return table.missed();
}

int run(int argc, char** argv) {
  const std::string what = argc == 3 ? argv[1] : "";
  if (what == "confirm") return confirm(argv[2]) ? 1 : 0;
  if (what == "none") return none(argv[2]) ? 1 : 0;
  if (what == "winners") return winners(argv[2]) ? 1 : 0;
  std::fprintf(stderr, "usage: saliency_held_out confirm|none|winners DATA\n");
  return 2;
}

}  // namespace
}  // namespace gazed::benchmarks

int main(int argc, char** argv) {
  try {
    return gazed::benchmarks::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "saliency_held_out: %s\n", error.what());
    return 2;
  }
}
