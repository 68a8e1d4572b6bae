#include "drivers/naoqi/naoqi_camera.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <unistd.h>
#include <utility>
#include <variant>

#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

enum VideoMethod : std::size_t {
  subscribe_camera,
  get_image,
  release_image,
  unsubscribe,
  unsubscribe_all,
  get_subscribers,
};
// QiLoop, video_device.qi.idl; unsubscribe_all also removes the numbered names.
constexpr std::array<QiMethod, 6> video_methods{{{"subscribeCamera", "(siiii)"},
                                                 {"getImageRemote", "(s)"},
                                                 {"releaseImage", "(s)"},
                                                 {"unsubscribe", "(s)"},
                                                 {"unsubscribeAllInstances", "(s)", false},
                                                 {"getSubscribers", "()", false}}};

constexpr int frames_per_second = 30;
constexpr std::int64_t image_period_us = 1'000'000 / frames_per_second;
// If the last answer was an old image, the next one is due within a period; poll again after this
// time.
constexpr std::int64_t same_image_us = 5'000;
constexpr std::int64_t subscribe_again_us = 500'000;
constexpr std::chrono::milliseconds unsubscribed_within{300};
// If both clocks are this computer's, the youngest of the first images is at most this old. Stamps
// of another clock are usually much farther off, even through a tunnel that ends on this computer.
constexpr std::int64_t oldest_us = 200'000;
constexpr std::int64_t ahead_us = 10'000;
constexpr int first_images = 10;

struct Resolution {
  int width_px, height_px, number;
};
// naoqi_driver, alvisiondefinitions.h. Larger ones exceed the maximum message size.
constexpr std::array<Resolution, 4> resolutions{
    {{160, 120, 0}, {320, 240, 1}, {640, 480, 2}, {1280, 960, 3}}};

int resolution_of(int width_px, int height_px) {
  for (const Resolution& known : resolutions)
    if (known.width_px == width_px && known.height_px == height_px) return known.number;
  throw std::invalid_argument(
      base::text("camera naoqi: %dx%d px found; allowed: 160x120, 320x240, 640x480, 1280x960",
                 width_px, height_px));
}

/// Differs between computers and survives restarts; robots often share a host name. It is not the
/// machine id itself, which is confidential (machine-id(5)).
std::string digits_of_this_computer() {
  std::string id;
  std::ifstream("/etc/machine-id") >> id;
  return base::text("%04x", static_cast<unsigned>(std::hash<std::string>()(id) % 0x10000U));
}

std::string subscriber_name(geometry::CameraPosition position) {
  std::array<char, 65> host{};  // zero-terminated even if the name is cut off
  gethostname(host.data(), host.size() - 1);
  std::string name = std::string("gazed_") + host.data() + '_' + digits_of_this_computer() +
                     (position == geometry::CameraPosition::top ? "_top" : "_bottom");
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

}  // namespace

NaoqiCamera::NaoqiCamera(NaoqiCameraSettings settings, drivers::Clocks clocks)
    : settings_(std::move(settings)),
      clocks_(std::move(clocks)),
      video_(wake_up_, settings_.robot, "ALVideoDevice", video_methods),
      resolution_(resolution_of(settings_.width_px, settings_.height_px)),
      name_(subscriber_name(settings_.position)) {}

NaoqiCamera::~NaoqiCamera() {
  ending_ = true;
  await_answers(wake_up_, unsubscribed_within, [this] {
    if (subscribed_) start_over(drivers::HealthKind::lost, "ended");
    video_.serve(clocks_.monotonic_us());
    return !subscribed_ && !(video_.ready() && video_.busy());
  });
}

std::optional<geometry::Frame> NaoqiCamera::next_frame() {
  frame_.reset();
  serve();
  return frame_;
}

void NaoqiCamera::serve() {
  const std::int64_t now_us = clocks_.monotonic_us();
  video_.serve(now_us);
  if (!video_.ready()) {
    handle_.clear();
    subscribing_ = image_asked_ = false;
    subscribe_us_ = 0;
    images_ = 0;
  } else if (handle_.empty()) {
    if (!subscribing_ && now_us >= subscribe_us_) subscribe();
  } else if (now_us - new_image_us_ > std::llround(1e6 * settings_.timing.timeout_s)) {
    start_over(drivers::HealthKind::no_data,
               base::text("no new image for %.1f s", settings_.timing.timeout_s) +
                   (refused_.empty() ? "" : "; the last answer: " + refused_));
  } else if (!image_asked_ && now_us >= image_us_) {
    ask_image();
  }
  std::int64_t due_us = video_.due_us();
  if (!handle_.empty() && !image_asked_) due_us = std::min(due_us, image_us_);
  if (video_.ready() && handle_.empty() && !subscribing_) due_us = std::min(due_us, subscribe_us_);
  wake_up_.at(due_us);
}

