// How much of a test is done where everything takes 10 to 60 times as long.
#pragma once

namespace gazed::test {

/// Instrumented, or on an emulated CPU: the same checks on fewer cases.
constexpr bool few_trials = GAZED_FEW_TRIALS;

constexpr int trials(int many, int few) {
  return few_trials ? few : many;
}

}  // namespace gazed::test
