// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/response_curve.h"

#include <Eigen/Dense>
#include <algorithm>

#include "base/parallel.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/detected_edge.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr double kResponseReachPx = 4;
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

// To where the edge of a curve that bends like this, blurred by this variance,
// would be without blur.
Eigen::Vector2d BendShift(double variance_px2,
                          const PosedView& view,
                          const Bend& bend) {
  const Eigen::Vector2d shift = OutwardCurvature(view, bend) * variance_px2 / 2;
  const double length = shift.norm();
  return length > kMaxShiftPx ? kMaxShiftPx / length * shift : shift;
}

}  // namespace

std::optional<Bend> BendAround(const Curve& curve,
                               std::size_t index,
                               double pixel) {
  std::vector<SampleAround> around =
      SamplesAround(curve, index, kResponseReachPx * pixel);
  if (around.size() < 3) return std::nullopt;
  std::ranges::sort(around, {}, &SampleAround::along);
  const double middle = (around.front().along + around.back().along) / 2;
  const auto between = std::ranges::lower_bound(
      around.begin() + 1, around.end() - 2, middle, {}, &SampleAround::along);
  return Bend{curve.samples[around.front().index].position,
              curve.samples[between->index].position,
              curve.samples[around.back().index].position};
}

Eigen::Vector2d ResponseShift(const Edge2d& edge) {
  if (!(edge.sharpness > 0)) return Eigen::Vector2d::Zero();
  const double level = static_cast<double>(edge.level) / kWhite;
  const double half_contrast = HalfContrast(edge) / kWhite;
  const bool is_clipped = level - half_contrast < kMinLevel ||
                          level + half_contrast > 1 - kMinLevel;
  if (is_clipped) return Eigen::Vector2d::Zero();
  return {half_contrast / level, half_contrast / (1 - level)};
}

ImageEdge Unblurred(const Edge2d& edge,
                    const PosedView& view,
                    const std::optional<Bend>& bend,
                    const ResponseCurve& response,
                    double fine_variance_gain_px2) {
  ImageEdge unblurred = ToImageEdge(edge);
  const Eigen::Vector2d to_bright = unblurred.Normal();
  const bool is_fine = edge.fine_px != Eigen::half(0);
  unblurred.position += static_cast<double>(edge.fine_px) * to_bright;
  if (!(edge.sharpness > 0)) return unblurred;
  unblurred.position += ResponseShift(edge).dot(response.px) * to_bright;
  if (bend) {
    const double variance_px2 = 1 / static_cast<double>(edge.sharpness) -
                                (is_fine ? fine_variance_gain_px2 : 0);
    unblurred.position += BendShift(std::max(0.0, variance_px2), view, *bend);
  }
  return unblurred;
}

std::vector<PlaneMeasurement> MeasureUnblurred(const Curve& curve,
                                               std::size_t index,
                                               double pixel,
                                               const RefinementInput& input,
                                               const ResponseCurve& response) {
  const std::optional<Bend> bend = BendAround(curve, index, pixel);
  std::vector<PlaneMeasurement> measurements;
  for (const EdgeRef& ref : curve.samples[index].support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    const PosedView& view = input.views[view_idx];
    measurements.push_back(MeasurePlane(
        view,
        Unblurred(EdgeOf(ref, input.edge_maps),
                  view,
                  bend,
                  response,
                  input.edge_maps[view_idx].fine_variance_gain_px2)));
  }
  return measurements;
}

namespace {

constexpr double kResponseStepPx = 10;
constexpr std::size_t kMinNumEdges = 4;
constexpr double kResponsePrior = 1;  // sum of squared levers
constexpr int kMaxNumRounds = 10;
constexpr double kConvergedPx = 0.003;

// Those of least squares: the least of p^T matrix p - 2 vector^T p.
struct NormalEquations {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d vector = Eigen::Vector2d::Zero();

