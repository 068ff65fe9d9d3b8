// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Planes for curves whose depth images hardly
// determine.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "curve_refinement/refine_curves.h"
#include "geometry/adjust_edge.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumFlattened = 6;
// Largest root mean square of the distances, in an image, between the curve
// and what it is in the plane, over the sigma of 2D edges.
constexpr double kMaxDistanceSigmas = 4;
// Least distance in space, in pixels, as a multiple of that in images.
constexpr double kMinDepthRatio = 3;
// Views that support fewer of the samples do not count alone.
constexpr double kMinSampleShare = 0.25;
// A weak prior against planes seen edge-on: a slope of one towards the rays
// counts as an error of so many pixels in every 2D edge.
constexpr double kSlopePx = 0.1;
// Samples lie no nearer than this share of the depth of the middle, and no
// farther than the depth over it.
constexpr double kMinDepthShare = 0.05;
constexpr int kMaxNumFlattenSteps = 20;
constexpr double kMinFlattenStep = 1e-7;

using Places = std::vector<Eigen::Vector3d>;  // by sample

// The rays from the mean centre of the supporting cameras to the samples.
struct Rays {
  Eigen::Vector3d center;
  Eigen::Vector3d axis;  // unit, to the middle of the curve
  double depth = 0;      // of the middle, along the axis
  Places directions;     // of depth 1

  // Where ray k meets the plane n . (X - center) = depth, over that of the
  // middle: linear in n.
  double InverseDepth(std::size_t k, const Eigen::Vector3d& n) const {
    return n.dot(directions[k]);
  }
  Eigen::Vector3d At(std::size_t k, double inverse_depth) const {
    return center + depth / inverse_depth * directions[k];
  }
};

// nullopt if a sample is not in front.
std::optional<Rays> RaysTo(const Curve& curve, const Eigen::Vector3d& center) {
  const auto size = static_cast<double>(curve.samples.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const CurveSample& sample : curve.samples) {
    middle += (sample.position - center) / size;
  }
  Rays rays;
  rays.center = center;
  rays.depth = middle.norm();
  if (!(rays.depth > 0)) return std::nullopt;
  rays.axis = middle / rays.depth;
  for (const CurveSample& sample : curve.samples) {
    const Eigen::Vector3d offset = sample.position - center;
    const double depth = rays.axis.dot(offset);
    if (!(depth > kMinDepthShare * rays.depth)) return std::nullopt;
    rays.directions.push_back(offset / depth);
  }
  return rays;
}

// One curve and what images measure of it.
class CurveFlattener {
 public:
  CurveFlattener(const Curve& curve,
                 double pixel,
                 const RefinementInput& input,
                 const ResponseCurve& response)
      : curve_(curve), pixel_(pixel), sigma_px_(input.edge_sigma_px) {
    for (std::size_t k = 0; k < curve.samples.size(); ++k) {
      measured_.push_back(MeasureUnblurred(curve, k, pixel, input, response));
      for (const PlaneMeasurement& m : measured_[k]) {
        sum_of_centers_ += m.center;
        num_measured_ += 1;
      }
    }
  }

  // The samples in the plane that agrees best with the 2D edges; nullopt if
  // there is none that the rays meet.
  std::optional<Places> PlacesInPlane() const {
    if (!(num_measured_ > 0)) return std::nullopt;
    const std::optional<Rays> rays =
        RaysTo(curve_, sum_of_centers_ / num_measured_);
    if (!rays) return std::nullopt;
    Eigen::Vector3d plane = rays->axis;
    for (int i = 0; i < kMaxNumFlattenSteps; ++i) {
      const std::optional<Eigen::Vector3d> step = StepOf(plane, *rays);
      if (!step) return std::nullopt;
      plane += *step;
      if (step->norm() < kMinFlattenStep) break;
    }
    Places places;
    for (std::size_t k = 0; k < measured_.size(); ++k) {
      const double inverse_depth = rays->InverseDepth(k, plane);
      if (!(inverse_depth > kMinDepthShare)) return std::nullopt;
      places.push_back(rays->At(k, inverse_depth));
    }
    return places;
  }

