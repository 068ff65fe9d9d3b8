// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/separate_touching.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "geometry/pixel_size.h"
#include "model/end_chains.h"
#include "refinement/curve_arms.h"
#include "refinement/fill_gap.h"
#include "refinement/find_meetings.h"

namespace curvix {
namespace {

// The ends of a curve that was cut in the middle.
struct LooseEnds {
  EndIdx before = 0;
  EndIdx after = 0;
};

// Takes what is between `a` and `b` out of the passing curve. An end of it may
// become one of a new curve.
LooseEnds CutOut(Meeting& meeting, std::vector<Curve>& curves) {
  const std::size_t before = meeting.passing_idx;
  std::vector<CurveSample>& samples = curves[before].samples;
  const std::size_t after = curves.size();
  Curve rest;
  rest.samples.assign(
      samples.begin() + static_cast<std::ptrdiff_t>(meeting.sample_at_b),
      samples.end());
  samples.resize(meeting.sample_at_a + 1);
  curves.push_back(std::move(rest));
  for (EndIdx* end : {&meeting.a, &meeting.b}) {
    if (*end == 2 * before) *end = 2 * after;
  }
  return {2 * before, 2 * after + 1};
}

void CutBentEnd(EndIdx end,
                const std::vector<PosedView>& views,
                std::vector<Curve>& curves) {
  Curve& curve = curves[ItemOf(end)];
  const CurveSample last =
      IsFront(end) ? curve.samples.back() : curve.samples.front();
  const double bent =
      kBentEndPx * PixelSize(last.position, last.support, views);
  CutEnd(curve, IsFront(end), [&](const CurveSample& sample) {
    return (sample.position - last.position).norm() >= bent;
  });
}

// Which ends the meetings tie, and the curves cut for it. A curve takes part in
// one of them; the others wait.
EndTies TieMeetings(const std::vector<Meeting>& meetings,
                    const std::vector<PosedView>& views,
                    std::vector<Curve>& curves) {
  std::vector<bool> is_busy(curves.size(), false);
  std::vector<std::pair<EndIdx, EndIdx>> pairs;
  for (Meeting meeting : meetings) {
    const auto members = {
        ItemOf(meeting.a), ItemOf(meeting.b), meeting.passing_idx};
    if (std::any_of(members.begin(), members.end(), [&](std::size_t c) {
          return is_busy[c];
        })) {
      continue;
    }
    for (const std::size_t c : members) is_busy[c] = true;
    if (meeting.exchange) {
      const LooseEnds loose = CutOut(meeting, curves);
      pairs.emplace_back(meeting.a, loose.after);
      pairs.emplace_back(loose.before, meeting.b);
    } else {
      pairs.emplace_back(meeting.a, meeting.b);
    }
    CutBentEnd(meeting.a, views, curves);
    CutBentEnd(meeting.b, views, curves);
  }
  EndTies ties(2 * curves.size());
  for (const auto& [from, to] : pairs) {
    ties[from] = to;
    ties[to] = from;
  }
  return ties;
}

}  // namespace

std::vector<Curve> SeparateTouching(std::vector<Curve> curves,
                                    const std::vector<PosedView>& views,
                                    const ImageSupport& images) {
  while (true) {  // each time there are fewer open ends
    const auto meetings = FindMeetings(curves, views, images);
    if (meetings.empty()) return curves;
    const EndTies ties = TieMeetings(meetings, views, curves);
    curves = StringTogetherFilled(std::move(curves), ties, views, images);
  }
}

}  // namespace curvix
