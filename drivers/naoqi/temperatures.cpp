#include "drivers/naoqi/temperatures.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "agent/text.hpp"

namespace gazed {

namespace {

constexpr std::int64_t period_us = 1'000'000;  // motors warm up in minutes
constexpr std::array<QiMethod, 1> memory_methods{{{"getListData", "(m)"}}};
// The DCM's names (B-Human 2017, libbhuman.cpp, has their like).
constexpr std::array<std::string_view, 2> keys{
    "Device/SubDeviceList/HeadYaw/Temperature/Sensor/Value",
    "Device/SubDeviceList/HeadPitch/Temperature/Sensor/Value"};

}  // namespace

NaoqiTemperatures::NaoqiTemperatures(WakeUp& wake_up, QiRobot robot)
    : memory_(wake_up, std::move(robot), "ALMemory", memory_methods) {
  write_dynamic_list(question_, keys);
}

void NaoqiTemperatures::serve(std::int64_t now_us) {
  memory_.serve(now_us);
  if (!memory_.ready()) celsius_ = {unknown, unknown};
  if (!memory_.ready() || memory_.busy() || now_us < next_us_) return;
  next_us_ = now_us + period_us;
  memory_.call(0, question_.bytes(), [this](const QiResult& result) {
    const auto answer = per_joint(result);
    celsius_ = answer.value_or(PerJoint{unknown, unknown});
    trouble_ = answer ? "" : "ALMemory.getListData: " + excerpt(result.error);
  });
}

std::int64_t NaoqiTemperatures::due_us() const {
  return memory_.ready() && !memory_.busy() ? std::min(memory_.due_us(), next_us_)
                                            : memory_.due_us();
}

const std::string& NaoqiTemperatures::fault() const {
  return memory_.fault().empty() ? trouble_ : memory_.fault();
}

}  // namespace gazed
