// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. Ends that are tied to each other, and curves strung together,
// cut, and joined in junctions.
#pragma once

#include <curvix/curves.h>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace curvix {

// End 2 i is the head of item i (where its direction points: the last sample of
// a curve), 2 i + 1 its tail.
using EndIdx = std::size_t;

inline EndIdx OtherEnd(EndIdx end) { return end ^ 1; }
inline std::size_t ItemOf(EndIdx end) { return end / 2; }
inline bool IsHead(EndIdx end) { return end % 2 == 0; }

// The sample `k` before the last one at the head, or after the first one at the
// tail.
inline const CurveSample& SampleFromEnd(const Curve& curve,
                                        bool at_head,
                                        std::size_t k = 0) {
  return curve.samples[at_head ? curve.samples.size() - 1 - k : k];
}

// The end that each end is tied to, if any; mutual. The two ends of one item
// may be tied to each other.
using EndTies = std::vector<std::optional<EndIdx>>;

struct ChainItem {
  std::size_t item = 0;
  bool flipped = false;  // runs from head to tail
};

// Items from tail to head. If `closed`, the last is tied to the first.
struct EndChain {
  bool closed = false;
  std::vector<ChainItem> items;
};

// All items in chains, single ones included. Each chain is found from its
// smallest item, forwards and then backwards (Sec. 6); that item is not flipped
// and comes first in a closed chain. The chains are in the order of their
// smallest items. Needs ties.size() even and mutual ties.
std::vector<EndChain> FollowEnds(const EndTies& ties);

// A pair of ends that could be tied, and how badly they fit.
struct EndPair {
  double cost = 0;
  EndIdx a = 0;
  EndIdx b = 0;
};

// Ties pairs in the order of their cost, then of their smaller and larger end,
// while both ends are free.
EndTies TieCheapestFirst(std::vector<EndPair> pairs, std::size_t num_items);

// `curve` run through from its end; tangents turn with it.
Curve Reversed(Curve curve);

// Samples between the last sample of one curve and the first of the next.
using FillGap = std::function<std::vector<CurveSample>(const CurveSample& from,
                                                       const CurveSample& to)>;

// One curve per chain of ties between ends (items are `curves`),
// in the order of FollowEnds. `fill` (may be empty) is asked for the samples of
// each gap, that of a closed chain included.
std::vector<Curve> StringTogether(std::vector<Curve> curves,
                                  const EndTies& ties,
                                  const FillGap& fill);

// The pieces of `curve` that end with the samples of these indices, ascending;
// a closed one is opened behind the first of them. Without any, the curve.
std::vector<Curve> CutAfter(const Curve& curve,
                            const std::vector<std::size_t>& samples);

// As CutAfter, but the next piece begins with the same sample, too.
std::vector<Curve> CutAt(const Curve& curve,
                         const std::vector<std::size_t>& samples);

// Makes junctions of the places, equal to the last bit, in which two or more
// ends of open curves lie: sets curves.junctions, in the order of their first
// ends, and the curves' indices into it. Both ends of a curve may be in one.
void IndexJunctions(CurveSet& curves);

}  // namespace curvix
