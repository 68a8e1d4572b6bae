// Looking allocates nothing, and the working state is small: every malloc of this program is
// counted, operator new's included.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/saliency/frames.hpp"

namespace {

std::size_t allocations = 0;
std::size_t allocated_bytes = 0;

void count(std::size_t size) {
  ++allocations;
  allocated_bytes += size;
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__)

// gcc ships the sanitizer's library without the header that declares this.
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
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count(size);
  return __libc_memalign(alignment, size);
}
}

#endif

namespace gazed {
namespace {

constexpr std::size_t largest_state_bytes = 400 * 1024;  // DESIGN 6, at 640x480

TEST(Allocation, IsCountedAtAll) {
  const std::size_t before = allocations;
  const std::vector<int> one(1000);
  EXPECT_EQ(one.size(), 1000U);
  EXPECT_GT(allocations, before);
}

TEST(Allocation, LookingAllocatesNothing) {
  const auto all = frames::drawn_frames();
  const ImageView rgb = all[0].canvas.view();
  const auto bytes = frames::yuyv_of(rgb);
  const ImageView yuyv = frames::yuyv_view(bytes, 640, 480);
  const std::vector<std::uint8_t> grey_bytes(std::size_t{640} * 480, 90);
  const ImageView grey{grey_bytes.data(), 640, 480, 640, PixelFormat::grey};
  for (SaliencyProfile profile : {SaliencyProfile::report, SaliencyProfile::robust}) {
    SaliencySettings settings;
    settings.profile = profile;
    Saliency saliency(settings, 640, 480);
    const std::size_t before = allocations;
    for (const ImageView& frame : {rgb, yuyv, grey, all[3].canvas.view()})
      (void)saliency.look(frame);
    EXPECT_EQ(allocations - before, 0U);
  }
}

TEST(Allocation, TheStateOfA640x480FrameIsSmall) {
  for (SaliencyProfile profile : {SaliencyProfile::report, SaliencyProfile::robust}) {
    SaliencySettings settings;
    settings.profile = profile;
    const std::size_t before = allocated_bytes;
    const Saliency saliency(settings, 640, 480);
    const std::size_t bytes = allocated_bytes - before;
    EXPECT_LE(bytes, largest_state_bytes);
    RecordProperty(profile == SaliencyProfile::report ? "report_bytes" : "robust_bytes",
                   std::to_string(bytes));
  }
}

}  // namespace
}  // namespace gazed
