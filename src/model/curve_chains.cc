// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_chains.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "base/check.h"

namespace curvix {
namespace {

void Append(std::vector<CurveSample> samples, Curve& curve) {
  std::move(samples.begin(), samples.end(), std::back_inserter(curve.samples));
}

Curve StringOne(const EndChain& chain,
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
  std::ranges::reverse(curve.samples);
  for (CurveSample& sample : curve.samples) sample.tangent = -sample.tangent;
  return curve;
}

std::vector<Curve> StringTogether(std::vector<Curve> curves,
                                  const EndTies& ties,
                                  const FillGap& fill) {
  std::vector<Curve> strung;
  for (const EndChain& chain : FollowEnds(ties)) {
    strung.push_back(StringOne(chain, curves, fill));
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
    const bool is_last = std::ranges::binary_search(samples, i);
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

namespace {

// Leaves item `start` by `end` and walks on to the last item or back to
// `start`; returns the items on the way, without `start`, in order.
// `forward`: items that are walked from tail to head are not flipped.
std::vector<ChainItem> Walk(const EndTies& ties, EndIdx end, bool forward) {
  const std::size_t start = ItemOf(end);
  std::vector<ChainItem> items;
  while (ties[end].has_value() && ItemOf(*ties[end]) != start) {
    const EndIdx entered = *ties[end];
    items.push_back({ItemOf(entered), IsHead(entered) == forward});
    end = OtherEnd(entered);
  }
  return items;
}

bool IsClosed(const EndTies& ties,
              std::size_t start,
              const std::vector<ChainItem>& ahead) {
  const EndIdx head =
      ahead.empty() ? 2 * start
                    : 2 * ahead.back().item + (ahead.back().flipped ? 1 : 0);
  return ties[head] == 2 * start + 1;
}

EndChain ChainThrough(const EndTies& ties, std::size_t start) {
  std::vector<ChainItem> ahead = Walk(ties, 2 * start, true);
  EndChain chain;
  chain.closed = IsClosed(ties, start, ahead);
  if (!chain.closed) {
    chain.items = Walk(ties, 2 * start + 1, false);
    std::ranges::reverse(chain.items);
  }
  chain.items.push_back({start, false});
  chain.items.insert(chain.items.end(), ahead.begin(), ahead.end());
  return chain;
}

}  // namespace

std::vector<EndChain> FollowEnds(const EndTies& ties) {
  CURVIX_CHECK(ties.size() % 2 == 0, ties.size() << " ends");
  for (EndIdx end = 0; end < ties.size(); ++end) {
    CURVIX_CHECK(!ties[end].has_value() ||
                     (*ties[end] < ties.size() && ties[*ties[end]] == end),
                 "the tie of end " << end << " is not mutual");
  }
  std::vector<bool> is_traced(ties.size() / 2, false);
  std::vector<EndChain> chains;
  for (std::size_t item = 0; item < is_traced.size(); ++item) {
    if (is_traced[item]) continue;
    chains.push_back(ChainThrough(ties, item));
    for (const ChainItem& link : chains.back().items) {
      is_traced[link.item] = true;
    }
  }
  return chains;
}

EndTies TieCheapestFirst(std::vector<EndPair> pairs, std::size_t num_items) {
  for (EndPair& pair : pairs) {
    if (pair.b < pair.a) std::swap(pair.a, pair.b);
  }
  std::ranges::sort(pairs, [](const auto& x, const auto& y) {
    return std::tie(x.cost, x.a, x.b) < std::tie(y.cost, y.a, y.b);
  });
  EndTies ties(2 * num_items);
  for (const EndPair& pair : pairs) {
    if (ties[pair.a].has_value() || ties[pair.b].has_value()) continue;
    ties[pair.a] = pair.b;
    ties[pair.b] = pair.a;
  }
  return ties;
}

namespace {

using Place = std::array<double, 3>;

Place PlaceOf(const CurveSample& sample) {
  return {sample.position.x(), sample.position.y(), sample.position.z()};
}

}  // namespace

void IndexJunctions(CurveSet& curves) {
  std::map<Place, int> num_ends;
  for (const Curve& curve : curves.curves) {
    if (curve.closed || curve.samples.empty()) continue;
    ++num_ends[PlaceOf(curve.samples.front())];
    ++num_ends[PlaceOf(curve.samples.back())];
  }
  curves.junctions.clear();
  std::map<Place, int> index_of;
  const auto junction_at = [&](const CurveSample& sample) {
    const Place place = PlaceOf(sample);
    if (num_ends[place] < 2) return -1;
    const auto [found, is_new] =
        index_of.try_emplace(place, static_cast<int>(curves.junctions.size()));
    if (is_new) {
      curves.junctions.push_back(
          {sample.position, sample.sigma, num_ends[place]});
    }
    CurveJunction& junction =
        curves.junctions[static_cast<std::size_t>(found->second)];
    junction.sigma = std::max(junction.sigma, sample.sigma);
    return found->second;
  };
  for (Curve& curve : curves.curves) {
    curve.start_junction = curve.end_junction = -1;
    if (curve.closed || curve.samples.empty()) continue;
    curve.start_junction = junction_at(curve.samples.front());
    curve.end_junction = junction_at(curve.samples.back());
  }
}

}  // namespace curvix
