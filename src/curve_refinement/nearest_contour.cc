// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/nearest_contour.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/infinity.h"

namespace curvix {
namespace {

// The probability that a view shows a contour, or an edge, that exists.
constexpr double kShown = 0.5;
// Least number of other contours per pixel across the curve.
constexpr double kMinDensity = 0.02;
// So many edges of a contour are found beside a place.
constexpr double kEdgesPerContour = 2;
// A contour further away explains nothing: exp(-72) is lost beside 1 - kShown.
constexpr double kFarSigmas = 12;

}  // namespace

double NearestResidual(const std::vector<double>& edges_px, double at_px) {
  const auto above = std::ranges::lower_bound(edges_px, at_px);
  double nearest = above == edges_px.end() ? kInfinity : *above - at_px;
  if (above != edges_px.begin() && at_px - *(above - 1) < nearest) {
    nearest = *(above - 1) - at_px;
  }
  return nearest;
}

double LogLikelihoodOfContour(double residual_px,
                              double sigma_px,
                              double density) {
  if (!std::isfinite(residual_px)) return 0;
  const double r = residual_px / sigma_px;
  if (std::abs(r) > kFarSigmas) return std::log(1 - kShown);
  const double of_contour =
      std::exp(-0.5 * r * r) / (std::sqrt(2 * kPi) * sigma_px);
  return std::log(1 - kShown + kShown * of_contour / density);
}

double DensityOfContours(double num_edges, double num_views, double reach_px) {
  return std::max(kMinDensity,
                  num_edges / (kEdgesPerContour * 2 * reach_px * num_views));
}

}  // namespace curvix
