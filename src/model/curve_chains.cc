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

std::vector<Curve> CutAfter(const Curve& curve,
                            const std::vector<std::size_t>& samples) {
  if (samples.empty()) return {curve};
  const std::size_t size = curve.samples.size();
  const std::size_t start = curve.closed ? samples.front() + 1 : 0;
  std::vector<Curve> pieces(1);
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t i = (start + k) % size;
    pieces.back().samples.push_back(curve.samples[i]);
    const bool is_last = std::binary_search(samples.begin(), samples.end(), i);
    if (is_last && k + 1 < size) pieces.emplace_back();
  }
  return pieces;
}

std::vector<Curve> CutAt(const Curve& curve,
                         const std::vector<std::size_t>& samples) {
  std::vector<Curve> pieces = CutAfter(curve, samples);
  if (samples.empty()) return pieces;
  CurveSample last = pieces.back().samples.back();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<CurveSample>& piece = pieces[i].samples;
    if (i > 0 || curve.closed) {
      piece.insert(piece.begin(), std::move(last));
    }
    last = piece.back();
  }
  return pieces;
}

}  // namespace curvix
