// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/line_or_arc.h"

#include <Eigen/Geometry>

namespace curvix {
namespace {

LineOrArc FromLine(const FitIndex& index, const CurveFit& fit) {
  LineOrArc line;
  line.index = index;
  line.fit = &fit;
  const Eigen::Vector3d chord = fit.end - fit.start;
  line.size = chord.norm();
  line.along = chord / line.size;
  line.point = (fit.start + fit.end) / 2;
  const Eigen::Matrix3d sum = fit.start_covariance + fit.end_covariance;
  const Eigen::Matrix3d across =
      Eigen::Matrix3d::Identity() - line.along * line.along.transpose();
  line.along_covariance = across * sum * across / chord.squaredNorm();
  line.point_covariance = sum / 4;
  return line;
}

LineOrArc FromArc(const FitIndex& index, const CurveFit& fit) {
  LineOrArc arc;
  arc.index = index;
  arc.fit = &fit;
  arc.size = fit.major.norm();
  arc.along = fit.major.cross(fit.minor).normalized();
  arc.along_covariance = fit.arc_covariance.block<3, 3>(3, 3);
  arc.point = fit.center;
  arc.point_covariance = fit.arc_covariance.topLeftCorner<3, 3>();
  return arc;
}

}  // namespace

std::vector<LineOrArc> LinesAndArcs(const FittedCurves& fitted) {
  std::vector<LineOrArc> features;
  for (std::size_t c = 0; c < fitted.curves.size(); ++c) {
    const std::vector<CurveFit>& fits = fitted.curves[c].fits;
    for (std::size_t f = 0; f < fits.size(); ++f) {
      const CurveFit& fit = fits[f];
      if (fit.kind == FitKind::kLine && (fit.end - fit.start).norm() > 0) {
        features.push_back(FromLine({c, f}, fit));
      } else if (fit.kind == FitKind::kArc && fit.arc_covariance.allFinite()) {
        features.push_back(FromArc({c, f}, fit));
      }
    }
  }
  return features;
}

}  // namespace curvix
