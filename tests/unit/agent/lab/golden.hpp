// The files of tests/data/golden.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace gazed::lab {

using Json = nlohmann::json;

inline Json golden(const std::string& name) {
  std::ifstream file(GAZED_TEST_DATA "/golden/" + name);
  return Json::parse(file);
}

}  // namespace gazed::lab