  // Whether images allow these places and hardly tell them from the samples.
  bool LookAlike(const Places& places) const {
    struct Sum {
      double squares = 0;
      double count = 0;
      double RootMeanSquare() const { return std::sqrt(squares / count); }
    };
    std::map<std::int32_t, Sum> by_view;
    Sum in_images, in_space;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const CurveSample& sample = curve_.samples[k];
      in_space.squares += (places[k] - sample.position).squaredNorm();
      in_space.count += pixel_ * pixel_;
      for (std::size_t i = 0; i < measured_[k].size(); ++i) {
        const double px = DistanceFrom(measured_[k][i], places[k]).px -
                          DistanceFrom(measured_[k][i], sample.position).px;
        for (Sum* sum : {&by_view[sample.support[i].view_idx], &in_images}) {
          sum->squares += px * px;
          sum->count += 1;
        }
      }
    }
    const double min_count =
        kMinSampleShare * static_cast<double>(places.size());
    return in_space.RootMeanSquare() >
               kMinDepthRatio * in_images.RootMeanSquare() &&
           std::ranges::all_of(by_view, [&](const auto& view) {
             return view.second.count < min_count ||
                    view.second.RootMeanSquare() <=
                        kMaxDistanceSigmas * sigma_px_;
           });
  }

 private:
  // Of Gauss-Newton, with Cauchy's weights.
  std::optional<Eigen::Vector3d> StepOf(const Eigen::Vector3d& plane,
                                        const Rays& rays) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < measured_.size(); ++k) {
      const double inverse_depth = rays.InverseDepth(k, plane);
      if (!(inverse_depth > kMinDepthShare)) return std::nullopt;
      const Eigen::Vector3d place = rays.At(k, inverse_depth);
      const Eigen::Vector3d derivative = (rays.center - place) / inverse_depth;
      for (const PlaneMeasurement& m : measured_[k]) {
        const SeenDistance distance = DistanceFrom(m, place);
        const Eigen::Vector3d row =
            distance.gradient.dot(derivative) * rays.directions[k];
        const double weight = CauchyWeight(distance.px, sigma_px_);
        normal += weight * row * row.transpose();
        right -= weight * distance.px * row;
      }
    }
    const Eigen::Matrix3d prior =
        kSlopePx * kSlopePx * num_measured_ *
        (Eigen::Matrix3d::Identity() - rays.axis * rays.axis.transpose());
    normal += prior;
    right -= prior * plane;
    const Eigen::Vector3d step = normal.ldlt().solve(right);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

  const Curve& curve_;
  double pixel_;  // world units
  double sigma_px_;
  std::vector<std::vector<PlaneMeasurement>> measured_;  // by sample
  Eigen::Vector3d sum_of_centers_ = Eigen::Vector3d::Zero();
  double num_measured_ = 0;
};

void FlattenCurve(const RefinementInput& input,
                  const ResponseCurve& response,
                  Curve& curve) {
  if (curve.samples.size() < kMinNumFlattened) return;
  const double pixel = PixelSize(curve, input.views);
  if (!(pixel > 0)) return;
  const CurveFlattener flattener(curve, pixel, input, response);
  const std::optional<Places> places = flattener.PlacesInPlane();
  if (!places || !flattener.LookAlike(*places)) return;
  for (std::size_t k = 0; k < places->size(); ++k) {
    curve.samples[k].position = (*places)[k];
  }
  SetTangentsAlongChords(curve);
}

}  // namespace

std::vector<Curve> FlattenCurves(std::vector<Curve> curves,
                                 const RefinementInput& input,
                                 const ResponseCurve& response) {
  if (!(input.options.smoothing_px > 0)) return curves;
  ForEachCurve(curves.size(), input, [&](std::size_t i) {
    FlattenCurve(input, response, curves[i]);
  });
  return curves;
}

}  // namespace curvix
