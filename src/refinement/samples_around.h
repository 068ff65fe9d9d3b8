// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The neighbourhood of a sample on its curve.
#pragma once

#include <curvix/curves.h>

#include <cstddef>
#include <vector>

namespace curvix {

struct SampleAround {
  std::size_t index = 0;
  double along = 0;  // arc length from the sample asked for, signed
};

// The sample `index` itself first, then those after it and those before it
// within `reach` (world units) along the curve; of a closed curve at most half
// of it either way.
std::vector<SampleAround> SamplesAround(const Curve& curve,
                                        std::size_t index,
                                        double reach);

}  // namespace curvix
