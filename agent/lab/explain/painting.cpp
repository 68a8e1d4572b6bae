#include "agent/lab/explain/painting.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/lab/explain/look_pair.hpp"
#include "agent/lab/io/overlay.hpp"
#include "agent/lab/io/picture.hpp"

namespace gazed::lab::explain {

namespace {

constexpr int enlarged = 2;  // of a frame, so that thin lines show between its pixels
constexpr int fraction_bits = 4;
const cv::Scalar halo(30, 30, 30);  // under everything, so that it shows on any ground

/// Where the centre of a pixel of the frame is in the enlarged picture.
cv::Point2d placed(const geometry::Pixel& pixel) {
  const geometry::Pixel at = io::input_pixel(pixel, 1.0 / enlarged);
  return {at.x(), at.y()};
}

/// In fixed point, kept where OpenCV's integers hold it: a line to far outside stays a line.
cv::Point fixed(const cv::Point2d& at) {
  const auto coordinate = [](double value) {
    constexpr double far = 1e6;
    return static_cast<int>(std::lround(std::clamp(value, -far, far) * (1 << fraction_bits)));
  };
  return {coordinate(at.x), coordinate(at.y)};
}

class Painter {
 public:
  explicit Painter(const cv::Mat& bgr) : picture_(io::scaled(bgr, enlarged)) {}

  void line(const cv::Point2d& from, const cv::Point2d& to, const Ink& ink, int width = 2) {
    on_halo(ink, width, [&](const cv::Scalar& colour, int broad) {
      cv::line(picture_, fixed(from), fixed(to), colour, broad, cv::LINE_AA, fraction_bits);
    });
  }
  void lines(std::span<const geometry::Pixel> pixels, bool closed, const Ink& ink, int width = 2) {
    std::vector<cv::Point> points;
    points.reserve(pixels.size());
    for (const geometry::Pixel& pixel : pixels) points.push_back(fixed(placed(pixel)));
    on_halo(ink, width, [&](const cv::Scalar& colour, int broad) {
      cv::polylines(picture_, points, closed, colour, broad, cv::LINE_AA, fraction_bits);
    });
  }
  void ring(const cv::Point2d& at, double radius, const Ink& ink, int width = 2) {
    on_halo(ink, width, [&](const cv::Scalar& colour, int broad) {
      cv::circle(picture_, fixed(at), static_cast<int>(radius * (1 << fraction_bits)), colour,
                 broad, cv::LINE_AA, fraction_bits);
    });
  }
  void dot(const cv::Point2d& at, const Ink& ink) {
    constexpr double radius = 2.5;
    cv::circle(picture_, fixed(at), static_cast<int>((radius + 1.0) * (1 << fraction_bits)), halo,
               cv::FILLED, cv::LINE_AA, fraction_bits);
    cv::circle(picture_, fixed(at), static_cast<int>(radius * (1 << fraction_bits)), ink.bgr,
               cv::FILLED, cv::LINE_AA, fraction_bits);
  }
  void words(const std::string& text, const cv::Point2d& at, const Ink& ink) {
    const cv::Point corner(static_cast<int>(at.x), static_cast<int>(at.y));
    on_halo(ink, 2, [&](const cv::Scalar& colour, int broad) {
      cv::putText(picture_, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.8, colour, broad,
                  cv::LINE_AA);
    });
  }
  [[nodiscard]] cv::Size size() const { return picture_.size(); }
  [[nodiscard]] cv::Mat picture() const { return picture_; }

 private:
  /// Draws twice: dark and broader below, so that it shows on any ground.
  template <typename Draw>
  static void on_halo(const Ink& ink, int width, Draw&& draw) {
    draw(halo, width + 2);
    draw(ink.bgr, width);
  }

