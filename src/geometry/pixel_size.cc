// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pixel_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/check.h"
#include "base/infinity.h"
#include "base/median.h"
#include "model/curve_chains.h"

namespace curvix {

double PixelSizeIn(const PosedView& view, const Eigen::Vector3d& position) {
  const double depth = view.InCamera(position).z();
  const double focal =
      std::sqrt(view.calibration(0, 0) * view.calibration(1, 1));
  return depth > 0 ? depth / focal : kInfinity;
}

double PixelSize(const Eigen::Vector3d& position,
                 const std::vector<EdgeRef>& support,
                 const std::vector<PosedView>& views) {
  double smallest = kInfinity;
  for (const EdgeRef& ref : support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    CURVIX_CHECK(view_idx < views.size(), "there is no view " << ref.view_idx);
    smallest = std::min(smallest, PixelSizeIn(views[view_idx], position));
  }
  if (smallest < kInfinity) return smallest;
  double smallest_outside = kInfinity;
  for (const PosedView& view : views) {
    const Eigen::Vector3d in_camera = view.InCamera(position);
    if (!(in_camera.z() > 0)) continue;
    double& least =
        view.Contains(view.Pixel(in_camera)) ? smallest : smallest_outside;
    least = std::min(least, PixelSizeIn(view, position));
  }
  if (smallest < kInfinity) return smallest;
  return smallest_outside < kInfinity ? smallest_outside : 0;
}

double PixelSizeAlong(const SpaceEdge& edge,
                      const std::vector<EdgeRef>& support,
                      const std::vector<PosedView>& views) {
  double largest = -1;  // pixels per world unit
  for (const EdgeRef& ref : support) {
    const PosedView& view = views[static_cast<std::size_t>(ref.view_idx)];
    const Eigen::Vector3d in_camera = view.InCamera(edge.position);
    if (!(in_camera.z() > 0)) continue;
    // Of the pixel K x / z, x on the edge.
    const Eigen::Vector3d along = view.rotation * edge.tangent;
    const Eigen::Vector3d speed =
        view.calibration * (along - along.z() / in_camera.z() * in_camera) /
        in_camera.z();
    largest = std::max(largest, speed.head<2>().norm());
  }
  return largest < 0 ? 0 : 1 / largest;
}

std::vector<double> PixelSizes(const std::vector<Edge3d>& edges,
                               const std::vector<PosedView>& views) {
  std::vector<double> sizes;
  sizes.reserve(edges.size());
  for (const Edge3d& edge : edges) {
    sizes.push_back(PixelSize(edge, views));
  }
  return sizes;
}

double PixelSize(const Curve& curve, const std::vector<PosedView>& views) {
  std::vector<double> sizes;
  for (const CurveSample& sample : curve.samples) {
    sizes.push_back(PixelSize(sample, views));
  }
  return MedianOr(0, std::move(sizes));
}

double LengthInPixels(const Curve& curve, const std::vector<PosedView>& views) {
  const std::size_t size = curve.samples.size();
  const std::size_t num_segments = size - (curve.closed || size == 0 ? 0 : 1);
  double length_px = 0;
  for (std::size_t k = 0; k < num_segments; ++k) {
    const CurveSample& a = curve.samples[k];
    const CurveSample& b = curve.samples[(k + 1) % size];
    const double unit = std::min(PixelSize(a, views), PixelSize(b, views));
    if (unit > 0) length_px += (b.position - a.position).norm() / unit;
  }
  return length_px;
}

bool IsShort(const Curve& curve,
             const std::vector<PosedView>& views,
             double min_length_px) {
  return curve.samples.size() < 2 ||
         LengthInPixels(curve, views) < min_length_px;
}

bool LeadsSomewhere(const Curve& curve) {
  return curve.start_junction >= 0 && curve.end_junction >= 0 &&
         curve.start_junction != curve.end_junction;
}

std::vector<Curve> DropLooseShortCurves(std::vector<Curve> curves,
                                        const std::vector<PosedView>& views,
                                        double min_length_px) {
  CurveSet set{std::move(curves), {}};
  IndexJunctions(set);
  std::erase_if(set.curves, [&](const Curve& curve) {
    return !LeadsSomewhere(curve) && IsShort(curve, views, min_length_px);
  });
  return std::move(set.curves);
}

}  // namespace curvix
