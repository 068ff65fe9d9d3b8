// SPDX-License-Identifier: BSD-3-Clause
#include "parts/tie_curves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/pixel_size.h"

namespace curvix {

PartCurve MakePartCurve(int part_idx,
                        std::size_t curve_idx,
                        const Curve& curve,
                        const std::vector<Border>& core,
                        double overlap,
                        const std::vector<PosedView>& views) {
  PartCurve part_curve{part_idx,
                       curve_idx,
                       curve.samples.size(),
                       curve.closed,
                       MainKind(curve) == CurveKind::kOccludingContour,
                       {}};
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    const CurveSample& sample = curve.samples[k];
    if (DistanceBeyond(core, sample.position) < -overlap) continue;
    part_curve.border_samples.push_back(
        {k, sample.position, sample.tangent, PixelSize(sample, views)});
  }
  return part_curve;
}

namespace {

// A border sample of a curve.
struct SampleRef {
  std::size_t curve = 0;
  std::size_t border_sample = 0;  // index into PartCurve::border_samples
};

const BorderSample& At(const std::vector<PartCurve>& curves,
                       const SampleRef& ref) {
  return curves[ref.curve].border_samples[ref.border_sample];
}

std::vector<SampleRef> AllOf(const std::vector<PartCurve>& curves) {
  std::vector<SampleRef> refs;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (std::size_t k = 0; k < curves[i].border_samples.size(); ++k) {
      refs.push_back({i, k});
    }
  }
  return refs;
}

// For border samples, their duplicate in each other part: the nearest sample,
// at most kMaxNormalDistancePx away and options.max_angle_deg off in direction.
// Ties: the earlier sample.
class DuplicateSamples {
 public:
  // Partition and curves outlive it.
  DuplicateSamples(const ScenePartition& partition,
                   const std::vector<PartCurve>& curves,
                   const ConnectivityOptions& options)
      : partition_(partition), part_curves_(curves) {
    for (const PartCurve& curve : curves) {
      duplicates_.emplace_back(curve.border_samples.size());
    }
    const std::vector<SampleRef> refs = AllOf(curves);
    const PointTree tree(
        refs, [&](const SampleRef& ref) { return At(curves, ref).position; });
    const double min_cosine = std::cos(DegToRad(options.max_angle_deg));
    for (const SampleRef& ref : refs) {
      const BorderSample& sample = At(curves, ref);
      const int own_part = curves[ref.curve].part_idx;
      const double reach = kMaxNormalDistancePx * sample.pixel;
      std::map<int, std::pair<double, SampleRef>> nearest;  // by part
      for (const std::size_t k : tree.Within(sample.position, reach)) {
        const int part_idx = curves[refs[k].curve].part_idx;
        const BorderSample& other = At(curves, refs[k]);
        if (part_idx == own_part ||
            std::abs(sample.tangent.dot(other.tangent)) < min_cosine) {
          continue;
        }
        const double distance = (other.position - sample.position).norm();
        const auto [at, is_new] =
            nearest.try_emplace(part_idx, distance, refs[k]);
        if (!is_new && distance < at->second.first) {
          at->second = {distance, refs[k]};
        }
      }
      for (const auto& [part_idx, duplicate] : nearest) {
        duplicates_[ref.curve][ref.border_sample].push_back(duplicate.second);
      }
    }
  }

  // In the order of the parts.
  const std::vector<SampleRef>& Of(const SampleRef& ref) const {
    return duplicates_[ref.curve][ref.border_sample];
  }

  // Whether the sample stays, of it and its duplicates. The sample in the part
  // with the smallest index says where the place is. The sample of the part
  // whose core holds this place stays; if that part has none, that of the part
  // with the smallest index.
  bool Stays(const SampleRef& ref) const {
    const std::vector<SampleRef>& duplicates = Of(ref);
    if (duplicates.empty()) return true;
    const auto part = [&](const SampleRef& r) {
      return part_curves_[r.curve].part_idx;
    };
    const SampleRef& first =
        part(ref) < part(duplicates.front()) ? ref : duplicates.front();
    const int owner = OwnerOf(partition_, At(part_curves_, first).position);
    const bool owner_is_there =
        part(ref) == owner ||
        std::ranges::any_of(duplicates, [&](const SampleRef& duplicate) {
          return part(duplicate) == owner;
        });
    return part(ref) == (owner_is_there ? owner : part(first));
  }

 private:
  const ScenePartition& partition_;
  const std::vector<PartCurve>& part_curves_;
  // Of each border sample of each curve.
  std::vector<std::vector<std::vector<SampleRef>>> duplicates_;
};

// Samples of a segment that may lie beyond the sample at which it is entered.
constexpr std::size_t kMaxSkipped = 10;

