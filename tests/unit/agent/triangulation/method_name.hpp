// What a test of every method is called.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

#include "agent/triangulation/methods/method.hpp"

namespace gazed::triangulation {

[[nodiscard]] inline std::string method_name(const testing::TestParamInfo<methods::Method>& info) {
  std::string out(methods::name(info.param));
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

}  // namespace gazed::triangulation
