// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace curvix {

// Keys in the order in which they were set.
using Json = nlohmann::ordered_json;

// "key 'nodes' not found", without the code of the library before it.
inline std::string WhatOf(const nlohmann::json::exception& error) {
  const std::string what = error.what();
  const std::size_t end = what.find("] ");
  return end == std::string::npos ? what : what.substr(end + 2);
}

}  // namespace curvix
