// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that touch each other.
#include "curve_refinement/refine_curves.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "base/point_tree.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

constexpr double kMaxGapPx = 100;
constexpr double kBesidePx = 8;
constexpr double kMaxBranchAngleDeg = 30;
constexpr double kMaxDetour = 1.5;
constexpr double kMinBranchPx = 15;
constexpr double kMaxBranchPx = 60;
constexpr double kMaxBranchRmsPx = 0.4;
constexpr double kMaxShare = 0.6;  // of the distances without exchange

// Two open ends and a curve that runs past `a` and then past `b`.
struct Meeting {
  EndIdx a = 0;
  EndIdx b = 0;
  std::size_t passing_idx = 0;
  std::size_t sample_at_a = 0;  // of the passing curve
  std::size_t sample_at_b = 0;
  // Whether the curve that ends in `a` goes on as the passing one behind `b`,
  // and that before `a` as the one that ends in `b`. Otherwise `a` and `b`
  // belong together.
  bool exchange = false;
  double rms_px = 0;  // of the samples from the parabolas
};

struct OpenEnd {
  Eigen::Vector3d position;
  Eigen::Vector3d outward;  // unit
  double pixel = 0;         // 0: of a closed curve, or of a short one
  Curve branch;
};

// Where a curve passes an end.
struct Passage {
  std::size_t curve_idx = 0;
  std::size_t sample_idx = 0;
  bool outward = false;  // it runs as the end does
};

OpenEnd MakeEnd(const Curve& curve,
                bool at_head,
                const std::vector<PosedView>& views) {
  const CurveSample& last = SampleFromEnd(curve, at_head);
  OpenEnd end;
  end.position = last.position;
  end.outward = at_head ? last.tangent : Eigen::Vector3d(-last.tangent);
  if (curve.closed) return end;
  const double pixel = PixelSize(last, views);
  end.branch = BranchTo(curve,
                        at_head ? curve.samples.size() - 1 : 0,
                        at_head,
                        {kBentEndPx * pixel, kMaxBranchPx * pixel});
  if (Length(end.branch) >= kMinBranchPx * pixel) end.pixel = pixel;
  return end;
}

class MeetingFinder {
 public:
  MeetingFinder(const std::vector<Curve>& curves,
                const RefinementInput& input,
                const ImageSupport& images)
      : curves_(curves),
        images_(images),
        samples_(curves),
        ends_(2 * curves.size()),
        passages_(ends_.size()) {
    ParallelFor(ends_.size(), input.num_threads, [&](EndIdx end) {
      ends_[end] = MakeEnd(curves[ItemOf(end)], IsHead(end), input.views);
      passages_[end] = PassagesAt(end);
    });
  }

  std::vector<Meeting> Find() const {
    const PointTree tree(ends_, &OpenEnd::position);
    std::vector<Meeting> meetings;
    for (EndIdx a = 0; a < ends_.size(); ++a) {
      const double reach = kMaxGapPx * ends_[a].pixel;
      for (const EndIdx b : tree.Within(ends_[a].position, reach)) {
        if (b > a && AreFacing(ends_[a], ends_[b])) Meet(a, b, meetings);
      }
    }
    return meetings;
  }

 private:
  static bool AreFacing(const OpenEnd& a, const OpenEnd& b) {
    const Eigen::Vector3d way = b.position - a.position;
    const double gap = way.norm();
    const double least = std::cos(DegToRad(kMaxBranchAngleDeg)) * gap;
    return gap > 0 && gap <= kMaxGapPx * std::min(a.pixel, b.pixel) &&
           a.outward.dot(way) > least && -b.outward.dot(way) > least;
  }

  void Meet(EndIdx a, EndIdx b, std::vector<Meeting>& meetings) const {
    for (const Passage& at_a : passages_[a]) {
      for (const Passage& at_b : passages_[b]) {
        if (at_a.curve_idx != at_b.curve_idx || at_a.outward == at_b.outward) {
          continue;
        }
        Meeting meeting{a, b, at_a.curve_idx, at_a.sample_idx, at_b.sample_idx};
        if (!at_a.outward) {
          std::swap(meeting.a, meeting.b);
          std::swap(meeting.sample_at_a, meeting.sample_at_b);
        }
        if (Judge(meeting)) meetings.push_back(meeting);
      }
    }
  }

  // The curves beside an end, each at its sample nearest to it.
  std::vector<Passage> PassagesAt(EndIdx idx) const {
    const OpenEnd& end = ends_[idx];
    std::vector<Passage> passages;
    double least = 0;
    for (const std::size_t i :
         samples_.Within(end.position, kBesidePx * end.pixel)) {
      const auto [c, k] = samples_.Places()[i];
      const CurveSample& sample = curves_[c].samples[k];
      const double cosine = sample.tangent.dot(end.outward);
      const double distance = (sample.position - end.position).norm();
      if (std::abs(cosine) < std::cos(DegToRad(kMaxBranchAngleDeg)) ||
          LeadsToEnd(idx, c, k)) {
        continue;
      }
      if (passages.empty() || passages.back().curve_idx != c) {
        passages.emplace_back();
      } else if (distance >= least) {
        continue;
      }
      passages.back() = {c, k, cosine > 0};
      least = distance;
    }
    return passages;
  }

  // A curve may pass its own end, but not with its last samples.
  bool LeadsToEnd(EndIdx end, std::size_t c, std::size_t k) const {
    const std::size_t from_end =
        IsHead(end) ? curves_[c].samples.size() - 1 - k : k;
    return c == ItemOf(end) && from_end < 2 * ends_[end].branch.samples.size();
  }

