// How well a map tells where people looked.
//
// A fixation is a cell of the map (column, row) that somebody looked at; several may fall into one
// cell and then count as often. All maps here are CV_64F.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace gazed::benchmarks {

/// The size at which maps are scored: 8 px of a 640x480 frame a cell.
inline const cv::Size scored_size(80, 60);

/// `map`, whose sample (0, 0) is centred on pixel (0, 0) and whose samples are 16 px apart, at
/// scored_size: bilinear at the cells' centres, clamped at the last sample. The frame is 640x480.
[[nodiscard]] cv::Mat at_scored_size(const cv::Mat& map);

/// The area under the ROC curve: the share of pairs of a positive and a negative in which the
/// positive is higher, ties count half (Mann and Whitney 1947). NaN when either is empty.
[[nodiscard]] double area_under_curve(std::vector<double> positives, std::vector<double> negatives);

/// Normalised scanpath saliency: the mean over the fixations of (map - mean) / standard deviation
/// (Peters, Iyer, Itti, Koch 2005). 0 for a map without contrast, NaN without fixations.
[[nodiscard]] double nss(const cv::Mat& map, std::span<const cv::Point> fixations);

/// AUC-J (Judd, Durand, Torralba 2012): cells that were looked at against all other cells.
[[nodiscard]] double auc_judd(const cv::Mat& map, std::span<const cv::Point> fixations);

/// Shuffled AUC (Tatler, Baddeley, Gilchrist 2005; Zhang et al. 2008): fixations against those of
/// other pictures, which share the preference for the centre. All of the others are taken, so this
/// is what random draws from them have as their mean.
[[nodiscard]] double shuffled_auc(const cv::Mat& map, std::span<const cv::Point> fixations,
                                  std::span<const cv::Point> of_other_pictures);

}  // namespace gazed::benchmarks
