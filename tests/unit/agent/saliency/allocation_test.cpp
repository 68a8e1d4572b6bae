// Looking allocates nothing, and the working state is small: every malloc of this program is
// counted, operator new's included.
#include <Eigen/Core>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/saliency/inhibition.hpp"
#include "agent/saliency/own_parts.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"

namespace {

std::size_t allocations = 0;
std::size_t allocated_bytes = 0;

void count(std::size_t size) {
  ++allocations;
  allocated_bytes += size;
}

}  // namespace

#if GAZED_SANITIZED

// gcc ships the sanitizer's library without the header that declares this, clang with it.
extern "C" int __sanitizer_install_malloc_and_free_hooks(  // NOLINT
    void (*on_malloc)(const volatile void*, std::size_t), void (*on_free)(const volatile void*));

namespace {
const int hooked = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t size) { count(size); }, [](const volatile void*) {});
}

#else

// glibc's own names for what stands in front of them here.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t number, std::size_t size);       // NOLINT
void* __libc_realloc(void* pointer, std::size_t size);           // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) noexcept {
  count(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) noexcept {
  count(number * size);
  return __libc_calloc(number, size);
}
void* realloc(void* pointer, std::size_t size) noexcept {
  count(size);
  return __libc_realloc(pointer, size);
}
// Of these two, aligned operator new calls the first in libstdc++ up to 13, the second from 14 on.
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count(size);
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) noexcept {
  count(size);
  *pointer = __libc_memalign(alignment, size);
  return *pointer == nullptr ? ENOMEM : 0;
}
}

#endif

namespace gazed::saliency::allocation_test {
namespace {

constexpr std::size_t largest_state_bytes = 400 * 1024;  // the budget at 640x480

TEST(Allocation, IsCountedAtAll) {
  const std::size_t before = allocations;
  const std::vector<int> one(1000);
  EXPECT_EQ(one.size(), 1000U);
  EXPECT_GT(allocations, before);
}

constexpr std::array all_profiles{SaliencyProfile::report, SaliencyProfile::robust,
                                  SaliencyProfile::surround};

// Everything that is off by default.
SaliencySettings settings_with_all(SaliencyProfile profile) {
  SaliencySettings settings;
  settings.profile = profile;
  settings.flicker_weight = 1.0;
  settings.hysteresis = 0.1;
  settings.overexposed_weight = 0.5;
  return settings;
}

/// Of a second one: what a library takes once, when it is first used, is nobody's state.
std::size_t state_bytes(const SaliencySettings& settings) {
  { const Saliency first(settings, 640, 480); }
  const std::size_t before = allocated_bytes;
  const Saliency saliency(settings, 640, 480);
  return allocated_bytes - before;
}

TEST(Allocation, LookingAllocatesNothing) {
  const auto all = frames::drawn_frames();
  const base::ImageView rgb = all[0].canvas.view();
  const auto bytes = frames::yuyv_of(rgb);
  const base::ImageView yuyv = frames::yuyv_view(bytes, 640, 480);
  const std::vector<std::uint8_t> grey_bytes(std::size_t{640} * 480, 90);
  const base::ImageView grey{grey_bytes.data(), 640, 480, 640, base::PixelFormat::grey};
  const std::vector<std::uint16_t> kept(1200, 1000);
  const FrameContext context{.head_is_still = true,
                             .previous_winner_px = geometry::Pixel(100, 100),
                             .kept = kept,
                             .without_own_parts = kept};
  for (SaliencyProfile profile : all_profiles) {
    Saliency saliency(settings_with_all(profile), 640, 480);
    const std::size_t before = allocations;
    for (const base::ImageView& frame : {rgb, yuyv, grey, all[3].canvas.view()})
      (void)saliency.examine(frame, context);
    EXPECT_EQ(allocations - before, 0U);
  }
}

TEST(Allocation, InhibitingAllocatesNothing) {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  Inhibition inhibition(rig.camera, 0.1, 10.0);
  const geometry::Pose pose = geometry::cam_from_torso(rig.head, {});
  const std::size_t before = allocations;
  for (int i = 0; i < 40; ++i) {
    inhibition.add(Eigen::Vector3d(1.0, -1.0 + 0.05 * i, 0.1), i);
    EXPECT_FALSE(inhibition.kept(pose, i).empty() && i == 20);
  }
  EXPECT_EQ(allocations - before, 0U);
}

TEST(Allocation, LeavingOwnPartsOutAllocatesNothing) {
  const geometry::Rig rig =
      geometry::robot_profile("nao-v6", geometry::CameraPosition::bottom)->rig;
  OwnParts parts(rig.camera, true, true);
  const geometry::Pose pose = geometry::cam_from_torso(rig.head, {1.2, 0.2});
  const std::size_t before = allocations;
  EXPECT_FALSE(parts.kept(pose).empty());
  EXPECT_EQ(allocations - before, 0U);
}

TEST(Allocation, TheStateOfA640x480FrameIsSmall) {
  for (SaliencyProfile profile : all_profiles) {
    const std::size_t bytes = state_bytes(settings_with_all(profile));
    EXPECT_LE(bytes, largest_state_bytes);
    RecordProperty("bytes_of_profile_" + std::to_string(static_cast<int>(profile)),
                   std::to_string(bytes));
  }
}

TEST(Allocation, FlickerKeepsAnEighthOfAFramesSidesAndNothingWhenOff) {
  SaliencySettings settings;
  const std::size_t off = state_bytes(settings);
  settings.hysteresis = 0.1;
  settings.scan = true;
  EXPECT_EQ(state_bytes(settings), off);
  settings.flicker_weight = 1.0;
  constexpr std::size_t level3_bytes = 2 * 80 * 60, row_bytes = 2 * 82, map_bytes = 2 * 40 * 30;
  constexpr std::size_t margin_bytes = 2 * 2 * 16;  // before and after each of the two planes
  EXPECT_EQ(state_bytes(settings) - off, level3_bytes + row_bytes + map_bytes + margin_bytes);
}

}  // namespace
}  // namespace gazed::saliency::allocation_test