  cv::Mat picture_;
};

void paint_corners(Painter& painter, const cycle::FixationLook& look) {
  for (const cycle::LookCorner& corner : std::span(look.corners).first(look.corner_count)) {
    const cv::Point2d at = placed(corner.pixel.cast<double>());
    if (corner.used) {
      painter.dot(at, ink::used);
    } else {
      constexpr double arm = 5.0;
      painter.line(at - cv::Point2d(arm, arm), at + cv::Point2d(arm, arm), ink::rejected);
      painter.line(at - cv::Point2d(arm, -arm), at + cv::Point2d(arm, -arm), ink::rejected);
    }
  }
}

/// A diamond, or an arrow at the border that points there and says how far it is.
/// `line` counts the labels of a picture.
void paint_epipole(Painter& painter, const geometry::Pixel& epipole, const std::string& whose,
                   std::size_t line) {
  if (!epipole.allFinite()) return;
  const cv::Point2d at = placed(epipole);
  const cv::Size size = painter.size();
  constexpr double arm = 9.0;
  if (cv::Rect2d(0, 0, size.width, size.height).contains(at)) {
    const std::vector<cv::Point2d> corners{
        {at.x - arm, at.y}, {at.x, at.y - arm}, {at.x + arm, at.y}, {at.x, at.y + arm}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      painter.line(corners[i], corners[(i + 1) % 4], ink::epipole);
    return;
  }
  const cv::Point2d middle(0.5 * size.width, 0.5 * size.height), way = at - middle;
  constexpr double border = 26.0;
  const double share = std::min(way.x == 0.0 ? 1e9 : (middle.x - border) / std::abs(way.x),
                                way.y == 0.0 ? 1e9 : (middle.y - border) / std::abs(way.y));
  const cv::Point2d tip = middle + share * way, along = way / cv::norm(way);
  const cv::Point2d across(-along.y, along.x);
  painter.line(tip - 34.0 * along, tip, ink::epipole);
  painter.line(tip, tip - 12.0 * along + 8.0 * across, ink::epipole);
  painter.line(tip, tip - 12.0 * along - 8.0 * across, ink::epipole);
  // Beside the arrow's root, on the side of the middle, one below the other.
  constexpr double line_height = 28.0, width = 190.0;
  const cv::Point2d root = tip - 34.0 * along;
  const double down = root.y < middle.y ? 1.0 : -1.0;
  const double x =
      std::clamp(root.x < middle.x ? root.x + 12.0 : root.x - width, 8.0, size.width - width);
  const double y = std::clamp(root.y + down * (24.0 + line_height * static_cast<double>(line)),
                              24.0, size.height - 12.0);
  painter.words(whose + base::text("%.0f px", cv::norm(way) / enlarged), {x, y}, ink::epipole);
}

void paint_target(Painter& painter, const geometry::Pixel& pixel, double half_size_px) {
  if (!pixel.allFinite()) return;
  if (std::isfinite(half_size_px)) {
    const double h = half_size_px;
    const std::vector<geometry::Pixel> square{
        pixel + geometry::Pixel(-h, -h), pixel + geometry::Pixel(h, -h),
        pixel + geometry::Pixel(h, h), pixel + geometry::Pixel(-h, h)};
    painter.lines(square, true, ink::patch);
  }
  const cv::Point2d at = placed(pixel);
  for (const cv::Point2d& way :
       {cv::Point2d(1, 0), cv::Point2d(-1, 0), cv::Point2d(0, 1), cv::Point2d(0, -1)}) {
    painter.line(at + 4.0 * way, at + 16.0 * way, ink::target);
  }
}

/// In look 1 the lines of the later looks' points, in a later look that of look 1's: thin, and bold
/// where the target may be.
void paint_epipolar_lines(Painter& painter, const cycle::Fixation& fixation, std::size_t look,
                          double nearest_m) {
  constexpr double as_good_as_there_m = 1e-3;  // almost at the other camera
  for (std::size_t k = 1; k < fixation.look_count; ++k) {
    if (look != 0 && k != look) continue;
    const auto pair = pair_of(fixation, k);
    if (!pair) continue;
    for (const auto& [end_m, width] : {std::pair{as_good_as_there_m, 1}, {nearest_m, 3}}) {
      const PixelLine line = look == 0 ? pair->line_in_first(fixation.looks[k].pixel, end_m)
                                       : pair->line_in_later(fixation.looks.front().pixel, end_m);
      if (line.size() > 1) painter.lines(line, false, ink::line, width);
    }
    const geometry::Pixel epipole = look == 0 ? pair->epipole_in_first() : pair->epipole_in_later();
    paint_epipole(painter, epipole, base::text("look %zu: ", look == 0 ? k + 1 : 1),
                  look == 0 ? k - 1 : 0);
  }
}

}  // namespace

std::vector<const Ink*> all_inks() {
  return {&ink::winner, &ink::outline, &ink::target, &ink::patch,
          &ink::line,   &ink::epipole, &ink::used,   &ink::rejected};
}

cv::Mat painted_look(const ReplayedFixation& replayed, std::size_t look, const Painting& painting) {
  const cycle::Fixation& fixation = replayed.fixation;
  const SeenFrame* frame =
      look < fixation.look_count ? replayed.frame_at(fixation.looks[look].utime_us) : nullptr;
  if (frame == nullptr) return {};
  const cycle::FixationLook& seen = fixation.looks[look];
  Painter painter(frame->bgr);
  paint_corners(painter, seen);
  paint_epipolar_lines(painter, fixation, look, painting.nearest_m);
  if (look == 0) {
    std::vector<geometry::Pixel> outline;
    for (const Eigen::Vector2f& point :
         std::span(fixation.outline.points_px).first(fixation.outline.count)) {
      outline.emplace_back(point.cast<double>());
    }
    painter.lines(outline, true, ink::outline);
  }
  paint_target(painter, seen.pixel, fixation.patch_half_size_px);
  if (frame->seen.saliency > 0.0F) painter.ring(placed(frame->seen.peak_px), 22.0, ink::winner);
  return painter.picture();
}

cv::Mat painted_map(const SeenFrame& frame, double distinctness_min) {
  return io::overlay_of(io::scaled(frame.bgr, enlarged), frame.seen, 1.0 / enlarged,
                        distinctness_min);
}

cv::Mat painted_patches(const ReplayedFixation& replayed) {
  const cycle::Fixation& fixation = replayed.fixation;
  if (!std::isfinite(fixation.patch_half_size_px)) return {};
  constexpr int side = 240;                                  // of a patch as shown
  const double half_px = 1.3 * fixation.patch_half_size_px;  // with a little of its surroundings
  const double scale = side / (2.0 * half_px);
  std::vector<cv::Mat> patches;
  for (std::size_t k = 0; k < fixation.look_count; ++k) {
    const cycle::FixationLook& look = fixation.looks[k];
    const SeenFrame* frame = replayed.frame_at(look.utime_us);
    if (frame == nullptr || !look.pixel.allFinite()) continue;
    const cv::Matx23d frame_from_shown(1.0 / scale, 0.0, look.pixel.x() - 0.5 * (side - 1) / scale,
                                       0.0, 1.0 / scale, look.pixel.y() - 0.5 * (side - 1) / scale);
    cv::Mat shown;
    cv::warpAffine(frame->bgr, shown, frame_from_shown, {side, side},
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                   cv::Scalar(90, 90, 90));
    const double h = fixation.patch_half_size_px * scale, middle = 0.5 * (side - 1);
    cv::rectangle(shown, cv::Rect2d(middle - h, middle - h, 2 * h, 2 * h), ink::patch.bgr, 1,
                  cv::LINE_AA);
    cv::drawMarker(shown, {side / 2, side / 2}, ink::target.bgr, cv::MARKER_CROSS, 14, 1,
                   cv::LINE_AA);
    cv::putText(shown, "look " + std::to_string(k + 1), {8, 22}, cv::FONT_HERSHEY_SIMPLEX, 0.6,
                halo, 4, cv::LINE_AA);
    cv::putText(shown, "look " + std::to_string(k + 1), {8, 22}, cv::FONT_HERSHEY_SIMPLEX, 0.6,
                ink::winner.bgr, 1, cv::LINE_AA);
    cv::copyMakeBorder(shown, shown, 4, 4, 4, 4, cv::BORDER_CONSTANT, cv::Scalar(255, 255, 255));
    patches.push_back(shown);
  }
  cv::Mat all;
  if (!patches.empty()) cv::hconcat(patches, all);
  return all;
}

}  // namespace gazed::lab::explain
