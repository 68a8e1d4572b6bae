#include "drivers/v4l2/controls.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <initializer_list>
#include <linux/usb/video.h>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>
#include <optional>
#include <span>

#include "agent/base/text.hpp"

namespace gazed::v4l2 {

namespace {

// The NAO V6's cameras: a unit with selectors of the manufacturer's own (B-Human 2024,
// NaoCamera.cpp).
constexpr std::uint8_t nao_v6_unit = 3;
constexpr std::uint8_t vertical_flip_selector = 0x0C;
constexpr std::uint8_t horizontal_flip_selector = 0x0D;

using Ids = std::initializer_list<std::uint32_t>;

class ControlSetter {
 public:
  ControlSetter(const VideoDevice& device, std::vector<std::string>& problems)
      : device_(device), problems_(problems) {}

  /// Sets the first of `ids` that the camera has.
  void set(const char* key, Ids ids, int value) {
    if (const auto control = first_of(key, ids, true)) set(key, *control, value);
  }

  /// Sets an automatic function. Where it was not `asked` for in so many words, a camera without it
  /// is as good.
  void set_automatic(const char* key, std::uint32_t id, bool on, bool asked = true) {
    const auto control = first_of(key, {id}, asked);
    if (!control) return;
    set(key, *control, id == V4L2_CID_EXPOSURE_AUTO ? exposure_mode(*control, on) : int{on});
  }

  /// For a flip that is not wanted, a camera without flips is just as good.
  void set_flip(const char* key, std::uint32_t id, bool on) {
    if (const auto control = first_of(key, {id}, on)) set(key, *control, int{on});
  }

  void set_by_extension_unit(const char* key, std::uint8_t selector, bool on) {
    // The kernel takes a value of exactly the length that the unit names.
    std::array<std::uint8_t, 2> length{};
    std::array<std::uint8_t, 8> value{};
    int error = query_extension(UVC_GET_LEN, selector, length);
    const std::size_t size = length[0] + 256U * length[1];
    if (error == 0 && (size == 0 || size > value.size()))
      return report(
          key, base::text("extension unit: a value of %zu bytes found; allowed: 1 to 8", size));
    const std::span<std::uint8_t> bytes = std::span(value).first(size);
    value[0] = on ? 1 : 0;
    if (error == 0) error = query_extension(UVC_SET_CUR, selector, bytes);
    if (error == 0) error = query_extension(UVC_GET_CUR, selector, bytes);
    if (error != 0) return report(key, "extension unit: " + camera_error(error));
    if ((value[0] != 0) != on) report(key, base::text("extension unit: it took %d", value[0]));
  }

  void report(const char* key, const std::string& what) {
    problems_.push_back(base::text("camera.controls.%s: %s", key, what.c_str()));
  }

 private:
  [[nodiscard]] int query_extension(std::uint8_t what, std::uint8_t selector,
                                    std::span<std::uint8_t> data) const {
    uvc_xu_control_query query{};
    query.unit = nao_v6_unit;
    query.selector = selector;
    query.query = what;
    query.size = static_cast<std::uint16_t>(data.size());
    query.data = data.data();
    return device_.request(UVCIOC_CTRL_QUERY, query);
  }

  /// None where the camera has none of them, which is a problem where one is `needed`, or where it
  /// cannot tell, which always is one: a control that is there would stay as it is.
  [[nodiscard]] std::optional<v4l2_queryctrl> first_of(const char* key, Ids ids, bool needed) {
    for (const std::uint32_t id : ids) {
      v4l2_queryctrl control{};
      control.id = id;
      const int error = device_.request(VIDIOC_QUERYCTRL, control);
      if (error == 0 && (control.flags & V4L2_CTRL_FLAG_DISABLED) == 0) return control;
      // No such control, or none at all (Linux, userspace-api/media/v4l/vidioc-queryctrl).
      if (error != 0 && error != EINVAL && error != ENOTTY) {
        report(key,
               "the camera does not say whether it has such a control: " + camera_error(error));
        return std::nullopt;
      }
    }
    if (needed) report(key, "the camera has no such control");
    return std::nullopt;
  }

