// The emulated CPU is a check of what was compiled for the robot's: it runs what that CPU has, and
// refuses the next newer instructions. In assembly, since a compiler folds constant intrinsics
// away.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>

namespace gazed {
namespace {

using testing::ExitedWithCode;
using testing::KilledBySignal;

[[noreturn]] void pass() {
  std::_Exit(0);
}

// Both robots' CPUs: SSSE3 and MOVBE.
TEST(Emulation, RunsSsse3AndMovbe) {
  EXPECT_EXIT((__asm__ volatile("pshufb %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              ExitedWithCode(0), "");
  const std::uint32_t word = 0x01020304;
  std::uint32_t swapped = 0;
  __asm__ volatile("movbe %1, %0" : "=r"(swapped) : "m"(word));
  EXPECT_EQ(swapped, 0x04030201U);
}

#if defined(__i386__)

TEST(Emulation, OfABonnellRefusesSse41) {
  EXPECT_EXIT((__asm__ volatile("pmulld %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
  EXPECT_EXIT((__asm__ volatile("pminud %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
}

TEST(Emulation, OfABonnellRefusesSse42AndPopcnt) {
  EXPECT_EXIT((__asm__ volatile("pcmpgtq %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
  EXPECT_EXIT((__asm__ volatile("popcnt %%eax, %%eax" ::
                                    : "eax"),
               pass()),
              KilledBySignal(SIGILL), "");
}

#else

TEST(Emulation, OfASilvermontRunsSse42) {
  EXPECT_EXIT((__asm__ volatile("pcmpgtq %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              ExitedWithCode(0), "");
  EXPECT_EXIT((__asm__ volatile("popcnt %%eax, %%eax" ::: "eax"), pass()), ExitedWithCode(0), "");
}

TEST(Emulation, OfASilvermontRefusesAvxFmaAndBmi) {
  EXPECT_EXIT((__asm__ volatile("vpxor %%xmm0, %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
  EXPECT_EXIT((__asm__ volatile("vpaddb %%ymm0, %%ymm0, %%ymm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
  EXPECT_EXIT((__asm__ volatile("vfmadd132ps %%xmm0, %%xmm0, %%xmm0" ::
                                    : "xmm0"),
               pass()),
              KilledBySignal(SIGILL), "");
  EXPECT_EXIT((__asm__ volatile("andn %%eax, %%eax, %%eax" ::
                                    : "eax"),
               pass()),
              KilledBySignal(SIGILL), "");
}

#endif

}  // namespace
}  // namespace gazed
