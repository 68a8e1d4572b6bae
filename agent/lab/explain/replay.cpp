#include "agent/lab/explain/replay.hpp"

#include <algorithm>
#include <utility>

#include "agent/base/utime.hpp"
#include "agent/lab/io/frame_picture.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/log/log_reader.hpp"

namespace gazed::lab::explain {

SeenFrame::SeenFrame(std::int64_t utime, cv::Mat picture, const saliency::SaliencyResult& result)
    : utime_us(utime),
      bgr(std::move(picture)),
      map_samples(result.map.samples.begin(), result.map.samples.end()),
      seen(result) {
  seen.map.samples = map_samples;
}

const SeenFrame* ReplayedFixation::frame_at(std::int64_t utime_us) const {
  const auto found = std::ranges::find(frames, utime_us, &SeenFrame::utime_us);
  return found == frames.end() ? nullptr : &*found;
}

Replay::Replay(const settings::Settings& settings, const std::string& log_file)
    : camera_(log_file, lcm::Channels(settings.lcm), settings.rig.camera.width_px,
              settings.rig.camera.height_px),
      head_(log_file, lcm::Channels(settings.lcm)),
      cycle_(settings.rig, settings.cycle, {.obeys = false}),
      last_frame_us_(
          std::min(camera_.next_utime_us().value_or(0), head_.next_utime_us().value_or(0))),
      last_state_us_(last_frame_us_) {}

// In the order, and with the clock, of the daemon's loop (agent/daemon/loop.cpp) when it plays a
// log.
std::optional<ReplayedFixation> Replay::next() {
  for (;;) {
    const auto head_us = head_.next_utime_us(), camera_us = camera_.next_utime_us();
    if (!head_us && !camera_us) return std::nullopt;
    const bool is_head = head_us && (!camera_us || *head_us <= *camera_us);
    const std::int64_t now_us = is_head ? *head_us : *camera_us;
    cycle::CycleOutput output;
    if (is_head) {
      const auto state = head_.next_state();
      if (state) output = cycle_.on_head_state(*state);
      if (output.consumed) last_state_us_ = now_us;
    } else if (const auto frame = camera_.next_frame()) {
      output = cycle_.on_frame(*frame);
      if (output.consumed) {
        last_frame_us_ = now_us;
        newest_.assign(frame->image);
      }
    }
    if (auto done = take(std::move(output))) return done;
    if (auto done = watch_silence(now_us)) return done;
  }
}

std::optional<ReplayedFixation> Replay::take(cycle::CycleOutput output) {
  if (output.saliency) {
    if (output.saliency->first_view) frames_.clear();  // of one that came to nothing
    frames_.emplace_back(output.saliency->utime_us, io::bgr_of(newest_.view()),
                         output.saliency->result);
  }
  if (!output.fixation || !output.fixation->counts) return std::nullopt;
  return ReplayedFixation{*std::move(output.fixation), std::exchange(frames_, {})};
}

std::optional<ReplayedFixation> Replay::watch_silence(std::int64_t now_us) {
  return take(cycle_.on_silence({.camera_s = base::seconds_between(last_frame_us_, now_us),
                                 .head_s = base::seconds_between(last_state_us_, now_us),
                                 .camera_fault = {},
                                 .head_fault = {},
                                 .now_s = 1e-6 * static_cast<double>(now_us)}));
}

std::string Replay::notes() const {
  const std::string camera = camera_.notes(), head = head_.notes();
  if (head.empty() || head == camera) return camera;
  return camera + (camera.empty() ? "" : "; ") + head;
}

settings::Settings settings_of(const std::string& log_file, settings::SettingsLayers layers) {
  for (const char* key : {"camera.source", "head.source"}) {
    layers.command_line.push_back({key, "log:" + log_file, "WALK.lcm"});
  }
  return settings::load_settings(layers, {},  // no scene: the camera is the log
                                 [](const std::string& file, const std::string& prefix) {
                                   return log::recorded_configuration(file, prefix);
                                 });
}

}  // namespace gazed::lab::explain
