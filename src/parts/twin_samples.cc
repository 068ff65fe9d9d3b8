// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/twin_samples.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "parts/regions.h"

namespace curvix {
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

TwinSamples::TwinSamples(const ScenePartition& partition,
                         const std::vector<Piece>& pieces,
                         const ConnectivityOptions& options)
    : partition_(partition), pieces_(pieces) {
  for (const Piece& piece : pieces) {
    twins_.emplace_back(piece.border_samples.size());
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
    for (const auto& [part_idx, twin] : nearest) {
      twins_[ref.piece][ref.border_sample].push_back(twin.second);
    }
  }
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
