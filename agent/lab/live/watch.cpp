#include "agent/lab/live/watch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <opencv2/highgui.hpp>
#include <stdexcept>
#include <vector>
#include <xcb/xcb.h>

#include "agent/base/text.hpp"
#include "agent/lab/io/findings.hpp"
#include "agent/lab/io/output_files.hpp"
#include "agent/lab/io/overlay.hpp"
#include "agent/lab/io/picture_saliency.hpp"
#include "agent/lab/live/frame_rate.hpp"

namespace gazed::lab::live {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* window = "gazelab saliency";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// OpenCV's window ends the program where its X server is not there. Held until the window is: a
/// server whose last client leaves begins anew, and takes nobody meanwhile.
class Display {
 public:
  /// Throws std::invalid_argument.
  Display() : connection_(xcb_connect(nullptr, nullptr)) {  // of DISPLAY
    if (xcb_connection_has_error(connection_.get()) == 0) return;
    const char* display = std::getenv("DISPLAY");
    throw std::invalid_argument(
        "there is no display for a window (DISPLAY is " +
        (display == nullptr ? std::string("not set") : "'" + base::excerpt(display) + "'") +
        "): say --csv FILE or --overlay DIR");
  }

 private:
  struct Disconnect {
    void operator()(xcb_connection_t* connection) const { xcb_disconnect(connection); }
  };
  std::unique_ptr<xcb_connection_t, Disconnect> connection_;  // never null
};

/// At the frame's size, and to be resized.
void open_window(cv::Size size) {
  cv::namedWindow(window, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO | cv::WINDOW_GUI_NORMAL);
  cv::resizeWindow(window, size);
}

/// Shows a picture for as long as its frame lasts. False when whoever watches has had enough.
bool show(const cv::Mat& picture, double pace, double since_the_last_s) {
  cv::imshow(window, picture);
  const double left_s = pace > 0.0 ? 1.0 / pace - since_the_last_s : 0.0;
  const int key = cv::waitKey(std::max(1, static_cast<int>(std::lround(1e3 * left_s))));
  constexpr int escape = 27;
  return key != 'q' && key != escape && cv::getWindowProperty(window, cv::WND_PROP_VISIBLE) >= 1.0;
}

/// How it went, in a line.
void tell(const Frames& frames, std::int64_t count, double passed_s, double saliency_s) {
  const auto all = static_cast<double>(count);
  std::fprintf(stderr, "%s: %lld frames, %.1f a second, saliency %.1f ms each\n",
               frames.name().c_str(), static_cast<long long>(count), all / passed_s,
               1e3 * saliency_s / all);
}

}  // namespace

void watch(Frames& frames, const WatchOptions& options) {
  const bool has_window = options.csv.empty() && options.overlays.empty();
  std::optional<Display> display;
  if (has_window) display.emplace();
  io::make_folder(options.overlays);
  std::optional<io::FindingsWriter> rows;
  if (!options.csv.empty()) {
    rows.emplace(options.csv, std::vector{frames.name()}, options.settings.distinctness_min);
  }
  io::PictureSaliency saliency(options.settings);
  FrameRate rate;
  std::int64_t count = 0;
  double saliency_s = 0.0;
  const Clock::time_point start = Clock::now();
  Clock::time_point last = start;
  bool goes_on = true;
  while (goes_on && (!options.frames || count < *options.frames)) {
    const cv::Mat frame = frames.next();
    if (frame.empty()) break;
    if (has_window && count == 0) open_window(frame.size());
    ++count;
    rate.saw(seconds_since(start));
    const Clock::time_point before = Clock::now();
    const io::SalientPicture salient = saliency.examine(frame);
    const double took_s = seconds_since(before);
    saliency_s += took_s;
    const std::string number =
        base::text("%s#%06lld", frames.name().c_str(), static_cast<long long>(count));
    if (rows) {
      rows->add({.image = number,
                 .winner_px = salient.winner_px,
                 .saliency = salient.seen.saliency,
                 .distinctness = salient.seen.distinctness});
    }
    if (rows && options.overlays.empty()) continue;
    const cv::Mat overlay =
        io::overlay_of(frame, salient.seen, salient.scale, options.settings.distinctness_min,
                       base::text("%.1f frames/s, %.1f ms", rate.per_second(), 1e3 * took_s));
    if (!options.overlays.empty()) {
      io::write_png(options.overlays / base::text("%06lld.png", static_cast<long long>(count)),
                    overlay);
    }
    if (has_window) goes_on = show(overlay, frames.pace(), seconds_since(last));
    last = Clock::now();
  }
  if (rows) rows->finish();
  if (count == 0) throw std::runtime_error(frames.name() + ": no frame came");
  tell(frames, count, seconds_since(start), saliency_s);
}

}  // namespace gazed::lab::live
