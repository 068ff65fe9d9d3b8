// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/tie_curves.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/pixel_size.h"
#include "model/sample_runs.h"
#include "parts/regions.h"

namespace curvix {

Piece MakePiece(int part_idx,
                std::size_t curve_idx,
                const Curve& curve,
                const std::vector<Border>& core,
                double overlap,
                const std::vector<PosedView>& views) {
  Piece piece{part_idx,
              curve_idx,
              curve.samples.size(),
              curve.closed,
              MainKind(curve) == CurveKind::kOccludingContour,
              {}};
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    const CurveSample& sample = curve.samples[k];
    if (DistanceBeyond(core, sample.position) < -overlap) continue;
    piece.border_samples.push_back(
        {k,
         sample.position,
         sample.tangent,
         PixelSize(sample.position, sample.support, views)});
  }
  return piece;
}

namespace {

const BorderSample& At(const std::vector<Piece>& pieces, const SampleRef& ref) {
  return pieces[ref.piece].border_samples[ref.border_sample];
}

std::vector<SampleRef> AllOf(const std::vector<Piece>& pieces) {
  std::vector<SampleRef> refs;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < pieces[i].border_samples.size(); ++k) {
      refs.push_back({i, k});
    }
  }
  return refs;
}

std::vector<Eigen::Vector3d> Positions(const std::vector<Piece>& pieces,
                                       const std::vector<SampleRef>& refs) {
  std::vector<Eigen::Vector3d> positions;
  for (const SampleRef& ref : refs) {
    positions.push_back(At(pieces, ref).position);
  }
  return positions;
}

}  // namespace

DuplicateSamples::DuplicateSamples(const ScenePartition& partition,
                                   const std::vector<Piece>& pieces,
                                   const ConnectivityOptions& options)
    : partition_(partition), pieces_(pieces) {
  for (const Piece& piece : pieces) {
    duplicates_.emplace_back(piece.border_samples.size());
  }
  const std::vector<SampleRef> refs = AllOf(pieces);
  const PointTree tree(Positions(pieces, refs));
  const double min_cosine = std::cos(DegToRad(options.max_angle_deg));
  for (const SampleRef& ref : refs) {
    const BorderSample& sample = At(pieces, ref);
    const int own_part = pieces[ref.piece].part_idx;
    const double reach = options.max_normal_distance_px * sample.pixel;
    std::map<int, std::pair<double, SampleRef>> nearest;  // by part
    for (const std::size_t k : tree.Within(sample.position, reach)) {
      const int part_idx = pieces[refs[k].piece].part_idx;
      const BorderSample& other = At(pieces, refs[k]);
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
      duplicates_[ref.piece][ref.border_sample].push_back(duplicate.second);
    }
  }
}

bool DuplicateSamples::Stays(const SampleRef& ref) const {
  const std::vector<SampleRef>& duplicates = Of(ref);
  if (duplicates.empty()) return true;
  const auto part = [&](const SampleRef& r) {
    return pieces_[r.piece].part_idx;
  };
  const SampleRef& first =
      part(ref) < part(duplicates.front()) ? ref : duplicates.front();
  const int owner = OwnerOf(partition_, At(pieces_, first).position);
  const bool owner_is_there =
      part(ref) == owner || std::any_of(duplicates.begin(),
                                        duplicates.end(),
                                        [&](const SampleRef& duplicate) {
                                          return part(duplicate) == owner;
                                        });
  return part(ref) == (owner_is_there ? owner : part(first));
}

