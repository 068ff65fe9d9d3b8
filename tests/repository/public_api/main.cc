// SPDX-License-Identifier: BSD-3-Clause
// Succeeds if the public API can be compiled as C++17 and linked.
#include <curvix/curvix.h>

#include <iostream>

static_assert(__cplusplus == 201703L, "the public API is C++17");

int main() {
  curvix::SyntheticOptions synthetic;
  synthetic.solid = curvix::SyntheticSolid::kBlock;
  synthetic.num_views = 3;
  synthetic.width = synthetic.height = 32;
  const auto made = curvix::MakeSyntheticScene(synthetic);
  if (!made.ok()) {
    std::cerr << made.status().message() << '\n';
    return 1;
  }
  const std::vector<curvix::EdgeMap> no_edges(made->scene.views.size());
  const auto result =
      curvix::ReconstructCurves(made->scene, no_edges, curvix::Options());
  if (!result.ok()) {
    std::cerr << result.status().message() << '\n';
    return 1;
  }
  std::cout << result->report.why_empty << '\n';
  return result->curves.curves.empty() ? 0 : 1;
}
