// What a test of every method is called.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

#include "agent/triangulation/method.hpp"

namespace gazed {

[[nodiscard]] inline std::string method_name(const testing::TestParamInfo<Method>& info) {
  std::string out(name(info.param));
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

}  // namespace gazed