  // Whether the passing curve leads from `a` to `b` and not round about, nor to
  // one of them as its own end.
  bool LeadsStraight(const Meeting& meeting) const {
    const std::size_t c = meeting.passing_idx;
    for (const EndIdx end : {meeting.a, meeting.b}) {
      if (LeadsToEnd(end, c, meeting.sample_at_a) ||
          LeadsToEnd(end, c, meeting.sample_at_b)) {
        return false;
      }
    }
    if (curves_[c].closed) return meeting.sample_at_a != meeting.sample_at_b;
    if (meeting.sample_at_b <= meeting.sample_at_a) return false;
    const auto& samples = curves_[c].samples;
    double along = 0;
    for (std::size_t k = meeting.sample_at_a; k < meeting.sample_at_b; ++k) {
      along += (samples[k + 1].position - samples[k].position).norm();
    }
    const double straight = (samples[meeting.sample_at_b].position -
                             samples[meeting.sample_at_a].position)
                                .norm();
    return along <= kMaxDetour * straight;
  }

  // Completes a meeting; false if it is none.
  bool Judge(Meeting& meeting) const {
    const OpenEnd& a = ends_[meeting.a];
    const OpenEnd& b = ends_[meeting.b];
    const Curve& passing = curves_[meeting.passing_idx];
    if (!LeadsStraight(meeting)) return false;
    const double pixel = std::min(a.pixel, b.pixel);
    const BranchSegment segment{0, kMaxBranchPx * pixel};
    const Curve before = BranchTo(passing, meeting.sample_at_a, true, segment);
    const Curve after = BranchTo(passing, meeting.sample_at_b, false, segment);
    if (std::min(Length(before), Length(after)) < kMinBranchPx * pixel) {
      return false;
    }
    const double joined = DistanceFromParabola(a.branch, b.branch);
    const double exchanged = std::hypot(DistanceFromParabola(a.branch, after),
                                        DistanceFromParabola(before, b.branch));
    // A closed curve is whole, whatever else passes.
    meeting.exchange =
        !passing.closed &&
        exchanged <
            kMaxShare * std::hypot(joined, DistanceFromParabola(before, after));
    meeting.rms_px = (meeting.exchange ? exchanged : joined) / pixel;
    if (!(meeting.rms_px <= kMaxBranchRmsPx)) return false;
    return meeting.exchange ? ImagesShow(a.branch, after, pixel) &&
                                  ImagesShow(before, b.branch, pixel)
                            : ImagesShow(a.branch, b.branch, pixel);
  }

  // Whether they show what is between two branches.
  bool ImagesShow(const Curve& from, const Curve& to, double pixel) const {
    CurveSample arrival = to.samples.back();
    arrival.tangent = -arrival.tangent;
    const double usual =
        std::min(SupportBefore(from, true), SupportBefore(to, true));
    return IsGapShown(from.samples.back(), arrival, pixel, usual, images_);
  }

  const std::vector<Curve>& curves_;
  const ImageSupport& images_;
  SampleTree samples_;
  std::vector<OpenEnd> ends_;
  std::vector<std::vector<Passage>> passages_;  // by end
};

// Ends that face each other, at most 100 px apart, and curves that pass both
// within 8 px and 30 degrees. Parabolas through 15 to 60 px of the four
// branches tell which belong together: `a` and `b`, or, unless the passing
// curve is closed, those that are exchanged, if their distances are below 0.6
// times the others. They must fit to 0.4 px, and the images show what is
// between the branches (IsGapShown()). Best fits first; ties by the order of
// curves. Pixels as in pixel_size.h.
std::vector<Meeting> FindMeetings(const std::vector<Curve>& curves,
                                  const RefinementInput& input,
                                  const ImageSupport& images) {
  std::vector<Meeting> meetings = MeetingFinder(curves, input, images).Find();
  std::ranges::sort(meetings, {}, [](const Meeting& m) {
    return std::tie(m.rms_px, m.a, m.b, m.passing_idx);
  });
  return meetings;
}

// Takes what is between `a` and `b` out of the passing curve, and returns the
// ends before and after the cut. An end of the curve may become one of a new
// curve.
std::pair<EndIdx, EndIdx> CutOut(Meeting& meeting, std::vector<Curve>& curves) {
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
  const CurveSample last = SampleFromEnd(curve, IsHead(end));
  const double bent = kBentEndPx * PixelSize(last, views);
  CutEnd(curve, IsHead(end), [&](const CurveSample& sample) {
    return (sample.position - last.position).norm() >= bent;
  });
}

// Which ends the meetings tie, and the curves cut for it. A curve that is
// changed takes part in no other of them; these wait.
EndTies TieMeetings(const std::vector<Meeting>& meetings,
                    const std::vector<PosedView>& views,
                    std::vector<Curve>& curves) {
  std::vector<bool> is_busy(curves.size(), false);
  std::vector<std::pair<EndIdx, EndIdx>> pairs;
  for (Meeting meeting : meetings) {
    const auto members = {
        ItemOf(meeting.a), ItemOf(meeting.b), meeting.passing_idx};
    if (std::ranges::any_of(members,
                            [&](std::size_t c) { return is_busy[c]; })) {
      continue;
    }
    is_busy[ItemOf(meeting.a)] = is_busy[ItemOf(meeting.b)] = true;
    if (meeting.exchange) {
      is_busy[meeting.passing_idx] = true;
      const auto [before, after] = CutOut(meeting, curves);
      pairs.emplace_back(meeting.a, after);
      pairs.emplace_back(before, meeting.b);
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
                                    const RefinementInput& input,
                                    const ImageSupport& images) {
  while (true) {  // each time there are fewer open ends
    const auto meetings = FindMeetings(curves, input, images);
    if (meetings.empty()) return curves;
    const EndTies ties = TieMeetings(meetings, input.views, curves);
    curves = StringTogetherFilled(std::move(curves), ties, images);
  }
}

}  // namespace curvix
