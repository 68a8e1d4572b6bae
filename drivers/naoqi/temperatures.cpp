#include "drivers/naoqi/temperatures.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

constexpr std::int64_t period_us = 1'000'000;  // motors warm up in minutes
// A restarted ALMemory is back within this time, and a hot head is still hot.
constexpr std::int64_t kept_us = 10'000'000;
constexpr std::array<QiMethod, 1> memory_methods{{{"getListData", "(m)"}}};
// Keys of the DCM (compare B-Human 2017, libbhuman.cpp).
constexpr std::array<std::string_view, 2> keys{
    "Device/SubDeviceList/HeadYaw/Temperature/Sensor/Value",
    "Device/SubDeviceList/HeadPitch/Temperature/Sensor/Value"};

}  // namespace

NaoqiTemperatures::NaoqiTemperatures(WakeUp& wake_up, QiRobot robot)
    : memory_(wake_up, std::move(robot), "ALMemory", memory_methods) {
  question_.dynamic_list(keys);
}

void NaoqiTemperatures::serve(std::int64_t now_us) {
  memory_.serve(now_us);
  if (now_us - known_us_ > kept_us) celsius_ = {unknown, unknown};
  if (!memory_.ready() || memory_.busy() || now_us < next_us_) return;
  next_us_ = now_us + period_us;
  memory_.call(0, question_.bytes(), [this](const QiResult& result) {
    const auto answer = per_joint(result);
    trouble_ = answer ? "" : "ALMemory.getListData: " + base::excerpt(result.error);
    if (!answer) return;
    celsius_ = *answer;
    known_us_ = next_us_ - period_us;  // time of the request
  });
}

std::int64_t NaoqiTemperatures::due_us() const {
  return memory_.ready() && !memory_.busy() ? std::min(memory_.due_us(), next_us_)
                                            : memory_.due_us();
}

const std::string& NaoqiTemperatures::fault() const {
  return memory_.fault().empty() ? trouble_ : memory_.fault();
}

}  // namespace gazed::naoqi
