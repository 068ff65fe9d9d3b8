// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against images, by their image files.
#include <curvix/curves.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/infinity.h"
#include "base/parallel.h"
#include "edge_detection/load_image.h"
#include "evaluation/image_agreement.h"
#include "geometry/pixel_size.h"
#include "model/posed_view.h"

namespace curvix {
namespace {

constexpr double kSpacingPx = 2;
constexpr double kBorderPx = 2;

bool IsSupportedBy(const CurveSample& sample, std::size_t view_idx) {
  return std::ranges::any_of(sample.support, [&](const EdgeRef& ref) {
    return ref.view_idx == static_cast<std::int32_t>(view_idx);
  });
}

// Draws curves in one view.
class Pen {
 public:
  // `used`: the views that curves may have been made of.
  Pen(const Scene& scene,
      const std::vector<PosedView>& views,
      std::size_t view_idx,
      std::vector<std::size_t> used)
      : views_(views),
        posed_view_(views[view_idx]),
        view_(scene.views[view_idx]),
        camera_(CameraOf(scene, view_)),
        used_(std::move(used)) {}

  DrawnCurve Draw(const Curve& curve) const {
    const std::vector<CurveSample>& samples = curve.samples;
    DrawnCurve drawn;
    const std::size_t num_segments = samples.size() - (curve.closed ? 0 : 1);
    for (std::size_t i = 0; i < num_segments; ++i) {
      DrawSegment(
          samples[i], samples[(i + 1) % samples.size()].position, &drawn);
    }
    return drawn;
  }

 private:
  // In pieces short enough for lenses that bend lines, and for lines that are
  // in the image only in part.
  void DrawSegment(const CurveSample& from,
                   const Eigen::Vector3d& to,
                   DrawnCurve* drawn) const {
    const Eigen::Vector3d along = to - from.position;
    const int n = NumPieces(from.position, to);
    const bool is_expected = IsExpected(from);
    std::optional<Eigen::Vector2d> begin =
        ProjectPoint(from.position, view_, camera_);
    const std::size_t first = drawn->size();
    double length_px = 0;
    for (int i = 1; i <= n; ++i) {
      const std::optional<Eigen::Vector2d> end =
          ProjectPoint(from.position + i * along / n, view_, camera_);
      if (begin && end) {
        DrawStep(*begin, *end, is_expected, drawn);
        length_px += (*end - *begin).norm();
      }
      begin = end;
    }
    const double num_steps = std::ceil(length_px / kSpacingPx);
    for (std::size_t i = first; i < drawn->size(); ++i) {
      DrawnPlace& place = (*drawn)[i];
      place.num_steps = num_steps * place.length_px / length_px;
    }
  }

  int NumPieces(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    constexpr double kMaxPieces = 10000;
    const double pixel =
        std::min(PixelSizeIn(posed_view_, from), PixelSizeIn(posed_view_, to));
    if (!(pixel < kInfinity)) return 1;
    const double pieces = (to - from).norm() / (kSpacingPx * pixel);
    return static_cast<int>(std::clamp(std::ceil(pieces), 1.0, kMaxPieces));
  }

  void DrawStep(const Eigen::Vector2d& from,
                const Eigen::Vector2d& to,
                bool is_expected,
                DrawnCurve* drawn) const {
    const Eigen::Vector2d along = to - from;
    const double length_px = along.norm();
    if (!(length_px > 0)) return;
    const int n = static_cast<int>(std::ceil(length_px / kSpacingPx));
    for (int i = 0; i < n; ++i) {
      DrawnPlace place;
      place.edge.position = from + (i + 0.5) / n * along;
      place.edge.angle = static_cast<float>(std::atan2(along.y(), along.x()));
      place.length_px = length_px / n;
      place.is_expected = is_expected;
      if (IsInside(place.edge.position)) drawn->push_back(place);
    }
  }

  bool IsInside(const Eigen::Vector2d& position) const {
    return position.x() >= kBorderPx && position.y() >= kBorderPx &&
           position.x() <= camera_.width - kBorderPx &&
           position.y() <= camera_.height - kBorderPx;
  }

  // Of the views used, the two in most like direction support the sample. Of
  // views in equally like direction the smaller index comes first.
  bool IsExpected(const CurveSample& sample) const {
    if (used_.size() < 2 || sample.support.empty()) return false;
    const Eigen::Vector3d direction = Direction(posed_view_, sample);
    std::pair<double, std::size_t> best(-2, 0), second(-2, 0);
    for (const std::size_t i : used_) {
      const std::pair<double, std::size_t> candidate(
          direction.dot(Direction(views_[i], sample)), i);
      if (candidate.first > best.first) {
        second = std::exchange(best, candidate);
      } else if (candidate.first > second.first) {
        second = candidate;
      }
    }
    return IsSupportedBy(sample, best.second) &&
           IsSupportedBy(sample, second.second);
  }

  static Eigen::Vector3d Direction(const PosedView& view,
                                   const CurveSample& sample) {
    return (view.center - sample.position).normalized();
  }

  const std::vector<PosedView>& views_;
  const PosedView& posed_view_;
  const View& view_;
  const Camera& camera_;
  std::vector<std::size_t> used_;
};

Result<ImageTally> CompareWithView(const std::vector<Curve>& curves,
                                   const Scene& scene,
                                   const std::vector<PosedView>& views,
                                   std::size_t view_idx,
                                   std::vector<std::size_t> used) {
  const View& view = scene.views[view_idx];
  CURVIX_ASSIGN_OR_RETURN(const GrayImage image,
                          LoadGrayImage(view, CameraOf(scene, view)));
  const Pen pen(scene, views, view_idx, std::move(used));
  std::vector<DrawnCurve> drawn;
  for (const Curve& curve : curves) {
    if (curve.samples.empty()) continue;
    DrawnCurve in_view = pen.Draw(curve);
    if (!in_view.empty()) drawn.push_back(std::move(in_view));
  }
  return CompareWithImage(drawn, FindContours(image), FindLongLines(image));
}

}  // namespace

Result<ImageAgreement> CompareWithImages(const std::vector<Curve>& curves,
                                         const Scene& scene,
                                         const std::vector<int>& view_idxs,
                                         int num_threads) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (std::ranges::find(view_idxs, static_cast<int>(i)) == view_idxs.end()) {
      used.push_back(i);
    }
  }
  const std::vector<PosedView> views = MakePosedViews(scene);
  std::vector<std::optional<Result<ImageTally>>> tallies(view_idxs.size());
  ParallelFor(view_idxs.size(), num_threads, [&](std::size_t i) {
    tallies[i] = CompareWithView(
        curves, scene, views, static_cast<std::size_t>(view_idxs[i]), used);
  });
  ImageTally total;
  for (const std::optional<Result<ImageTally>>& tally : tallies) {
    if (!tally->ok()) return tally->status();
    total.Add(**tally);
  }
  return total.Summarize();
}

}  // namespace curvix
