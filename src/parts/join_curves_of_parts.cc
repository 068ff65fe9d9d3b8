// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/join_curves_of_parts.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "geometry/loose_curves.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"
#include "model/end_chains.h"
#include "parts/runs.h"
#include "parts/twin_samples.h"

namespace curvix {
namespace {

// Samples of a stretch that may lie beyond the place at which it is entered.
constexpr std::size_t kMaxSkipped = 10;
// Shortest step from one stretch to the next, pixels.
constexpr double kMinStepPx = 0.5;

// Samples of a piece that stay.
struct Stretch {
  std::size_t piece = 0;
  Run run;
};

std::vector<Piece> Flatten(std::vector<std::vector<Curve>> curves_of_parts) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < curves_of_parts.size(); ++i) {
    for (Curve& curve : curves_of_parts[i]) {
      pieces.push_back({static_cast<int>(i), std::move(curve)});
    }
  }
  return pieces;
}

class Joiner {
 public:
  Joiner(const ScenePartition& partition,
         std::vector<Piece> pieces,
         const std::vector<PosedView>& views,
         const ConnectivityOptions& options)
      : pieces_(std::move(pieces)),
        views_(views),
        twins_(partition, pieces_, views, options) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const std::size_t size = pieces_[i].curve.samples.size();
      std::vector<bool> stays(size);
      for (std::size_t k = 0; k < size; ++k) stays[k] = twins_.Stays({i, k});
      stretch_of_.emplace_back(size, std::nullopt);
      for (const Run& run : RunsOf(stays)) {
        for (std::size_t k = run.begin; k < run.end; ++k) {
          stretch_of_[i][k] = stretches_.size();
        }
        stretches_.push_back({i, run});
      }
    }
  }

  // Once: takes the pieces apart.
  std::vector<Curve> Join() {
    std::vector<EndPair> pairs;
    for (EndIdx end = 0; end < 2 * stretches_.size(); ++end) {
      if (const auto pair = Continuation(end)) pairs.push_back(*pair);
    }
    const EndTies ties = TieCheapestFirst(std::move(pairs), stretches_.size());
    std::vector<Curve> curves;
    std::vector<bool> is_occluding;
    for (const Stretch& stretch : stretches_) {
      curves.push_back(TakeOut(pieces_[stretch.piece].curve, stretch.run));
      is_occluding.push_back(curves.back().is_occluding_contour);
    }
    for (EndIdx end = 0; end < ties.size(); ++end) {
      if (ties[end] && end < *ties[end]) TrimSecond(end, *ties[end], curves);
    }
    std::vector<Curve> joined = StringTogether(std::move(curves), ties, {});
    std::size_t idx = 0;
    for (const EndChain& chain : FollowEnds(ties)) {
      joined[idx++].is_occluding_contour =
          is_occluding[chain.items.front().item];
    }
    return joined;
  }

 private:
  const CurveSample& At(const SampleRef& ref) const {
    return pieces_[ref.piece].curve.samples[ref.sample];
  }

  // The tie from an end of a stretch to that which it runs into.
  std::optional<EndPair> Continuation(EndIdx end) const {
    const Stretch& from = stretches_[ItemOf(end)];
    const Curve& curve = pieces_[from.piece].curve;
    const std::size_t size = curve.samples.size();
    const std::size_t last = IsFront(end) ? from.run.end - 1 : from.run.begin;
    std::size_t num_beyond = IsFront(end) ? size - 1 - last : last;
    if (curve.closed) num_beyond = size - (from.run.end - from.run.begin);
    for (std::size_t k = 1; k <= num_beyond; ++k) {
      const std::size_t step = IsFront(end) ? k : size - k;
      const SampleRef beyond{from.piece, (last + step) % size};
      if (const auto own = stretch_of_[beyond.piece][beyond.sample]) {
        return EndPair{
            static_cast<double>(k), end, 2 * *own + (IsFront(end) ? 1 : 0)};
      }
      for (const SampleRef& twin : twins_.Of(beyond)) {
        const auto to = stretch_of_[twin.piece][twin.sample];
        if (!to || IsOfOtherKind(from.piece, twin.piece)) continue;
        const bool runs_on =
            (At(beyond).tangent.dot(At(twin).tangent) > 0) == IsFront(end);
        const Run& run = stretches_[*to].run;
        const std::size_t skipped =
            runs_on ? twin.sample - run.begin : run.end - 1 - twin.sample;
        if (skipped > kMaxSkipped) continue;
        return EndPair{
            static_cast<double>(k + skipped), end, 2 * *to + (runs_on ? 1 : 0)};
      }
    }
    return std::nullopt;
  }

  bool IsOfOtherKind(std::size_t a, std::size_t b) const {
    return pieces_[a].curve.is_occluding_contour !=
           pieces_[b].curve.is_occluding_contour;
  }

  // Takes away what of the second curve lies beside the first, not beyond it.
  void TrimSecond(EndIdx first,
                  EndIdx second,
                  std::vector<Curve>& curves) const {
    const Curve& curve = curves[ItemOf(first)];
    const CurveSample& from =
        IsFront(first) ? curve.samples.back() : curve.samples.front();
    const Eigen::Vector3d outward =
        IsFront(first) ? from.tangent : Eigen::Vector3d(-from.tangent);
    const double min_step =
        kMinStepPx * PixelSize(from.position, from.support, views_);
    std::vector<CurveSample>& next = curves[ItemOf(second)].samples;
    while (next.size() > 2) {
      const auto nearest = IsFront(second) ? next.end() - 1 : next.begin();
      if (outward.dot(nearest->position - from.position) >= min_step) break;
      next.erase(nearest);
    }
  }

  std::vector<Piece> pieces_;
  const std::vector<PosedView>& views_;
  const TwinSamples twins_;
  std::vector<Stretch> stretches_;
  std::vector<std::vector<std::optional<std::size_t>>> stretch_of_;
};

}  // namespace

std::vector<Curve> JoinCurvesOfParts(
    const ScenePartition& partition,
    std::vector<std::vector<Curve>> curves_of_parts,
    const std::vector<PosedView>& views,
    const Options& options) {
  Joiner joiner(partition,
                Flatten(std::move(curves_of_parts)),
                views,
                options.connectivity);
  return DropLooseShortCurves(
      joiner.Join(), views, options.curve_refinement.min_length_px);
}

}  // namespace curvix
