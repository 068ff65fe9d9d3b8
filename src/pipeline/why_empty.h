// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Explains an empty result.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <string>
#include <vector>

#include "pipeline/sketch_edges.h"

namespace curvix {

// At which stage everything was lost, and what may help: one or two sentences.
std::string WhyEmpty(const std::vector<EdgeMap>& edge_maps,
                     const EdgeSketch& sketch,
                     const Options& options);

}  // namespace curvix
