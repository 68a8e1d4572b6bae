// A camera and the robot that it belongs to, in the test's own time.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/naoqi/naoqi_camera.hpp"

#include "tests/unit/allocations.hpp"
#include "tests/unit/drivers/naoqi/fake_naoqi.hpp"

namespace gazed::naoqi {

inline constexpr int width_px = 160, height_px = 120;
inline constexpr std::int64_t start_us = 1'700'000'000'000'000;

/// A number as a type of the robot's choice writes it.
inline void write_number(QiWriter& writer, char type, std::int64_t number) {
  writer.text(std::string_view(&type, 1));
  if (type == 'd') {
    writer.integer(std::bit_cast<std::uint64_t>(static_cast<double>(number)), 8);
  } else {
    writer.integer(static_cast<std::uint64_t>(number), type == 'i' || type == 'I' ? 4 : 8);
  }
}

class NaoqiCameraRig : public testing::Test {
 protected:
  NaoqiCameraRig() {
    const auto add = [this](const char* name, const char* parameters, const char* returns,
                            FakeNaoqi::Handler handler) {
      robot_.methods.push_back({name, parameters, returns, std::move(handler)});
    };
    add("subscribeCamera", "(siiii)", "s", [this](QiReader arguments) {
      FakeAnswer answer;
      name_ = arguments.text();
      for (std::int64_t& number : asked_for_) number = arguments.u32();
      handle_ = refuses_ ? "" : name_ + "_0";
      answer.payload.text(handle_);
      return answer;
    });
    add("getImageRemote", "(s)", "m", [this](QiReader arguments) {
      if (arguments.text() != handle_) return fake_error("unknown handle");
      return image();
    });
    add("releaseImage", "(s)", "b", [](QiReader) { return truth(); });
    add("unsubscribe", "(s)", "b", [this](QiReader arguments) {
      unsubscribed_.emplace_back(arguments.text());
      return truth();
    });
    add("unsubscribeAllInstances", "(s)", "b", [this](QiReader arguments) {
      unsubscribed_.push_back("all of " + std::string(arguments.text()));
      return truth();
    });
  }
  ~NaoqiCameraRig() override { robot_.close_all(); }

  static FakeAnswer truth() {
    FakeAnswer answer;
    answer.payload.integer(1, 1);
    return answer;
  }

  /// The image of the robot's clock, 30 a second.
  FakeAnswer image() {
    FakeAnswer answer;
    if (no_image_) {
      answer.payload.text("v");
      return answer;
    }
    const std::int64_t stamp_us = (frozen_us_ ? *frozen_us_ : robots_us()) / 33'333 * 33'333;
    answer.payload.text("[m]").u32(12);
    for (const std::int64_t number :
         {sent_width_, std::int64_t{height_px}, std::int64_t{2}, std::int64_t{naoqi_yuv422},
          stamp_us / 1'000'000, stamp_us % 1'000'000})
      write_number(answer.payload, number_type_, number);
    answer.payload.text(bytes_type_).text(pixels_);
    for (int i = 0; i < 5; ++i) write_number(answer.payload, 'd', 0);
    return answer;
  }
  std::int64_t robots_us() const { return now_us_ + robot_ahead_us_; }

  NaoqiCamera& dut() {
    if (!dut_) {
      NaoqiCameraSettings settings{.robot = {robot_.endpoint(), "", ""},
                                   .position = geometry::CameraPosition::bottom,
                                   .width_px = width_px,
                                   .height_px = height_px,
                                   .delay_s = -0.02};
      dut_.emplace(settings,
                   drivers::Clocks{[this] { return monotonic_us(); }, [this] { return now_us_; }});
    }
    return *dut_;
  }
  std::int64_t monotonic_us() {
    if (serves_by_itself_) {
      robot_.serve();
      now_us_ += 10'000;  // await_answers() may wait so long
    }
    return now_us_ - start_us;
  }
  /// The driver ends, and the robot answers meanwhile.
  void end() {
    serves_by_itself_ = true;
    dut_.reset();
    serves_by_itself_ = false;
    robot_.serve();
  }
  void turn() {
    if (robot_.serve()) await_arrival(dut().descriptor());
    now_us_ += 1'000;
    const long before = test::allocations();
    const auto frame = dut().next_frame();
    allocated_ += test::allocations() - before;
    if (!frame) return;
    ++frames_;
    frame_ = *frame;
    last_y_ = frame->image.row(height_px - 1)[2 * width_px - 2];
  }
  template <typename Condition>
  bool turn_until(Condition condition) {
    for (int i = 0; i < 6'000 && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_frame() {
    frames_ = 0;
    return turn_until([this] { return frames_ > 0; });
  }
  bool turn_until_fault(const std::string& part) {
    return turn_until([&] { return dut().health().words.find(part) != std::string::npos; });
  }

  bool serves_by_itself_ = false;
  FakeNaoqi robot_;
  std::int64_t now_us_ = start_us;
  std::int64_t robot_ahead_us_ = 0;
  std::optional<std::int64_t> frozen_us_;
  std::string name_, handle_;
  std::vector<std::string> unsubscribed_;
  std::array<std::int64_t, 4> asked_for_{};
  std::int64_t sent_width_ = width_px;
  std::string pixels_ = std::string(2 * width_px * height_px, '\x37');
  std::string_view bytes_type_ = "r";
  char number_type_ = 'i';
  bool refuses_ = false, no_image_ = false;

  std::optional<NaoqiCamera> dut_;
  int frames_ = 0;
  geometry::Frame frame_;
  int last_y_ = 0;
  long allocated_ = 0;
};

}  // namespace gazed::naoqi
