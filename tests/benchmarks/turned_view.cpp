#include "tests/benchmarks/turned_view.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/lab/io/picture.hpp"

namespace gazed::benchmarks {

namespace {

constexpr double step_rad = 0.1;  // the rule's
constexpr double noise_grey_levels = 2.0;
const cv::Size picture_size(800, 600), window(640, 480);
// The second view's corner is up to 79 px from the first's on each axis, and 12 px more by the turn
// on the other: the window of the first lies this far from the side that it leaves.
constexpr int margin_x_px = 40, margin_y_px = 20;

/// The middle of the picture, scaled to fill it.
cv::Mat at_picture_size(const cv::Mat& bgr) {
  const double scale = std::max(static_cast<double>(picture_size.width) / bgr.cols,
                                static_cast<double>(picture_size.height) / bgr.rows);
  cv::Mat scaled;
  cv::resize(bgr, scaled, cv::Size(), scale, scale,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  const int x = std::max(scaled.cols - picture_size.width, 0) / 2;
  const int y = std::max(scaled.rows - picture_size.height, 0) / 2;
  cv::Mat out;
  cv::copyMakeBorder(scaled, out, 0, 1, 0, 1,
                     cv::BORDER_REPLICATE);  // where a side was rounded down
  return lab::io::rgb_of(out(cv::Rect({x, y}, picture_size)));
}

/// From pixels of the second view to pixels of the first: K R K^-1.
cv::Matx33d first_from_second(const geometry::Rig& rig, const geometry::HeadAngles& turned) {
  const Eigen::Matrix3d r = geometry::cam2_from_cam1(rig.head, turned, {}).rotation;
  const auto& c = rig.camera;
  const cv::Matx33d k(c.focal_px.x(), 0, c.centre_px.x(), 0, c.focal_px.y(), c.centre_px.y(), 0, 0,
                      1);
  return k *
         cv::Matx33d(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                     r(2, 2)) *
         k.inv();
}

geometry::Pixel mapped(const cv::Matx33d& h, const geometry::Pixel& p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x(), p.y(), 1.0);
  return {q[0] / q[2], q[1] / q[2]};
}

}  // namespace

cv::Mat with_noise(const cv::Mat& rgb, double grey_levels, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat noise(rgb.size(), CV_32FC3), sum;
  random.fill(noise, cv::RNG::NORMAL, 0.0, grey_levels);
  cv::add(rgb, noise, sum, cv::noArray(), CV_8U);
  return sum;
}

std::optional<TurnedViews> turned_views(const cv::Mat& bgr,
                                        const saliency::SaliencySettings& settings,
                                        std::uint64_t seed) {
  const cv::Mat picture = at_picture_size(bgr);
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  saliency::Saliency stage(settings, window.width, window.height);
  for (const bool right : {true, false}) {
    for (const bool down : {true, false}) {
      const cv::Point at(right ? margin_x_px : picture_size.width - window.width - margin_x_px,
                         down ? margin_y_px : picture_size.height - window.height - margin_y_px);
      TurnedViews views;
      views.first = with_noise(picture(cv::Rect(at, window)), noise_grey_levels, 2 * seed);
      views.winner = stage.examine(lab::io::view_of(views.first)).peak_px;
      if ((views.winner.x() >= window.width / 2) != right ||
          (views.winner.y() >= window.height / 2) != down)
        continue;
      const cv::Matx33d h =
          first_from_second(rig, {right ? -step_rad : step_rad, down ? step_rad : -step_rad});
      views.winner_turned = mapped(h.inv(), views.winner);
      const geometry::CameraModel frame{.width_px = window.width, .height_px = window.height};
      if (!frame.contains(views.winner_turned, reach_of_border_px)) return std::nullopt;
      const cv::Matx33d in_picture(1, 0, at.x, 0, 1, at.y, 0, 0, 1);
      cv::Mat turned;
      cv::warpPerspective(picture, turned, in_picture * h, window,
                          cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
      views.second = with_noise(turned, noise_grey_levels, 2 * seed + 1);
      return views;
    }
  }
  return std::nullopt;
}

}  // namespace gazed::benchmarks
