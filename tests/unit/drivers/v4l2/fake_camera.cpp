#include "tests/unit/drivers/v4l2/fake_camera.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <linux/usb/video.h>
#include <linux/uvcvideo.h>
#include <tuple>

namespace gazed::v4l2 {

namespace {

constexpr std::uint32_t offset_step = 1U << 24;  // between the buffers, more than any is long

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

}  // namespace

FakeCamera::FakeCamera() {
  std::strcpy(reinterpret_cast<char*>(capability.driver), "fake");
  std::strcpy(reinterpret_cast<char*>(capability.card), "Fake camera");
  capability.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  formats = {{V4L2_PIX_FMT_YUYV, {{640, 480}, {320, 240}}}};
}

VideoSystem FakeCamera::system() {
  return {.open = [this](const char* device) { return open(device); },
          .close = [this](int descriptor) { return close(descriptor); },
          .ioctl = [this](int descriptor, unsigned long request,
                          void* argument) { return ioctl(descriptor, request, argument); },
          .map = [this](std::size_t length, int descriptor,
                        std::int64_t offset) { return map(length, descriptor, offset); },
          .unmap = [this](void* start, std::size_t length) { return unmap(start, length); },
          .clocks = {.monotonic_us = [this] { return monotonic_us; },
                     .realtime_us = [this] { return realtime_us; }}};
}

void FakeCamera::pass(double seconds) {
  const auto passed_us = static_cast<std::int64_t>(1e6 * seconds);
  realtime_us += passed_us;
  monotonic_us += passed_us;
}

void FakeCamera::shoot(const Shot& shot) {
  const std::uint32_t number = sequence++;
  if (!streaming || queued_.empty()) return;
  v4l2_buffer buffer{};
  buffer.index = queued_.front();
  queued_.pop_front();
  buffer.flags = shot.flags;
  buffer.sequence = number;
  buffer.bytesused = static_cast<std::uint32_t>(format_.sizeimage - shot.missing_bytes);
  const std::int64_t stamp_us = (shot.by_realtime ? realtime_us : monotonic_us) - shot.age_us;
  buffer.timestamp.tv_sec = static_cast<decltype(buffer.timestamp.tv_sec)>(stamp_us / 1'000'000);
  buffer.timestamp.tv_usec = static_cast<decltype(buffer.timestamp.tv_usec)>(stamp_us % 1'000'000);
  if (const auto memory = mapped_.find(buffer.index); memory != mapped_.end())
    *static_cast<std::uint8_t*>(memory->second) = static_cast<std::uint8_t>(number);
  if (const auto memory = mapped_.find(buffer.index);
      memory != mapped_.end() && !shot.content.empty()) {
    buffer.bytesused = static_cast<std::uint32_t>(shot.content.size());
    std::vector<std::uint8_t>& bytes = *mappings.at(memory->second);
    std::copy_n(shot.content.begin(), std::min(bytes.size(), shot.content.size()), bytes.begin());
  }
  filled_.push_back(buffer);
}

bool FakeCamera::is_queued(std::uint32_t index) const {
  return std::ranges::find(queued_, index) != queued_.end();
}

const std::uint8_t* FakeCamera::mapped(std::uint32_t index) const {
  const auto found = mapped_.find(index);
  return found == mapped_.end() ? nullptr : static_cast<const std::uint8_t*>(found->second);
}

int FakeCamera::open(const char* device) {
  path = device;
  errno = present ? open_error : ENOENT;
  if (errno != 0) return -1;
  ++opened;
  descriptors.insert(next_descriptor_);
  return next_descriptor_++;
}

int FakeCamera::close(int descriptor) {
  if (descriptors.erase(descriptor) == 0) misuse.emplace_back("closed what is not open");
  if (!mapped_.empty()) misuse.emplace_back("closed with buffers mapped");
  forget_stream();
  return 0;
}

void FakeCamera::forget_stream() {
  streaming = false;
  queued_.clear();
  filled_.clear();
  buffers_ = 0;
}

int FakeCamera::ioctl(int descriptor, unsigned long request, void* argument) {
  if (!descriptors.contains(descriptor)) misuse.emplace_back("ioctl without a device");
  int error = 0;
  if (auto& planned = errors[request]; !planned.empty()) {
    error = planned.front();
    planned.pop_front();
  }
  if (error == 0 && !present) error = ENODEV;
  if (error == 0) error = answer(request, argument);
  if (error == 0 && lie) lie(request, argument);
  errno = error;
  return error == 0 ? 0 : -1;
}

int FakeCamera::answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP:
      as<v4l2_capability>(argument) = capability;
      return 0;
    case VIDIOC_S_FMT:
      return set_format(as<v4l2_format>(argument));
    case VIDIOC_ENUM_FMT:
      return enumerate_format(as<v4l2_fmtdesc>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return enumerate_size(as<v4l2_frmsizeenum>(argument));
    case VIDIOC_S_PARM:
      as<v4l2_streamparm>(argument).parm.capture.timeperframe = interval;
      return 0;
    case VIDIOC_QUERYCTRL:
      return query_control(as<v4l2_queryctrl>(argument));
    case VIDIOC_QUERYMENU:
      return query_menu(as<v4l2_querymenu>(argument));
    case VIDIOC_S_CTRL:
      return set_control(as<v4l2_control>(argument));
    case UVCIOC_CTRL_QUERY: {
      const auto& query = as<uvc_xu_control_query>(argument);
      return extension_unit(query);
    }
    case VIDIOC_REQBUFS:
      return request_buffers(as<v4l2_requestbuffers>(argument));
    case VIDIOC_QUERYBUF:
      return query_buffer(as<v4l2_buffer>(argument));
    case VIDIOC_QBUF:
      return queue(as<v4l2_buffer>(argument));
    case VIDIOC_DQBUF:
      return dequeue(as<v4l2_buffer>(argument));
    case VIDIOC_STREAMON:
      streaming = true;
      return 0;
    case VIDIOC_STREAMOFF:
      streaming = false;
      queued_.clear();
      filled_.clear();
      return 0;
    default:
      return ENOTTY;
  }
}

