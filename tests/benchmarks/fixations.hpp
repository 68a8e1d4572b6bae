// Where people looked, from the CSV of the OSIE data set.
#pragma once

#include <istream>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace gazed::benchmarks {

/// Fixated cells at scored_size, by picture.
using Fixations = std::map<std::string, std::vector<cv::Point>>;

/// Reads rows image,subject,order,x_px,y_px,duration_ms under that header; x and y in pictures of
/// 800x600. Everybody's first fixation (order 1) is dropped: it is where the fixation cross was.
/// Throws std::runtime_error with the line's number and what was found there.
[[nodiscard]] Fixations read_fixations(std::istream& csv);

/// The fixations of all pictures but `picture`.
[[nodiscard]] std::vector<cv::Point> fixations_elsewhere(const Fixations& fixations,
                                                         const std::string& picture);

}  // namespace gazed::benchmarks
