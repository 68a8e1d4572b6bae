#include <gtest/gtest.h>
#include <set>
#include <string_view>

#include "agent/cycle/fixation.hpp"

namespace gazed::cycle::fixation_status_test {
namespace {

TEST(FixationStatus, NamesAreThoseOfTheMessage) {
  EXPECT_EQ(name(Status::located), "LOCATED");
  EXPECT_EQ(name(Status::no_salient_object), "NO_SALIENT_OBJECT");
  EXPECT_EQ(name(Status::target_lost), "TARGET_LOST");
  EXPECT_EQ(name(Status::degenerate), "DEGENERATE");
  EXPECT_EQ(name(Status::behind_camera), "BEHIND_CAMERA");
  EXPECT_EQ(name(Status::uncertain), "UNCERTAIN");
  EXPECT_EQ(name(Status::head_fault), "HEAD_FAULT");
  EXPECT_EQ(name(Status::camera_fault), "CAMERA_FAULT");
}

TEST(FixationStatus, EachHasAName) {
  std::set<std::string_view> names;
  for (int i = 0; i < status_count; ++i) names.insert(name(static_cast<Status>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(status_count));
}

/// Whatever a triangulation may come to; a pixel without a ray is no target.
TEST(FixationStatus, ATriangulationsIsKeptByItsName) {
  for (int i = 0; i < triangulation::status_count; ++i) {
    const auto status = static_cast<triangulation::Status>(i);
    if (status == triangulation::Status::invalid_input) continue;
    EXPECT_EQ(name(status_of(status)), triangulation::name(status));
  }
  EXPECT_EQ(status_of(triangulation::Status::invalid_input), Status::target_lost);
}

}  // namespace
}  // namespace gazed::cycle::fixation_status_test