/// What was asked for where it is offered, else the first that is.
int FakeCamera::set_format(v4l2_format& format) {
  v4l2_pix_format& pixels = format.fmt.pix;
  const auto offers = [&](const Format& offered) {
    return offered.four_cc == pixels.pixelformat &&
           std::ranges::find(offered.sizes, std::pair{pixels.width, pixels.height}) !=
               offered.sizes.end();
  };
  if (std::ranges::none_of(formats, offers)) {
    pixels.pixelformat = formats.front().four_cc;
    std::tie(pixels.width, pixels.height) = formats.front().sizes.front();
  }
  pixels.field = field;
  pixels.bytesperline = 2 * pixels.width + row_padding;
  pixels.sizeimage = pixels.bytesperline * pixels.height;
  format_ = pixels;
  return 0;
}

int FakeCamera::enumerate_format(v4l2_fmtdesc& format) const {
  if (format.index >= formats.size()) return EINVAL;
  format.pixelformat = formats[format.index].four_cc;
  return 0;
}

int FakeCamera::enumerate_size(v4l2_frmsizeenum& size) const {
  const auto format = std::ranges::find(formats, size.pixel_format, &Format::four_cc);
  if (format == formats.end() || size.index >= format->sizes.size()) return EINVAL;
  size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
  std::tie(size.discrete.width, size.discrete.height) = format->sizes[size.index];
  return 0;
}

int FakeCamera::query_control(v4l2_queryctrl& query) const {
  const auto control = controls.find(query.id);
  if (control == controls.end()) return EINVAL;
  query = control->second.query;
  return 0;
}

int FakeCamera::query_menu(v4l2_querymenu& item) const {
  const auto control = controls.find(item.id);
  return control != controls.end() && control->second.menu.contains(item.index) ? 0 : EINVAL;
}

int FakeCamera::extension_unit(const uvc_xu_control_query& query) {
  if (query.unit != 3) return EINVAL;
  if (query.query == UVC_GET_LEN) {
    if (query.size != 2) return ENOBUFS;
    query.data[0] = static_cast<std::uint8_t>(extension_bytes);
    query.data[1] = static_cast<std::uint8_t>(extension_bytes >> 8U);
    return 0;
  }
  if (query.size != extension_bytes) return ENOBUFS;
  if (query.query == UVC_SET_CUR) extension_set.emplace_back(query.selector, query.data[0]);
  if (query.query == UVC_GET_CUR)
    query.data[0] = extension_takes_it && !extension_set.empty() ? extension_set.back().second : 0;
  return 0;
}

int FakeCamera::set_control(v4l2_control& control) {
  const auto found = controls.find(control.id);
  if (found == controls.end()) return EINVAL;
  const v4l2_queryctrl& query = found->second.query;
  if (control.value < query.minimum || control.value > query.maximum) return ERANGE;
  if (query.type == V4L2_CTRL_TYPE_MENU &&
      !found->second.menu.contains(static_cast<std::uint32_t>(control.value))) {
    return EINVAL;
  }
  found->second.value = control.value;
  controls_set.emplace_back(control.id, control.value);
  return 0;
}

int FakeCamera::request_buffers(v4l2_requestbuffers& wish) {
  if (!mapped_.empty() || streaming) return EBUSY;
  wish.count = buffers_ = buffers_given;
  return 0;
}

int FakeCamera::query_buffer(v4l2_buffer& buffer) const {
  if (buffer.index >= buffers_) return EINVAL;
  buffer.length = format_.sizeimage;
  buffer.m.offset = buffer.index * offset_step;
  return 0;
}

int FakeCamera::queue(const v4l2_buffer& buffer) {
  if (buffer.index >= buffers_) return EINVAL;
  if (is_queued(buffer.index)) {
    misuse.emplace_back("queued a buffer twice");
    return EINVAL;
  }
  queued_.push_back(buffer.index);
  return 0;
}

int FakeCamera::dequeue(v4l2_buffer& buffer) {
  if (!streaming) return EINVAL;
  if (filled_.empty()) return EAGAIN;
  buffer = filled_.front();
  filled_.pop_front();
  return 0;
}

void* FakeCamera::map(std::size_t length, int descriptor, std::int64_t offset) {
  const auto index = static_cast<std::uint32_t>(offset / offset_step);
  errno = ENOMEM;
  if (!descriptors.contains(descriptor) || mapped_.contains(index) || length > offset_step)
    return nullptr;
  auto memory = std::make_unique<std::vector<std::uint8_t>>(length);
  void* start = memory->data();
  mappings[start] = std::move(memory);
  mapped_[index] = start;
  return start;
}

int FakeCamera::unmap(void* start, std::size_t length) {
  const auto memory = mappings.find(start);
  if (memory == mappings.end() || memory->second->size() != length) {
    misuse.emplace_back("unmapped what is not mapped");
    return -1;
  }
  mappings.erase(memory);
  std::erase_if(mapped_, [start](const auto& entry) { return entry.second == start; });
  return 0;
}

}  // namespace gazed::v4l2
