#include "tests/benchmarks/parts.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "drivers/sim/sim_robot.hpp"

#include "tests/benchmarks/accuracy_rows.hpp"

namespace gazed::benchmarks {

namespace {

/// The bounding box of a mask; none of an empty one.
std::optional<cv::Rect> box_of(const cv::Mat& mask) {
  std::vector<cv::Point> object;
  cv::findNonZero(mask > 127, object);
  if (object.empty()) return std::nullopt;
  cv::Point first = object.front(), last = object.front();
  for (const cv::Point& p : object) {
    first = {std::min(first.x, p.x), std::min(first.y, p.y)};
    last = {std::max(last.x, p.x), std::max(last.y, p.y)};
  }
  return cv::Rect(first, last + cv::Point(1, 1));
}

}  // namespace

std::optional<cv::Mat> without_object(const cv::Mat& picture, const cv::Mat& mask) {
  constexpr int least_side_px = 100;
  const std::optional<cv::Rect> object = box_of(mask);
  if (!object) return picture;
  const cv::Rect left(0, 0, object->x, mask.rows), above(0, 0, mask.cols, object->y);
  const int right_of = object->x + object->width, below_of = object->y + object->height;
  const cv::Rect right(right_of, 0, mask.cols - right_of, mask.rows);
  const cv::Rect below(0, below_of, mask.cols, mask.rows - below_of);
  cv::Rect best;
  for (const cv::Rect& part : {left, right, above, below})
    if (std::min(part.width, part.height) >= least_side_px && part.area() > best.area())
      best = part;
  if (best.area() == 0) return std::nullopt;
  return picture(best).clone();
}

std::optional<cv::Rect> cutting_window(const cv::Mat& mask, std::uint64_t seed) {
  constexpr double least_share = 0.4, most_share = 0.75;
  constexpr double least_side = 0.55, most_side = 0.8;  // of the picture's
  constexpr int tries = 200;
  const std::optional<cv::Rect> object = box_of(mask);
  if (!object) return std::nullopt;
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < tries; ++i) {
    const double side = least_side + (most_side - least_side) * uniform();
    const cv::Size size(static_cast<int>(side * mask.cols), static_cast<int>(side * mask.rows));
    const cv::Point at(static_cast<int>(uniform() * (mask.cols - size.width)),
                       static_cast<int>(uniform() * (mask.rows - size.height)));
    const cv::Rect window(at, size);
    const double share = static_cast<double>((window & *object).area()) / object->area();
    if (share >= least_share && share <= most_share) return window;
  }
  return std::nullopt;
}

cv::Mat rendered_room(const std::string& name, std::uint64_t number, Furnished furnished) {
  constexpr double least_wall_m = 1.3;  // furniture and posters are smaller
  const auto rows = accuracy_rows();
  const auto row = std::ranges::find(rows, name, &Row::name);
  if (row == rows.end()) throw std::runtime_error(name + ": no such row");
  Trial trial = draw_trial(*row, number);
  trial.scene.camera.format = base::PixelFormat::rgb24;
  if (furnished == Furnished::walls_alone)
    std::erase_if(trial.scene.planes, [](const sim::PlacedPlane& plane) {
      return plane.target || std::ranges::min(plane.appearance.size_m) < least_wall_m;
    });
  sim::SimRobot robot(trial.scene, *geometry::robot_profile("nao-v6"), trial.seed, 0);
  const base::ImageView image = robot.next_frame()->image;
  cv::Mat bgr(image.height_px, image.width_px, CV_8UC3);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c) bgr.at<cv::Vec3b>(y, x)[c] = image.row(y)[3 * x + 2 - c];
  return bgr;
}

}  // namespace gazed::benchmarks
