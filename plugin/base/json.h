// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

namespace curvix {

// Keys in the order in which they were set.
using Json = nlohmann::ordered_json;

}  // namespace curvix
