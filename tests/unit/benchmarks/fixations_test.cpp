#include "tests/benchmarks/fixations.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gazed::benchmarks::fixations_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Fixations read(const std::string& rows) {
  std::istringstream csv("image,subject,order,x_px,y_px,duration_ms\n" + rows);
  return read_fixations(csv);
}

TEST(Fixations, FirstOfEverybodyIsDroppedAndCellsAreTenPixels) {
  const Fixations fixations = read(
      "a.jpg,1,1,400,300,142\n"
      "a.jpg,1,2,0,0,121\n"
      "a.jpg,2,1,10,10,100\n"
      "a.jpg,2,2,799.9,599.9,100\n"
      "b.jpg,1,2,19.9,20.0,100\n");
  EXPECT_THAT(fixations.at("a.jpg"), ElementsAre(cv::Point(0, 0), cv::Point(79, 59)));
  EXPECT_THAT(fixations.at("b.jpg"), ElementsAre(cv::Point(1, 2)));
}

TEST(Fixations, ElsewhereIsEveryOtherPicture) {
  const Fixations fixations = read("a,1,2,5,5,1\nb,1,2,15,5,1\nc,1,2,25,5,1\n");
  EXPECT_THAT(fixations_elsewhere(fixations, "b"), ElementsAre(cv::Point(0, 0), cv::Point(2, 0)));
}

TEST(Fixations, RefusesWithTheLine) {
  for (const std::string row : {"a,1,2,5,5", "a,1,2,five,5,1", "a,1,2,800,5,1", "a,1,2,5,-1,1",
                                "a,1,2,5x,5,1", "a,1,2,nan,5,1", "a,1,,5,5,1", "\"a,1,2,5,5,1"})
    EXPECT_THAT([&] { read("a,1,2,5,5,1\n" + row + "\n"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("line 3: '" + row + "'")));
}

TEST(Fixations, RefusesAnotherHeader) {
  std::istringstream csv("image,x,y\n");
  EXPECT_THAT([&] { static_cast<void>(read_fixations(csv)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("image,x,y")));
}

}  // namespace
}  // namespace gazed::benchmarks::fixations_test
