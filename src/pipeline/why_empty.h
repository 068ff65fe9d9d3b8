// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Explains an empty result.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/sketch_edges.h"

namespace curvix {

// At which stage everything was lost, and what may help: one or two sentences.
// `num_curves`: before the filters.
std::string WhyEmpty(const std::vector<EdgeMap>& edge_maps,
                     const EdgeSketch& sketch,
                     std::size_t num_curves,
                     const Options& options);

}  // namespace curvix
