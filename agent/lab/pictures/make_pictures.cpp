// make_pictures FOLDER: pictures of saliency maps, from the simulator's rooms and a drawn display.
// Each shows what the camera sees beside what the saliency map makes of it. They are made anew with
//
//   cmake --build --preset native --target make_pictures
//   build/native/bin/make_pictures agent/lab/pictures
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/lab/io/frame_picture.hpp"
#include "agent/lab/io/overlay.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/saliency/saliency.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::lab {

namespace {

namespace fs = std::filesystem;

/// The picture and its overlay side by side, small enough for a page.
void write_pair(const fs::path& file, const cv::Mat& bgr) {
  const saliency::SaliencySettings settings;
  saliency::Saliency saliency(settings, bgr.cols, bgr.rows);
  const cv::Mat rgb = io::rgb_of(bgr);
  const saliency::SaliencyResult result = saliency.examine(io::view_of(rgb));
  const cv::Mat overlay = io::overlay_of(bgr, result, 1.0, settings.distinctness_min);
  constexpr double reduction = 0.65;
  cv::Mat pair;
  cv::hconcat(std::array{io::scaled(bgr, reduction), io::scaled(overlay, reduction)}, pair);
  if (!cv::imwrite(file.string(), pair, {cv::IMWRITE_JPEG_QUALITY, 85})) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  std::printf("%s: %ju bytes\n", file.c_str(), std::uintmax_t{fs::file_size(file)});
}

cv::Mat first_frame(sim::SimRobot& robot) {
  const auto frame = robot.next_frame();
  if (!frame) throw std::runtime_error("the simulated camera gave no frame");
  return io::bgr_of(frame->image);
}

/// One red bar among green ones, on a jittered grid (Treisman and Gelade 1980: it is seen at once).
cv::Mat popout_display() {
  constexpr int pitch_px = 80;
  constexpr int red_one = 20;
  cv::Mat display(480, 640, CV_8UC3, cv::Scalar(40, 40, 40));
  cv::RNG random(3);
  int number = 0;
  for (int y = pitch_px / 2; y < display.rows; y += pitch_px) {
    for (int x = pitch_px / 2; x < display.cols; x += pitch_px) {
      const cv::Point2f centre(static_cast<float>(x + random.uniform(-15, 16)),
                               static_cast<float>(y + random.uniform(-15, 16)));
      const cv::RotatedRect bar(centre, {12.0F, 40.0F}, random.uniform(-20.0F, 20.0F));
      std::array<cv::Point2f, 4> corners;
      bar.points(corners.data());
      const std::vector<cv::Point> outline(corners.begin(), corners.end());
      const bool red = number++ == red_one;
      cv::fillConvexPoly(display, outline, red ? cv::Scalar(40, 40, 210) : cv::Scalar(60, 150, 40),
                         cv::LINE_AA);
    }
  }
  return display;
}

void make_pictures(const fs::path& folder) {
  constexpr std::uint64_t seed = 1;
  sim::SimRobot robot(sim::parse_scene(sim::default_scene_toml(), "default scene"),
                      *geometry::robot_profile("nao-v6"), seed, 0);
  write_pair(folder / "report_test_1.jpg", first_frame(robot));
  robot.next_test();
  write_pair(folder / "report_test_2.jpg", first_frame(robot));
  write_pair(folder / "popout.jpg", popout_display());
}

}  // namespace

}  // namespace gazed::lab

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_pictures FOLDER\n");
    return 2;
  }
  try {
    gazed::lab::make_pictures(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_pictures: %s\n", error.what());
    return 1;
  }
  return 0;
}
