// SPDX-License-Identifier: BSD-3-Clause
#include "model/sample_tree.h"

namespace curvix {
namespace {

std::vector<SamplePlace> PlacesOf(const std::vector<Curve>& curves) {
  std::vector<SamplePlace> places;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      places.push_back({c, s});
    }
  }
  return places;
}

}  // namespace

SampleTree::SampleTree(const std::vector<Curve>& curves)
    : places_(PlacesOf(curves)), tree_(places_, [&](const SamplePlace& place) {
        return curves[place.curve_idx].samples[place.sample_idx].position;
      }) {}

}  // namespace curvix
