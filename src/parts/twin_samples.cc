// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/twin_samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/pixel_size.h"
#include "parts/regions.h"

namespace curvix {
namespace {

const CurveSample& At(const std::vector<Piece>& pieces, const SampleRef& ref) {
  return pieces[ref.piece].curve.samples[ref.sample];
}

// Those within the overlap on either side of a border.
std::vector<SampleRef> SamplesNearBorders(const ScenePartition& partition,
                                          const std::vector<Piece>& pieces) {
  const auto cores = CoresOf(partition);
  std::vector<SampleRef> near;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& core = cores[static_cast<std::size_t>(pieces[i].part_idx)];
    for (std::size_t k = 0; k < pieces[i].curve.samples.size(); ++k) {
      const SampleRef ref{i, k};
      if (DistanceBeyond(core, At(pieces, ref).position) >=
          -partition.overlap) {
        near.push_back(ref);
      }
    }
  }
  return near;
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

TwinSamples::TwinSamples(const ScenePartition& partition,
                         const std::vector<Piece>& pieces,
                         const std::vector<PosedView>& views,
                         const ConnectivityOptions& options)
    : partition_(partition), pieces_(pieces), twins_(1) {
  for (const Piece& piece : pieces) {
    twin_idxs_.emplace_back(piece.curve.samples.size(), 0);
  }
  const std::vector<SampleRef> near = SamplesNearBorders(partition, pieces);
  const PointTree tree(Positions(pieces, near));
  const double min_cosine = std::cos(DegToRad(options.max_angle_deg));
  for (const SampleRef& ref : near) {
    const CurveSample& sample = At(pieces, ref);
    const int own_part = pieces[ref.piece].part_idx;
    const double pixel = PixelSize(sample.position, sample.support, views);
    const double reach = options.max_normal_distance_px * pixel;
    std::map<int, std::pair<double, SampleRef>> nearest;  // by part
    for (const std::size_t k : tree.Within(sample.position, reach)) {
      const int part_idx = pieces[near[k].piece].part_idx;
      const CurveSample& other = At(pieces, near[k]);
      if (part_idx == own_part ||
          std::abs(sample.tangent.dot(other.tangent)) < min_cosine) {
        continue;
      }
      const double distance = (other.position - sample.position).norm();
      const auto [at, is_new] =
          nearest.try_emplace(part_idx, distance, near[k]);
      if (!is_new && distance < at->second.first) {
        at->second = {distance, near[k]};
      }
    }
    if (nearest.empty()) continue;
    twin_idxs_[ref.piece][ref.sample] =
        static_cast<std::uint32_t>(twins_.size());
    twins_.emplace_back();
    for (const auto& [part_idx, twin] : nearest) {
      twins_.back().push_back(twin.second);
    }
  }
}

const std::vector<SampleRef>& TwinSamples::Of(const SampleRef& ref) const {
  return twins_[twin_idxs_[ref.piece][ref.sample]];
}

bool TwinSamples::Stays(const SampleRef& ref) const {
  const std::vector<SampleRef>& twins = Of(ref);
  if (twins.empty()) return true;
  const auto part = [&](const SampleRef& r) {
    return pieces_[r.piece].part_idx;
  };
  const SampleRef& first =
      part(ref) < part(twins.front()) ? ref : twins.front();
  const int owner = OwnerOf(partition_, At(pieces_, first).position);
  const bool owner_is_there =
      part(ref) == owner ||
      std::any_of(twins.begin(), twins.end(), [&](const SampleRef& twin) {
        return part(twin) == owner;
      });
  return part(ref) == (owner_is_there ? owner : part(first));
}

}  // namespace curvix
