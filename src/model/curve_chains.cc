// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6.
#include "model/curve_chains.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace curvix {
namespace {

void Append(std::vector<CurveSample> samples, Curve& curve) {
  std::move(samples.begin(), samples.end(), std::back_inserter(curve.samples));
}

Curve Concatenate(const EndChain& chain,
                  std::vector<Curve>& curves,
                  const FillGap& fill) {
  Curve whole;
  whole.closed = chain.closed || curves[chain.items.front().item].closed;
  for (const ChainItem& link : chain.items) {
    Curve part = std::move(curves[link.item]);
    if (link.flipped) part = Reversed(std::move(part));
    if (fill && !whole.samples.empty()) {
      Append(fill(whole.samples.back(), part.samples.front()), whole);
    }
    Append(std::move(part.samples), whole);
  }
  if (fill && chain.closed) {
    Append(fill(whole.samples.back(), whole.samples.front()), whole);
  }
  return whole;
}

}  // namespace

Curve Reversed(Curve curve) {
  std::reverse(curve.samples.begin(), curve.samples.end());
  for (CurveSample& sample : curve.samples) sample.tangent = -sample.tangent;
  return curve;
}

std::vector<Curve> StringTogether(std::vector<Curve> curves,
                                  const EndTies& ties,
                                  const FillGap& fill) {
  std::vector<Curve> strung;
  for (const EndChain& chain : FollowEnds(ties)) {
    strung.push_back(Concatenate(chain, curves, fill));
  }
  return strung;
}

}  // namespace curvix
