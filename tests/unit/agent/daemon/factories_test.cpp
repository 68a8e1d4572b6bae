#include "agent/daemon/factories.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace gazed::daemon::factories_test {
namespace {

using drivers::Part;
using drivers::Source;

TEST(Factories, EveryRowOfTheTableHasOneThatMakesItsParts) {
  for (const drivers::DriverRow& row : drivers::all_drivers()) {
    ASSERT_EQ(std::ranges::count(all_factories(), row.name, &DriverFactory::name), 1) << row.name;
    const DriverFactory& factory = factory_of(row);
    EXPECT_EQ(factory.name, row.name);
    EXPECT_EQ(factory.camera != nullptr, row.has_camera) << row.name;
    EXPECT_EQ(factory.head != nullptr, row.has_head) << row.name;
    EXPECT_EQ(factory.opens != nullptr, row.exclusive) << row.name;
  }
  EXPECT_EQ(all_factories().size(), drivers::all_drivers().size());
}

TEST(Factories, SayWhatTheyOpen) {
  settings::Settings settings = settings::default_settings("nao-v6");
  const auto opens = [&settings](Part part, std::string_view text) {
    const Source source = Source::parse(part, text).value();
    (part == Part::camera ? settings.camera.source : settings.head.source) = source;
    return factory_of(source.driver()).opens(settings, part);
  };
  EXPECT_EQ(opens(Part::camera, "v4l2"), "/dev/video-top");
  EXPECT_EQ(opens(Part::camera, "v4l2:/dev/video2"), "/dev/video2");
  EXPECT_EQ(opens(Part::camera, "naoqi"), "NAOqi at 127.0.0.1:9559, top camera");
  EXPECT_EQ(opens(Part::head, "naoqi:10.0.0.7:9560"), "NAOqi at 10.0.0.7:9560, head");
  EXPECT_EQ(opens(Part::head, "lola"), "/tmp/robocup");
  EXPECT_EQ(opens(Part::head, "lola:/tmp/a"), "/tmp/a");
  settings.camera.position = geometry::CameraPosition::bottom;
  EXPECT_EQ(opens(Part::camera, "naoqi"), "NAOqi at 127.0.0.1:9559, bottom camera");
}

}  // namespace
}  // namespace gazed::daemon::factories_test
