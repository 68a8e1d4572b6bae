#include "agent/lab/io/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "agent/lab/io/picture.hpp"

namespace gazed::lab::io {

namespace {

// Sizes of strokes and letters are those on a picture with a longer side of 640; they grow with the
// picture, and shrink with it as far as they can be read.
double stroke_unit(const cv::Mat& picture) {
  return std::max(0.75, std::max(picture.cols, picture.rows) / 640.0);
}

/// The map at every pixel of the photograph, 32FC1, 0 to 1.
cv::Mat heat_of(const saliency::SaliencyMap& map, double scale, cv::Size size) {
  cv::Mat samples(map.height, map.width, CV_16UC1);
  std::copy(map.samples.begin(), map.samples.end(), samples.begin<std::uint16_t>());
  const double peak = std::max<double>(1.0, *std::ranges::max_element(map.samples));
  samples.convertTo(samples, CV_32F, 1.0 / peak);

  // Pixel p of the photograph lies at ((p + 0.5) s - 0.5) / 16 in the map.
  const double step = scale / saliency::saliency_cell_px;
  const double offset = (0.5 * scale - 0.5) / saliency::saliency_cell_px;
  const cv::Matx23d map_from_photograph(step, 0.0, offset, 0.0, step, offset);
  cv::Mat heat;
  cv::warpAffine(samples, heat, map_from_photograph, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return cv::min(cv::max(heat, 0.0), 1.0);
}

/// Heat in the colours of "inferno", which a colour-blind eye orders as well; nothing covers the
/// photograph where there is no heat.
void paint_heat(cv::Mat& picture, const cv::Mat& heat) {
  constexpr float dimming = 0.65F;        // of the photograph, so that the heat shines
  constexpr float greatest_cover = 0.8F;  // of the heat where it is greatest
  cv::Mat levels;
  heat.convertTo(levels, CV_8U, 255.0);
  cv::Mat colours;
  cv::applyColorMap(levels, colours, cv::COLORMAP_INFERNO);
  for (int y = 0; y < picture.rows; ++y) {
    auto* pixel = picture.ptr<cv::Vec3b>(y);
    const auto* colour = colours.ptr<cv::Vec3b>(y);
    const auto* h = heat.ptr<float>(y);
    for (int x = 0; x < picture.cols; ++x) {
      const float cover = greatest_cover * h[x];
      for (int c = 0; c < 3; ++c) {
        pixel[x][c] = cv::saturate_cast<std::uint8_t>(dimming * static_cast<float>(pixel[x][c]) *
                                                          (1.0F - cover) +
                                                      cover * static_cast<float>(colour[x][c]));
      }
    }
  }
}

/// Twice each stroke, a broad dark one under a narrow bright one: it shows on any background.
void paint_winner(cv::Mat& picture, const geometry::Pixel& winner_px) {
  constexpr int fraction_bits = 4;
  const double unit = stroke_unit(picture);
  const auto fixed = [](double value) {
    return static_cast<int>(std::lround(value * (1 << fraction_bits)));
  };
  const auto at = [&](double dx, double dy) {
    return cv::Point(fixed(winner_px.x() + dx * unit), fixed(winner_px.y() + dy * unit));
  };
  const auto paint = [&](const cv::Scalar& colour, double width) {
    const int thickness = std::max(1, static_cast<int>(std::lround(width * unit)));
    const auto arms = [&](double from, double to) {
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        cv::line(picture, at(from * dx, from * dy), at(to * dx, to * dy), colour, thickness,
                 cv::LINE_AA, fraction_bits);
      }
    };
    constexpr double radius = 24.0;
    cv::circle(picture, at(0, 0), fixed(radius * unit), colour, thickness, cv::LINE_AA,
               fraction_bits);
    arms(18.0, 34.0);  // through the ring
    arms(0.0, 5.0);    // the winner itself; what it stands on is left to be seen
  };
  paint(cv::Scalar(0, 0, 0), 5.0);
  paint(cv::Scalar(255, 255, 255), 2.0);
}

std::string caption_of(const OverlayLabels& labels) {
  char text[120];
  const bool distinct = labels.distinctness >= labels.distinctness_min;
  std::snprintf(text, sizeof text, "saliency %.2f   distinctness %.2f   %s (threshold %.2f)",
                static_cast<double>(labels.saliency), static_cast<double>(labels.distinctness),
                distinct ? "stands out" : "no salient object", labels.distinctness_min);
  return labels.more.empty() ? std::string(text) : text + ("   " + labels.more);
}

/// A thin dark band with the caption at the edge that is farther from the winner.
void paint_caption(cv::Mat& picture, const OverlayLabels& labels) {
  constexpr int font_face = cv::FONT_HERSHEY_SIMPLEX;
  const double unit = stroke_unit(picture);
  const std::string caption = caption_of(labels);
  const int band = static_cast<int>(std::lround(22.0 * unit));
  const int margin = static_cast<int>(std::lround(8.0 * unit));
  const int thickness = std::max(1, static_cast<int>(unit));
  double font = 0.45 * unit;
  int baseline = 0;
  const int room = picture.cols - 2 * margin;
  const int width = cv::getTextSize(caption, font_face, font, thickness, &baseline).width;
  if (width > room) font *= static_cast<double>(room) / width;

  const bool at_top = labels.winner_px.y() > picture.rows / 2.0;
  const int top = at_top ? 0 : picture.rows - band;
  cv::Mat strip = picture(cv::Rect(0, top, picture.cols, band));
  strip.convertTo(strip, -1, 0.25);
  const int height = cv::getTextSize(caption, font_face, font, thickness, &baseline).height;
  cv::putText(picture, caption, cv::Point(margin, top + (band + height) / 2), font_face, font,
              cv::Scalar(240, 240, 240), thickness, cv::LINE_AA);
}

}  // namespace

cv::Mat overlay_of(const cv::Mat& photograph, const saliency::SaliencyMap& map, double scale,
                   const OverlayLabels& labels) {
  cv::Mat picture = photograph.clone();
  paint_heat(picture, heat_of(map, scale, picture.size()));
  paint_winner(picture, labels.winner_px);
  paint_caption(picture, labels);
  return picture;
}

cv::Mat overlay_of(const cv::Mat& photograph, const saliency::SaliencyResult& seen, double scale,
                   double distinctness_min, const std::string& more) {
  return overlay_of(photograph, seen.map, scale,
                    {.winner_px = input_pixel(seen.peak_px, scale),
                     .saliency = seen.saliency,
                     .distinctness = seen.distinctness,
                     .distinctness_min = distinctness_min,
                     .more = more});
}

}  // namespace gazed::lab::io