namespace {

// Samples of a segment that may lie beyond the sample at which it is entered.
constexpr std::size_t kMaxSkipped = 10;

class Tier {
 public:
  Tier(const ScenePartition& partition,
       const std::vector<Piece>& pieces,
       const ConnectivityOptions& options)
      : pieces_(pieces), duplicates_(partition, pieces, options) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      first_stretches_.push_back(stretches_.size());
      std::vector<bool> stays(pieces[i].num_samples, true);
      for (std::size_t k = 0; k < pieces[i].border_samples.size(); ++k) {
        stays[pieces[i].border_samples[k].sample] = duplicates_.Stays({i, k});
      }
      for (const Run& run : RunsOf(stays)) stretches_.push_back({i, run});
    }
    first_stretches_.push_back(stretches_.size());
  }

  // Once.
  TiedStretches Tie() {
    std::vector<EndPair> pairs;
    for (EndIdx end = 0; end < 2 * stretches_.size(); ++end) {
      if (const auto pair = Continuation(end)) pairs.push_back(*pair);
    }
    EndTies ties = TieCheapestFirst(std::move(pairs), stretches_.size());
    return {std::move(stretches_), std::move(ties)};
  }

 private:
  const BorderSample& At(const SampleRef& ref) const {
    return pieces_[ref.piece].border_samples[ref.border_sample];
  }

  // The segment that holds a sample of a piece.
  std::optional<std::size_t> StretchOf(std::size_t piece,
                                       std::size_t sample) const {
    const auto at = [&](std::size_t idx) {
      return stretches_.begin() +
             static_cast<std::ptrdiff_t>(first_stretches_[idx]);
    };
    const auto stretch =
        std::partition_point(at(piece), at(piece + 1), [&](const Stretch& s) {
          return s.run.end <= sample;
        });
    if (stretch == at(piece + 1) || sample < stretch->run.begin) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(stretch - stretches_.begin());
  }

  // A sample of a piece that does not stay, and so is a border sample.
  SampleRef RefTo(std::size_t piece, std::size_t sample) const {
    const std::vector<BorderSample>& border = pieces_[piece].border_samples;
    const auto found = std::partition_point(
        border.begin(), border.end(), [&](const BorderSample& s) {
          return s.sample < sample;
        });
    return {piece, static_cast<std::size_t>(found - border.begin())};
  }

  // The tie from an end of a segment to the segment that continues it.
  std::optional<EndPair> Continuation(EndIdx end) const {
    const Stretch& from = stretches_[ItemOf(end)];
    const Piece& piece = pieces_[from.piece];
    const std::size_t size = piece.num_samples;
    const std::size_t last = IsFront(end) ? from.run.end - 1 : from.run.begin;
    std::size_t num_beyond = IsFront(end) ? size - 1 - last : last;
    if (piece.closed) num_beyond = size - (from.run.end - from.run.begin);
    for (std::size_t k = 1; k <= num_beyond; ++k) {
      const std::size_t step = IsFront(end) ? k : size - k;
      const std::size_t sample = (last + step) % size;
      if (const auto own = StretchOf(from.piece, sample)) {
        return EndPair{
            static_cast<double>(k), end, 2 * *own + (IsFront(end) ? 1 : 0)};
      }
      const auto across = TieAcross(end, k, RefTo(from.piece, sample));
      if (across) return across;
    }
    return std::nullopt;
  }

  // The tie to a segment of another piece, which has a duplicate of the k-th
  // sample beyond `end`.
  std::optional<EndPair> TieAcross(EndIdx end,
                                   std::size_t k,
                                   const SampleRef& beyond) const {
    for (const SampleRef& duplicate : duplicates_.Of(beyond)) {
      const std::size_t sample = At(duplicate).sample;
      const auto to = StretchOf(duplicate.piece, sample);
      if (!to || IsOfOtherKind(beyond.piece, duplicate.piece)) continue;
      const bool runs_on =
          (At(beyond).tangent.dot(At(duplicate).tangent) > 0) == IsFront(end);
      const Run& run = stretches_[*to].run;
      const std::size_t skipped =
          runs_on ? sample - run.begin : run.end - 1 - sample;
      if (skipped > kMaxSkipped) continue;
      return EndPair{
          static_cast<double>(k + skipped), end, 2 * *to + (runs_on ? 1 : 0)};
    }
    return std::nullopt;
  }

  bool IsOfOtherKind(std::size_t a, std::size_t b) const {
    return pieces_[a].is_occluding_contour != pieces_[b].is_occluding_contour;
  }

  const std::vector<Piece>& pieces_;
  const DuplicateSamples duplicates_;
  std::vector<Stretch> stretches_;
  // Of each piece, and the end.
  std::vector<std::size_t> first_stretches_;
};

}  // namespace

TiedStretches TieStretches(const ScenePartition& partition,
                           const std::vector<Piece>& pieces,
                           const ConnectivityOptions& options) {
  return Tier(partition, pieces, options).Tie();
}

}  // namespace curvix