void NaoqiCamera::subscribe() {
  subscribing_ = true;
  // One call at a time: a robot may answer calls in any order.
  if (video_.has(unsubscribe_all)) {
    QiWriter name;
    video_.call(unsubscribe_all, name.text(name_).bytes(),
                [this](const QiResult&) { subscribe_anew(); });
  } else if (video_.has(get_subscribers)) {
    video_.call(get_subscribers, {}, [this](const QiResult& result) {
      unsubscribe_left_over(result);
      subscribe_anew();
    });
  } else {
    subscribe_anew();
  }
}

void NaoqiCamera::unsubscribe_left_over(const QiResult& subscribers) {
  // one call per name; ALVideoDevice allows six subscriptions per name
  constexpr int names_max = 64;
  QiReader names = subscribers.value.elements();
  for (int i = 0; i < names_max; ++i) {
    const auto name = names.next().text();
    if (name && name->starts_with(name_))
      video_.call(unsubscribe, QiWriter().text(*name).bytes(), [](const QiResult&) {});
  }
}

void NaoqiCamera::subscribe_anew() {
  if (ending_) return;
  QiWriter arguments;
  arguments.text(name_).u32(settings_.position == geometry::CameraPosition::top ? 0 : 1);
  arguments.u32(static_cast<std::uint32_t>(resolution_)).u32(naoqi_yuv422).u32(frames_per_second);
  video_.call(subscribe_camera, arguments.bytes(),
              [this](const QiResult& result) { on_subscribed(result); });
}

void NaoqiCamera::on_subscribed(const QiResult& result) {
  subscribing_ = false;
  const auto handle = result.value.text();
  if (!handle || handle->empty()) {
    start_over(drivers::HealthKind::lost,
               "it cannot be subscribed: " + base::excerpt(result.error));
    return;
  }
  handle_ = *handle;
  handle_argument_ = QiWriter().text(handle_);
  subscribed_ = true;
  image_us_ = new_image_us_ = clocks_.monotonic_us();
}

void NaoqiCamera::ask_image() {
  image_asked_ = true;
  image_us_ = clocks_.monotonic_us() + image_period_us;
  video_.call(get_image, handle_argument_.bytes(),
              [this](const QiResult& result) { on_image(result); });
}

void NaoqiCamera::on_image(const QiResult& result) {
  image_asked_ = false;
  if (handle_.empty()) return;  // given up in the meantime
  video_.call(release_image, handle_argument_.bytes(), [](const QiResult&) {});
  const auto image = read_image(result, settings_.width_px, settings_.height_px);
  if (const auto* why = std::get_if<std::string>(&image)) {
    ++unusable_;
    fault_ = drivers::HealthKind::refused;
    fault_words_ = refused_ = *why;
    // No answer may mean that the video device has restarted and no longer knows the name.
    if (!result.value) start_over(drivers::HealthKind::refused, *why);
    return;
  }
  const NaoqiImage& found = std::get<NaoqiImage>(image);
  if (found.stamp_us == std::exchange(stamp_us_, found.stamp_us)) {
    image_us_ = clocks_.monotonic_us() + same_image_us;
    return;
  }
  new_image_us_ = clocks_.monotonic_us();
  fault_ = drivers::HealthKind::ok;
  refused_.clear();
  if (const auto time_us = time_of(found.stamp_us)) {
    frame_ = geometry::Frame{found.image, *time_us + std::llround(1e6 * settings_.timing.delay_s)};
  } else {
    ++unusable_;
  }
}

std::optional<std::int64_t> NaoqiCamera::time_of(std::int64_t stamp_us) {
  const std::int64_t now_us = clocks_.realtime_us();
  const std::int64_t age_us = now_us - stamp_us;
  if (images_ < first_images) {
    least_age_us_ = images_ == 0 ? age_us : std::min(least_age_us_, age_us);
    ++images_;
  }
  const bool same_clock = settings_.robot.directory.is_this_computer() &&
                          least_age_us_ >= -ahead_us && least_age_us_ <= oldest_us;
  return same_clock ? stamp_us : robot_clock_.here_us(stamp_us, now_us);
}

void NaoqiCamera::start_over(drivers::HealthKind fault, const std::string& why) {
  fault_ = fault;
  fault_words_ = why;
  subscribe_us_ = clocks_.monotonic_us() + subscribe_again_us;
  handle_.clear();
  if (!subscribed_ || !video_.ready()) return;
  subscribed_ = false;
  video_.call(unsubscribe, handle_argument_.bytes(), [](const QiResult&) {});
}

drivers::Health NaoqiCamera::health() const {
  drivers::Health health{.dropped = unusable_};
  health.add(drivers::HealthKind::lost, video_.fault());
  if (health.ok() && fault_ != drivers::HealthKind::ok)
    health.add(fault_, "ALVideoDevice: " + fault_words_);
  return health;
}

}  // namespace gazed::naoqi