class Tier {
 public:
  Tier(const ScenePartition& partition,
       const std::vector<PartCurve>& curves,
       const ConnectivityOptions& options)
      : part_curves_(curves), duplicates_(partition, curves, options) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      first_segments_.push_back(segments_.size());
      std::vector<bool> stays(curves[i].num_samples, true);
      for (std::size_t k = 0; k < curves[i].border_samples.size(); ++k) {
        stays[curves[i].border_samples[k].sample] = duplicates_.Stays({i, k});
      }
      for (const SampleRange& range : RangesOf(stays))
        segments_.push_back({i, range});
    }
    first_segments_.push_back(segments_.size());
  }

  // Once.
  TiedSegments Tie() {
    std::vector<EndPair> pairs;
    for (EndIdx end = 0; end < 2 * segments_.size(); ++end) {
      if (const auto pair = Continuation(end)) pairs.push_back(*pair);
    }
    EndTies ties = TieCheapestFirst(std::move(pairs), segments_.size());
    return {std::move(segments_), std::move(ties)};
  }

 private:
  // The segment that holds a sample of a curve.
  std::optional<std::size_t> SegmentOf(std::size_t curve,
                                       std::size_t sample) const {
    const auto at = [&](std::size_t idx) {
      return segments_.begin() +
             static_cast<std::ptrdiff_t>(first_segments_[idx]);
    };
    const auto segment = std::partition_point(
        at(curve), at(curve + 1), [&](const CurveSegment& s) {
          return s.range.end <= sample;
        });
    if (segment == at(curve + 1) || sample < segment->range.begin) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(segment - segments_.begin());
  }

  // A sample of a curve that does not stay, and so is a border sample.
  SampleRef RefTo(std::size_t curve, std::size_t sample) const {
    const std::vector<BorderSample>& border =
        part_curves_[curve].border_samples;
    const auto found = std::ranges::partition_point(
        border, [&](const BorderSample& s) { return s.sample < sample; });
    return {curve, static_cast<std::size_t>(found - border.begin())};
  }

  // The tie from an end of a segment to the segment that continues it.
  std::optional<EndPair> Continuation(EndIdx end) const {
    const CurveSegment& from = segments_[ItemOf(end)];
    const PartCurve& curve = part_curves_[from.curve];
    const std::size_t size = curve.num_samples;
    const std::size_t last =
        IsHead(end) ? from.range.end - 1 : from.range.begin;
    std::size_t num_beyond = IsHead(end) ? size - 1 - last : last;
    if (curve.closed) num_beyond = size - (from.range.end - from.range.begin);
    for (std::size_t k = 1; k <= num_beyond; ++k) {
      const std::size_t step = IsHead(end) ? k : size - k;
      const std::size_t sample = (last + step) % size;
      if (const auto own = SegmentOf(from.curve, sample)) {
        return EndPair{
            static_cast<double>(k), end, 2 * *own + (IsHead(end) ? 1 : 0)};
      }
      const auto across = TieAcross(end, k, RefTo(from.curve, sample));
      if (across) return across;
    }
    return std::nullopt;
  }

  // The tie to a segment of another curve, which has a duplicate of the k-th
  // sample beyond `end`.
  std::optional<EndPair> TieAcross(EndIdx end,
                                   std::size_t k,
                                   const SampleRef& beyond) const {
    for (const SampleRef& duplicate : duplicates_.Of(beyond)) {
      const std::size_t sample = At(part_curves_, duplicate).sample;
      const auto to = SegmentOf(duplicate.curve, sample);
      const bool is_of_other_kind =
          part_curves_[beyond.curve].is_occluding_contour !=
          part_curves_[duplicate.curve].is_occluding_contour;
      if (!to || is_of_other_kind) continue;
      const bool runs_on =
          (At(part_curves_, beyond)
               .tangent.dot(At(part_curves_, duplicate).tangent) > 0) ==
          IsHead(end);
      const SampleRange& range = segments_[*to].range;
      const std::size_t skipped =
          runs_on ? sample - range.begin : range.end - 1 - sample;
      if (skipped > kMaxSkipped) continue;
      return EndPair{
          static_cast<double>(k + skipped), end, 2 * *to + (runs_on ? 1 : 0)};
    }
    return std::nullopt;
  }

  const std::vector<PartCurve>& part_curves_;
  const DuplicateSamples duplicates_;
  std::vector<CurveSegment> segments_;
  // Of each curve, and the end.
  std::vector<std::size_t> first_segments_;
};

}  // namespace

TiedSegments TieSegments(const ScenePartition& partition,
                         const std::vector<PartCurve>& curves,
                         const ConnectivityOptions& options) {
  return Tier(partition, curves, options).Tie();
}

}  // namespace curvix
