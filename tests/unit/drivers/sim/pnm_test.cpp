#include <array>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

#include "agent/base/random.hpp"
#include "drivers/sim/mipmap.hpp"

#include "picture.hpp"

namespace gazed::sim::pnm_test {
namespace {

using testing::TemporaryFile;

std::array<float, 3> colour_at(const MipMap& map, double x, double y) {
  return testing::look_up(map, x, y, 0.0F);
}

TEST(Pnm, ReadsColourWithAComment) {
  const TemporaryFile file("colour.ppm",
                           "P6\n# two pixels\n2 1\n255\n\x01\x02\x03\xff\x80\x00"
                           "x");
  const std::string bytes("P6\n# two pixels\n2 1\n255\n\x01\x02\x03\xff\x80\x00", 30);
  const TemporaryFile exact("exact.ppm", bytes);
  const auto map = load_pnm(exact.path());
  EXPECT_EQ(map->width(), 2);
  EXPECT_EQ(map->height(), 1);
  EXPECT_EQ(colour_at(*map, 0.5, 0.5), (std::array<float, 3>{1, 2, 3}));
  EXPECT_EQ(colour_at(*map, 1.5, 0.5), (std::array<float, 3>{255, 128, 0}));
}

TEST(Pnm, ReadsGreyWithAnotherGreatestValue) {
  const TemporaryFile file("grey.pgm", "P5 1 1 51 \x33");
  EXPECT_EQ(colour_at(*load_pnm(file.path()), 0.5, 0.5), (std::array<float, 3>{255, 255, 255}));
}

TEST(Pnm, RefusesWhatIsNoPictureAndNamesIt) {
  for (const std::string& contents :
       {std::string(), std::string("P"), std::string("P6"), std::string("P3 1 1 255 1 2 3"),
        std::string("P6 2 2 255 \x01\x02"), std::string("P6 0 2 255 "), std::string("P6 -1 2 255 "),
        std::string("P6 99999999999999999999 2 255 "), std::string("P5 2 2 65535 12345678"),
        std::string("\x89PNG\r\n")}) {
    const TemporaryFile file("bad.ppm", contents);
    try {
      (void)load_pnm(file.path());
      ADD_FAILURE() << contents;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(file.path()), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW((void)load_pnm("/nonexistent.ppm"), std::invalid_argument);
  EXPECT_THROW((void)load_pnm("/dev/zero"), std::invalid_argument);
  EXPECT_THROW((void)load_pnm("/"), std::invalid_argument);
}

TEST(Pnm, AnyBytesAreReadOrRefused) {
  base::Random random(1, 1);
  for (int i = 0; i < 500; ++i) {
    std::string contents = "P6 3 3 255 " + std::string(27, 'x');
    for (int change = 0; change < 4; ++change)
      contents[random.bits() % contents.size()] = static_cast<char>(random.bits() & 0xFFU);
    const TemporaryFile file("any.ppm", contents);
    try {
      EXPECT_GT(load_pnm(file.path())->width(), 0);
    } catch (const std::invalid_argument&) {
    }
  }
}

}  // namespace
}  // namespace gazed::sim::pnm_test
