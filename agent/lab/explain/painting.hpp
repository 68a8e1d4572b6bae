// Looks as pictures: the frame with what gazed found in it.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "agent/lab/explain/replay.hpp"

namespace gazed::lab::explain {

/// What is drawn, by its colour: for eyes of every kind (Okabe and Ito, Color Universal Design,
/// 2008), and each with a shape of its own.
struct Ink {
  std::string_view what;
  std::string_view html;  // "#e69f00"
  cv::Scalar bgr;
};

namespace ink {
inline const Ink winner{"ring: the winner of the saliency map", "#ffffff", {255, 255, 255}};
inline const Ink outline{"contour: the outline of the target", "#e69f00", {0, 159, 230}};
inline const Ink target{"cross: the target's point, as it was found", "#f0e442", {66, 228, 240}};
inline const Ink patch{"square: the patch that is found again", "#0072b2", {178, 114, 0}};
inline const Ink line{
    "line: the epipolar line of the other look's pixel; bold: where the target may be",
    "#56b4e9",
    {233, 180, 86}};
inline const Ink epipole{
    "diamond: the epipole, where the other camera stood; an arrow where that is out of sight",
    "#cc79a7",
    {167, 121, 204}};
inline const Ink used{"dot: a corner of the background that was used", "#009e73", {115, 158, 0}};
inline const Ink rejected{
    "x: a corner that was not used: not found again, or rejected", "#d55e00", {0, 94, 213}};
}  // namespace ink

/// In the order of a legend.
[[nodiscard]] std::vector<const Ink*> all_inks();

/// What is seen at the nearest at this range, metres: epipolar lines end there.
struct Painting {
  double nearest_m = 0.1;
};

/// The frame of a look, `look` counting from 0, enlarged twice, with everything over it. Its
/// fixation may have ended in any way. Empty where the look has no frame.
[[nodiscard]] cv::Mat painted_look(const ReplayedFixation& replayed, std::size_t look,
                                   const Painting& painting);

/// The saliency map as heat over the frame, with its winner.
[[nodiscard]] cv::Mat painted_map(const SeenFrame& frame, double distinctness_min);

/// The patch in every look that found it, side by side and enlarged, each numbered; empty where no
/// look did.
[[nodiscard]] cv::Mat painted_patches(const ReplayedFixation& replayed);

}  // namespace gazed::lab::explain
