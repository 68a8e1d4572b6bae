// camera_control DEVICE NAME[=VALUE]: sets a control of a V4L2 device by its name; a button, which
// has no value, is pressed. The emulated robot's camera has its error injection there.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <string_view>
#include <sys/ioctl.h>

namespace {

// The control's identifier; 0 when the device has none of this name.
__u32 control_named(int device, std::string_view name) {
  v4l2_queryctrl control{};
  control.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (ioctl(device, VIDIOC_QUERYCTRL, &control) == 0) {
    if (name == reinterpret_cast<const char*>(control.name)) return control.id;
    control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("camera_control DEVICE NAME[=VALUE]\n", stderr);
    return 2;
  }
  const std::string_view setting = argv[2];
  const std::string_view name = setting.substr(0, setting.find('='));
  int value = 0;
  if (name.size() < setting.size())
    std::from_chars(name.data() + name.size() + 1, setting.data() + setting.size(), value);

  const int device = open(argv[1], O_RDWR | O_NONBLOCK);
  if (device < 0) {
    std::perror(argv[1]);
    return 1;
  }
  v4l2_control control{control_named(device, name), value};
  if (control.id == 0) {
    std::fprintf(stderr, "%s has no control '%s'\n", argv[1], argv[2]);
    return 1;
  }
  if (ioctl(device, VIDIOC_S_CTRL, &control) != 0) {
    std::perror(argv[2]);
    return 1;
  }
  return 0;
}
