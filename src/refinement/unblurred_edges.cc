// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/unblurred_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/image_edge.h"
#include "refinement/samples_around.h"

namespace curvix {
namespace {

constexpr double kReachPx = 4;
constexpr double kMaxShiftPx = 0.25;
constexpr double kWhite = 255;
constexpr double kMinLevel = 0.015;  // below it, dark is as good as black

// 1 / radius of the circle through the projections, times the direction away
// from its centre; zero where a place is not in front of the view.
Eigen::Vector2d OutwardCurvature(const PosedView& view, const Bend& bend) {
  std::array<Eigen::Vector2d, 3> p;
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Eigen::Vector3d in_camera = view.InCamera(bend[j]);
    if (!(in_camera.z() > 0)) return Eigen::Vector2d::Zero();
    p[j] = view.Pixel(in_camera);
  }
  const Eigen::Vector2d a = p[1] - p[0];
  const Eigen::Vector2d b = p[2] - p[1];
  const Eigen::Vector2d chord = p[2] - p[0];
  const double twice_area = a.x() * b.y() - a.y() * b.x();
  const double sides = a.norm() * b.norm() * chord.squaredNorm();
  if (sides == 0) return Eigen::Vector2d::Zero();
  return 2 * twice_area / sides * Eigen::Vector2d(chord.y(), -chord.x());
}

// To where the edge of a curve that bends like this would be without blur.
Eigen::Vector2d BendShift(const Edge2d& edge,
                          const PosedView& view,
                          const Bend& bend) {
  const Eigen::Vector2d shift =
      OutwardCurvature(view, bend) / (2 * static_cast<double>(edge.sharpness));
  const double length = shift.norm();
  return length > kMaxShiftPx ? kMaxShiftPx / length * shift : shift;
}

}  // namespace

std::optional<Bend> BendAround(const Curve& curve,
                               std::size_t index,
                               double pixel) {
  std::vector<SampleAround> around =
      SamplesAround(curve, index, kReachPx * pixel);
  if (around.size() < 3) return std::nullopt;
  const auto by_place = [](const SampleAround& a, const SampleAround& b) {
    return a.along < b.along;
  };
  std::sort(around.begin(), around.end(), by_place);
  const double middle = (around.front().along + around.back().along) / 2;
  const auto between = std::lower_bound(
      around.begin() + 1, around.end() - 2, SampleAround{0, middle}, by_place);
  return Bend{curve.samples[around.front().index].position,
              curve.samples[between->index].position,
              curve.samples[around.back().index].position};
}

Eigen::Vector2d ToneLever(const Edge2d& edge) {
  if (!(edge.sharpness > 0)) return Eigen::Vector2d::Zero();
  const double level = static_cast<double>(edge.level) / kWhite;
  const double half_contrast =
      static_cast<double>(edge.strength) / kWhite *
      std::sqrt(std::numbers::pi / 2 / static_cast<double>(edge.sharpness));
  const bool is_clipped = level - half_contrast < kMinLevel ||
                          level + half_contrast > 1 - kMinLevel;
  if (is_clipped) return Eigen::Vector2d::Zero();
  return {half_contrast / level, half_contrast / (1 - level)};
}

ImageEdge Unblurred(const Edge2d& edge,
                    const PosedView& view,
                    const std::optional<Bend>& bend,
                    const ToneCurve& tone) {
  ImageEdge unblurred = ToImageEdge(edge);
  if (!(edge.sharpness > 0)) return unblurred;
  const Eigen::Vector2d to_bright(-unblurred.tangent.y(),
                                  unblurred.tangent.x());
  unblurred.position += ToneLever(edge).dot(tone.px) * to_bright;
  if (bend) unblurred.position += BendShift(edge, view, *bend);
  return unblurred;
}

}  // namespace curvix