  void operator+=(const NormalEquations& other) {
    matrix += other.matrix;
    vector += other.vector;
  }
  double Cost(const Eigen::Vector2d& p) const {
    return p.dot(matrix * p) - 2 * vector.dot(p);
  }
};

// Of what is still missing in the response curve at a sample, without what
// moving the sample across the curve explains as well. `pixel`: the size of a
// pixel there, world units.
NormalEquations WithoutMoving(const Curve& curve,
                              std::size_t index,
                              double pixel,
                              const RefinementInput& input,
                              const ResponseCurve& response) {
  const CurveSample& sample = curve.samples[index];
  const std::vector<PlaneMeasurement> measurements =
      MeasureUnblurred(curve, index, pixel, input, response);
  const SpaceEdge adjusted =
      AdjustEdge(
          {sample.position, sample.tangent}, measurements, input.edge_sigma_px)
          .edge;
  const AcrossAxes axes = AxesAcross(adjusted.tangent);
  NormalEquations missing, moving;
  Eigen::Matrix2d mixed = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const SeenDistance distance =
        DistanceFrom(measurements[i], adjusted.position);
    const double weight = CauchyWeight(distance.px, input.edge_sigma_px);
    const Eigen::Vector2d lever =
        ResponseShift(EdgeOf(sample.support[i], input.edge_maps));
    const Eigen::Vector2d gradient = axes.transpose() * distance.gradient;
    missing.matrix += weight * lever * lever.transpose();
    missing.vector += weight * distance.px * lever;
    moving.matrix += weight * gradient * gradient.transpose();
    moving.vector += weight * distance.px * gradient;
    mixed += weight * lever * gradient.transpose();
  }
  const Eigen::Matrix2d explained = mixed * moving.matrix.inverse();
  missing.matrix -= explained * mixed.transpose();
  missing.vector -= explained * moving.vector;
  if (!missing.matrix.allFinite() || !missing.vector.allFinite()) return {};
  return missing;
}

NormalEquations OfCurve(const Curve& curve,
                        const RefinementInput& input,
                        const ResponseCurve& response) {
  NormalEquations sum;
  double since_last_px = kResponseStepPx;
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    const CurveSample& sample = curve.samples[k];
    const double pixel = PixelSize(sample, input.views);
    if (k > 0) {
      since_last_px +=
          (sample.position - curve.samples[k - 1].position).norm() / pixel;
    }
    if (since_last_px < kResponseStepPx ||
        sample.support.size() < kMinNumEdges) {
      continue;
    }
    since_last_px = 0;
    sum += WithoutMoving(curve, k, pixel, input, response);
  }
  return sum;
}

// The least where neither component is below 0.
Eigen::Vector2d SolveNotNegative(const NormalEquations& sum) {
  const Eigen::Vector2d free = sum.matrix.ldlt().solve(sum.vector);
  if (free.minCoeff() >= 0) return free;
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2; ++i) {
    Eigen::Vector2d one = Eigen::Vector2d::Zero();
    one[i] = std::max(0.0, sum.vector[i] / sum.matrix(i, i));
    if (sum.Cost(one) < sum.Cost(best)) best = one;
  }
  return best;
}

}  // namespace

ResponseCurve EstimateResponseCurve(const std::vector<Curve>& curves,
                                    const RefinementInput& input) {
  ResponseCurve response;
  for (int round = 0; round < kMaxNumRounds; ++round) {
    std::vector<NormalEquations> of_curves(curves.size());
    ForEachCurve(curves.size(), input, [&](std::size_t i) {
      of_curves[i] = OfCurve(curves[i], input, response);
    });
    NormalEquations sum;
    for (const NormalEquations& of_curve : of_curves) sum += of_curve;
    sum.vector +=
        sum.matrix * response.px;  // from what is missing to the whole
    sum.matrix += kResponsePrior * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d px = SolveNotNegative(sum);
    const double change = (px - response.px).norm();
    response.px = px;
    if (change < kConvergedPx) break;
  }
  return response;
}

}  // namespace curvix