  /// The control is a menu in V4L2. Cameras that adapt offer one of two automatic modes, those with
  /// a fixed aperture mostly the third; older drivers have a mere switch.
  [[nodiscard]] int exposure_mode(const v4l2_queryctrl& control, bool on) const {
    if (control.maximum <= 1 && control.type != V4L2_CTRL_TYPE_MENU) return on ? 1 : 0;
    if (!on) return V4L2_EXPOSURE_MANUAL;
    v4l2_querymenu item{};
    item.id = control.id;
    item.index = V4L2_EXPOSURE_APERTURE_PRIORITY;
    return device_.request(VIDIOC_QUERYMENU, item) == 0 ? V4L2_EXPOSURE_APERTURE_PRIORITY
                                                        : V4L2_EXPOSURE_AUTO;
  }

  void set(const char* key, const v4l2_queryctrl& control, int value) {
    // In 64 bits: a camera may name any two ends.
    const std::int64_t above_minimum = std::int64_t{value} - control.minimum;
    if (above_minimum < 0 || value > control.maximum ||
        (control.step > 1 && above_minimum % control.step != 0)) {
      return report(key, base::text("%d found; the camera allows %d to %d in steps of %d", value,
                                    control.minimum, control.maximum, control.step));
    }
    v4l2_control wish{control.id, value};
    if (const int error = device_.request(VIDIOC_S_CTRL, wish); error != 0)
      return report(key,
                    base::text("%d found; the camera refuses it: ", value) + camera_error(error));
    if (wish.value != value)
      report(key, base::text("%d found; the camera took %d", value, wish.value));
  }

  const VideoDevice& device_;
  std::vector<std::string>& problems_;
};

/// An automatic function and the value that it chooses.
struct Pair {
  const char* automatic_key = nullptr;
  std::uint32_t automatic_id = 0;
  std::optional<bool> automatic;
  const char* value_key = nullptr;
  Ids value_ids;
  std::optional<int> value;
};

void set_pair(ControlSetter& setter, const Pair& pair) {
  if (pair.automatic || pair.value) {
    setter.set_automatic(pair.automatic_key, pair.automatic_id, pair.automatic.value_or(false),
                         pair.automatic.has_value());
  }
  if (!pair.value) return;
  if (pair.automatic.value_or(false)) {
    setter.report(pair.value_key, base::text("%d found; it has no effect while %s is true",
                                             *pair.value, pair.automatic_key));
    return;
  }
  setter.set(pair.value_key, pair.value_ids, *pair.value);
}

}  // namespace

ControlsSet set_controls(const VideoDevice& device, const CameraControls& controls,
                         bool flips_by_extension_unit) {
  ControlsSet result;
  ControlSetter setter(device, result.problems);
  // V6 has the exposure in absolute units, V4 and V5 in their own (B-Human 2017 and 2024,
  // NaoCamera.cpp).
  set_pair(setter, {"auto_exposure",
                    V4L2_CID_EXPOSURE_AUTO,
                    controls.auto_exposure,
                    "exposure",
                    {V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_EXPOSURE},
                    controls.exposure});
  set_pair(setter,
           {"gain", V4L2_CID_AUTOGAIN, std::nullopt, "gain", {V4L2_CID_GAIN}, controls.gain});
  set_pair(setter, {"auto_white_balance",
                    V4L2_CID_AUTO_WHITE_BALANCE,
                    controls.auto_white_balance,
                    "white_balance",
                    {V4L2_CID_WHITE_BALANCE_TEMPERATURE},
                    controls.white_balance});
  set_pair(setter, {"auto_focus",
                    V4L2_CID_FOCUS_AUTO,
                    controls.auto_focus,
                    "focus",
                    {V4L2_CID_FOCUS_ABSOLUTE},
                    controls.focus});
  const auto flip = [&](const char* key, const std::optional<bool>& on, std::uint32_t id,
                        std::uint8_t selector) {
    if (!on) return;
    const std::size_t problems_before = result.problems.size();
    if (flips_by_extension_unit) {
      setter.set_by_extension_unit(key, selector, *on);
    } else {
      setter.set_flip(key, id, *on);
    }
    if (result.problems.size() == problems_before) return;
    result.fault =
        result.problems.back() + "; the picture would be the wrong way round (false: it is not)";
    result.problems.pop_back();
  };
  flip("flip_horizontal", controls.flip_horizontal, V4L2_CID_HFLIP, horizontal_flip_selector);
  flip("flip_vertical", controls.flip_vertical, V4L2_CID_VFLIP, vertical_flip_selector);
  return result;
}

}  // namespace gazed::v4l2
