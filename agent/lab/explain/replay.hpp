// A recorded walk once more through the cycle of the daemon, with all that a person wants to see of
// each fixation: what it was made of, and the frames that it was seen in.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "agent/cycle/cycle.hpp"
#include "agent/cycle/fixation.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/saliency/saliency.hpp"
#include "agent/settings/settings.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"

namespace gazed::lab::explain {

/// A frame that a fixation was made of, and what stood out in it.
struct SeenFrame {
  std::int64_t utime_us = 0;
  cv::Mat bgr;
  std::vector<std::uint16_t> map_samples;
  saliency::SaliencyResult seen;  // its map is map_samples

  SeenFrame(std::int64_t utime, cv::Mat picture, const saliency::SaliencyResult& result);
  SeenFrame(SeenFrame&&) noexcept = default;  // a vector that moves keeps its samples' place
  SeenFrame& operator=(SeenFrame&&) noexcept = default;
  SeenFrame(const SeenFrame&) = delete;
  SeenFrame& operator=(const SeenFrame&) = delete;
  ~SeenFrame() = default;
};

struct ReplayedFixation {
  cycle::Fixation fixation;
  std::vector<SeenFrame> frames;  // of its looks, in their order; one where nothing stood out

  /// The frame of a look; null where there is none.
  [[nodiscard]] const SeenFrame* frame_at(std::int64_t utime_us) const;
};

class Replay {
 public:
  /// `settings` name the log as camera and head. Throws std::invalid_argument when there is nothing
  /// to play.
  Replay(const settings::Settings& settings, const std::string& log_file);

  /// The next fixation that counts; none at the end of the recording.
  [[nodiscard]] std::optional<ReplayedFixation> next();
  /// What of the recording was passed over, in words; empty when nothing was.
  [[nodiscard]] std::string notes() const;

 private:
  [[nodiscard]] std::optional<ReplayedFixation> take(cycle::CycleOutput output);
  [[nodiscard]] std::optional<ReplayedFixation> watch_silence(std::int64_t now_us);

  log::LogCamera camera_;
  log::LogHead head_;
  cycle::Cycle cycle_;
  base::Image newest_;  // the frame that was last consumed: the one that any saliency is of
  std::int64_t last_frame_us_, last_state_us_;
  std::vector<SeenFrame> frames_;  // of the fixation that is under way
};

/// The settings that `gazed --camera log:FILE --head log:FILE` would have: the robot and its
/// configuration are the recording's, those of `layers` win. Throws settings::SettingsError.
[[nodiscard]] settings::Settings settings_of(const std::string& log_file,
                                             settings::SettingsLayers layers);

}  // namespace gazed::lab::explain
