// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against photographs, by their image files.
#include <curvix/holdout.h>
#include <curvix/project_curve.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "edge_detection/load_image.h"
#include "evaluation/image_contours.h"
#include "evaluation/photograph_agreement.h"

namespace curvix {
namespace {

constexpr double kSpacingPx = 2;
constexpr double kBorderPx = 2;

bool IsSupportedBy(const CurveSample& sample, std::size_t view_idx) {
  return std::any_of(
      sample.support.begin(), sample.support.end(), [&](const EdgeRef& ref) {
        return ref.view_idx == static_cast<std::int32_t>(view_idx);
      });
}

// Draws curves in one view.
class Pen {
 public:
  // `used`: the views that curves may have been made of.
  Pen(const Scene& scene, std::size_t view_idx, std::vector<std::size_t> used)
      : scene_(scene),
        view_(scene.views[view_idx]),
        camera_(scene.cameras[static_cast<std::size_t>(view_.camera_idx)]),
        used_(std::move(used)) {}

  DrawnCurve Draw(const Curve& curve) const {
    const std::vector<CurveSample>& samples = curve.samples;
    std::vector<std::optional<Eigen::Vector2d>> pixels;
    pixels.reserve(samples.size());
    for (const CurveSample& sample : samples) {
      pixels.push_back(ProjectPoint(sample.position, view_, camera_));
    }
    DrawnCurve drawn;
    const std::size_t num_steps = samples.size() - (curve.closed ? 0 : 1);
    for (std::size_t i = 0; i < num_steps; ++i) {
      const auto& from = pixels[i];
      const auto& to = pixels[(i + 1) % samples.size()];
      if (from && to) DrawStep(*from, *to, IsExpected(samples[i]), &drawn);
    }
    return drawn;
  }

 private:
  void DrawStep(const Eigen::Vector2d& from,
                const Eigen::Vector2d& to,
                bool is_expected,
                DrawnCurve* drawn) const {
    const Eigen::Vector2d along = to - from;
    const double length_px = along.norm();
    if (!(length_px > 0)) return;
    const int n = static_cast<int>(std::ceil(length_px / kSpacingPx));
    for (int i = 0; i < n; ++i) {
      Edge2d place;
      place.position = from + (i + 0.5) / n * along;
      place.angle = static_cast<float>(std::atan2(along.y(), along.x()));
      if (!IsInside(place.position)) continue;
      drawn->places.push_back(place);
      drawn->is_expected.push_back(is_expected);
      drawn->length_px += length_px / n;
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
    const Eigen::Vector3d direction = Direction(view_, sample);
    std::pair<double, std::size_t> best(-2, 0), second(-2, 0);
    for (const std::size_t i : used_) {
      const std::pair<double, std::size_t> candidate(
          direction.dot(Direction(scene_.views[i], sample)), i);
      if (candidate.first > best.first) {
        second = std::exchange(best, candidate);
      } else if (candidate.first > second.first) {
        second = candidate;
      }
    }
    return IsSupportedBy(sample, best.second) &&
           IsSupportedBy(sample, second.second);
  }

  static Eigen::Vector3d Direction(const View& view,
                                   const CurveSample& sample) {
    const Eigen::Vector3d center =
        view.cam_from_world.Inverse().translation;
    return (center - sample.position).normalized();
  }

  const Scene& scene_;
  const View& view_;
  const Camera& camera_;
  std::vector<std::size_t> used_;
};

Result<PhotographTally> CompareWithView(const std::vector<Curve>& curves,
                                        const Scene& scene,
                                        std::size_t view_idx,
                                        std::vector<std::size_t> used) {
  const View& view = scene.views[view_idx];
  const Camera& camera =
      scene.cameras[static_cast<std::size_t>(view.camera_idx)];
  const Result<GrayImage> image =
      LoadGrayImage(view.image_path, ImageSize{camera.width, camera.height});
  if (!image.ok()) return image.status();
  const Pen pen(scene, view_idx, std::move(used));
  std::vector<DrawnCurve> drawn;
  for (const Curve& curve : curves) {
    if (curve.samples.empty()) continue;
    DrawnCurve in_view = pen.Draw(curve);
    if (!in_view.places.empty()) drawn.push_back(std::move(in_view));
  }
  return CompareWithPhotograph(
      drawn, FindContours(*image), FindLongLines(*image));
}

}  // namespace

Result<PhotographAgreement> CompareWithPhotographs(
    const std::vector<Curve>& curves,
    const Scene& scene,
    const std::vector<int>& view_idxs,
    int num_threads) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (std::find(view_idxs.begin(), view_idxs.end(), static_cast<int>(i)) ==
        view_idxs.end()) {
      used.push_back(i);
    }
  }
  std::vector<std::optional<Result<PhotographTally>>> tallies(view_idxs.size());
  ParallelFor(view_idxs.size(), num_threads, [&](std::size_t i) {
    tallies[i] = CompareWithView(
        curves, scene, static_cast<std::size_t>(view_idxs[i]), used);
  });
  PhotographTally total;
  for (const std::optional<Result<PhotographTally>>& tally : tallies) {
    if (!tally->ok()) return tally->status();
    total.Add(**tally);
  }
  return total.Summarize();
}

}  // namespace curvix
