// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <limits>

namespace curvix {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace curvix
