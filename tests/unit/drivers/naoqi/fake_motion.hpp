// The head of a FakeNaoqi: ALMotion's methods, and ALMemory's for the temperatures.
#pragma once

#include <array>
#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "drivers/naoqi/motion.hpp"

#include "tests/unit/drivers/naoqi/fake_naoqi.hpp"

namespace gazed::naoqi {

/// A head that is at once where it was told to be, when it has a stiffness.
struct FakeMotion {
  struct Command {
    PerJoint target{};
    float speed = 0.0F;
    friend bool operator==(const Command&, const Command&) = default;
  };

  /// Puts its methods into `robot`; both must stay where they are.
  explicit FakeMotion(FakeNaoqi& robot) {
    using Arguments = QiReader;
    const auto add = [&robot](const char* name, const char* parameters, const char* returns,
                              FakeNaoqi::Handler handler) {
      robot.methods.push_back({name, parameters, returns, std::move(handler)});
    };
    add("getAngles", "(mb)", "[f]", [this](Arguments) {
      return fake_numbers({angles[0], angles[1]});
    });
    add("setAngles", "(mmf)", "v", [this](Arguments arguments) { return move(arguments); });
    add("getStiffnesses", "(m)", "[f]", [this](Arguments) {
      return fake_numbers({stiffness[0], stiffness[1]});
    });
    add("setStiffnesses", "(mm)", "v", [this](Arguments arguments) {
      stiffness = two_numbers(arguments);
      return FakeAnswer{};
    });
    add("getLimits", "(s)", "m",
        [this](Arguments arguments) { return limits_of(arguments.text() == "HeadYaw" ? 0 : 1); });
    add("getRobotConfig", "()", "m", [this](Arguments) { return config(); });
    add_switch(robot, "BreathEnabled", breathing);
    add_switch(robot, "IdlePostureEnabled", idle_posture);
    add("getListData", "(m)", "m", [this](Arguments) {
      FakeAnswer answer;
      answer.payload.dynamic_list(celsius);
      return answer;
    });
  }
  FakeMotion(const FakeMotion&) = delete;
  FakeMotion& operator=(const FakeMotion&) = delete;

  PerJoint angles{0.125F, -0.0625F};
  PerJoint stiffness{0.0F, 0.0F};
  PerJoint celsius{40.0F, 42.0F};
  bool breathing = true, idle_posture = false;
  bool stuck = false;
  std::string model = "naoH25";
  std::array<PerJoint, 2> limits{{{-2.08567F, 2.08567F}, {-0.671952F, 0.514872F}}};
  std::vector<Command> commands;
  std::vector<std::string> switched;  // "BreathEnabled off"

 private:
  static PerJoint two_numbers(QiReader& arguments) {
    arguments.next();
    return per_joint({arguments.next(), {}}).value();
  }

  FakeAnswer move(QiReader& arguments) {
    Command command;
    command.target = two_numbers(arguments);
    command.speed = std::bit_cast<float>(arguments.u32());
    commands.push_back(command);
    if (!stuck && stiffness[0] > 0.0F) angles = command.target;
    return {};
  }

  FakeAnswer config() const {
    FakeAnswer answer;
    answer.payload.text("[m]").u32(2);
    answer.payload.dynamic_list(std::array<std::string_view, 2>{"Head Version", "Model Type"});
    answer.payload.dynamic_list(std::array<std::string_view, 2>{"VERSION_40", model});
    return answer;
  }

  FakeAnswer limits_of(std::size_t joint) const {
    FakeAnswer answer;
    answer.payload.text("[m]").u32(1);
    answer.payload.dynamic_list(std::array{limits[joint][0], limits[joint][1], 8.0F, 1.5F});
    return answer;
  }

  void add_switch(FakeNaoqi& robot, const std::string& name, bool& on) {
    robot.methods.push_back({"get" + name, "(s)", "b", [&on](QiReader) {
                               FakeAnswer answer;
                               answer.payload.integer(on ? 1 : 0, 1);
                               return answer;
                             }});
    robot.methods.push_back({"set" + name, "(sb)", "v", [this, &on, name](QiReader arguments) {
                               switched.push_back(std::string(arguments.text()) + ' ' + name);
                               on = arguments.integer(1) != 0;
                               switched.back() += on ? " on" : " off";
                               return FakeAnswer{};
                             }});
  }
};

}  // namespace gazed::naoqi
