// The emulated CPU is a check of what was compiled for the robot's: it runs what that CPU has, and
// refuses the next newer instructions. In assembly, since a compiler folds constant intrinsics
// away.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>

namespace gazed::emulation::emulation_test {
namespace {

using Instruction = void (*)();

void expect_run(Instruction instruction) {
  EXPECT_EXIT((instruction(), std::_Exit(0)), testing::ExitedWithCode(0), "");
}

void expect_refused(Instruction instruction) {
  EXPECT_EXIT((instruction(), std::_Exit(0)), testing::KilledBySignal(SIGILL), "");
}

const Instruction ssse3 = [] { __asm__ volatile("pshufb %%xmm0, %%xmm0" ::: "xmm0"); };
const Instruction sse41 = [] { __asm__ volatile("pmulld %%xmm0, %%xmm0" ::: "xmm0"); };
const Instruction sse42 = [] { __asm__ volatile("pcmpgtq %%xmm0, %%xmm0" ::: "xmm0"); };
const Instruction popcnt = [] { __asm__ volatile("popcnt %%eax, %%eax" ::: "eax"); };
const Instruction avx = [] { __asm__ volatile("vpxor %%xmm0, %%xmm0, %%xmm0" ::: "xmm0"); };
const Instruction avx2 = [] { __asm__ volatile("vpaddb %%ymm0, %%ymm0, %%ymm0" ::: "xmm0"); };
const Instruction fma = [] { __asm__ volatile("vfmadd132ps %%xmm0, %%xmm0, %%xmm0" ::: "xmm0"); };
const Instruction bmi = [] { __asm__ volatile("andn %%eax, %%eax, %%eax" ::: "eax"); };

TEST(Emulation, RunsSsse3AndMovbe) {
  expect_run(ssse3);
  const std::uint32_t word = 0x01020304;
  std::uint32_t swapped = 0;
  __asm__ volatile("movbe %1, %0" : "=r"(swapped) : "m"(word));
  EXPECT_EQ(swapped, 0x04030201U);
}

TEST(Emulation, RunsSse4OnSilvermontOnly) {
  for (const Instruction instruction : {sse41, sse42, popcnt}) {
#if defined(__i386__)
    expect_refused(instruction);
#else
    expect_run(instruction);
#endif
  }
}

TEST(Emulation, RefusesAvxFmaAndBmi) {
  for (const Instruction instruction : {avx, avx2, fma, bmi}) expect_refused(instruction);
}

}  // namespace
}  // namespace gazed::emulation::emulation_test
