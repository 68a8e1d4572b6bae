#include "agent/lab/io/picture_saliency.hpp"

#include <stdexcept>

#include "agent/base/text.hpp"
#include "agent/lab/io/picture.hpp"

namespace gazed::lab::io {

SalientPicture PictureSaliency::examine(const cv::Mat& bgr) {
  SalientPicture out;
  out.scale = working_scale(bgr);
  const cv::Mat working = scaled(bgr, out.scale);
  try {
    if (!saliency_ || working.size() != size_) {
      saliency_.emplace(settings_, working.cols, working.rows);
      size_ = working.size();
    }
    out.seen = saliency_->examine(view_of(rgb_of(working)));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(base::size_text(bgr.cols, bgr.rows) + ", scaled to " +
                                base::size_text(working.cols, working.rows) + ": " + error.what());
  }
  out.winner_px = input_pixel(out.seen.peak_px, out.scale);
  return out;
}

}  // namespace gazed::lab::io
