// A kernel with one camera, as far as the driver can tell: every call of VideoSystem is answered
// here, and what a kernel would refuse is refused.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drivers/v4l2/video_system.hpp"

namespace gazed::v4l2 {

struct FakeControl {
  v4l2_queryctrl query{};
  std::int32_t value = 0;
  std::set<std::uint32_t> menu;  // items that exist
};

/// What a filled buffer says of itself.
struct Shot {
  std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  std::int64_t age_us = 5'000;  // of its stamp
  bool by_realtime = false;
  std::int64_t missing_bytes = 0;
  std::vector<std::uint8_t> content{};  // a JPEG; the camera numbers its pictures where it is empty
};

class FakeCamera {
 public:
  FakeCamera();

  /// Refers to this object.
  [[nodiscard]] VideoSystem system();

  /// The camera takes a picture: into the next buffer that is queued; without one it is lost.
  void shoot(const Shot& shot = {});
  void pass(double seconds);

  // What the camera is.
  bool present = true;
  int open_error = 0;
  v4l2_capability capability{};
  struct Format {
    std::uint32_t four_cc;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
  };
  std::vector<Format> formats;
  std::uint32_t row_padding = 0;  // bytes
  std::uint32_t field = V4L2_FIELD_NONE;
  std::uint32_t buffers_given = 4;
  v4l2_fract interval{1, 30};  // whatever is asked for
  std::map<std::uint32_t, FakeControl> controls;
  std::uint32_t sequence = 0;  // of the next picture

  /// Errors of the next calls of a request; 0 lets one through. Later ones are answered as usual.
  std::map<unsigned long, std::deque<int>> errors;
  /// May change the answer of a request that went well.
  std::function<void(unsigned long request, void* argument)> lie;

  std::int64_t realtime_us = 1'700'000'000'000'000;
  std::int64_t monotonic_us = 5'000'000;

  // What the driver did.
  int opened = 0;
  std::string path;  // last opened
  std::set<int> descriptors;
  std::map<void*, std::unique_ptr<std::vector<std::uint8_t>>> mappings;
  std::vector<std::pair<std::uint32_t, std::int32_t>> controls_set;  // in order
  std::vector<std::pair<std::uint8_t, std::uint8_t>> extension_set;  // selector, value
  bool extension_takes_it = true;
  std::uint16_t extension_bytes = 2;  // of a value of the extension unit
  bool streaming = false;
  std::vector<std::string> misuse;  // what no driver may do

  [[nodiscard]] std::size_t filled() const { return filled_.size(); }
  [[nodiscard]] std::size_t queued() const { return queued_.size(); }
  [[nodiscard]] bool is_queued(std::uint32_t index) const;
  /// Where a buffer is mapped; nullptr when it is not.
  [[nodiscard]] const std::uint8_t* mapped(std::uint32_t index) const;

 private:
  int open(const char* device);
  int close(int descriptor);
  int ioctl(int descriptor, unsigned long request, void* argument);
  int answer(unsigned long request, void* argument);
  int set_format(v4l2_format& format);
  int request_buffers(v4l2_requestbuffers& wish);
  int query_buffer(v4l2_buffer& buffer) const;
  int queue(const v4l2_buffer& buffer);
  int dequeue(v4l2_buffer& buffer);
  int enumerate_format(v4l2_fmtdesc& format) const;
  int enumerate_size(v4l2_frmsizeenum& size) const;
  int query_control(v4l2_queryctrl& query) const;
  int query_menu(v4l2_querymenu& item) const;
  int extension_unit(const uvc_xu_control_query& query);
  int set_control(v4l2_control& control);
  void* map(std::size_t length, int descriptor, std::int64_t offset);
  int unmap(void* start, std::size_t length);
  void forget_stream();

  int next_descriptor_ = 100;
  v4l2_pix_format format_{};
  std::uint32_t buffers_ = 0;
  std::map<std::uint32_t, void*> mapped_;  // by index
  std::deque<std::uint32_t> queued_;
  std::deque<v4l2_buffer> filled_;
};

}  // namespace gazed::v4l2
