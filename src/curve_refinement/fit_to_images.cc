// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves on the edges of all images.
#include "curve_refinement/refine_curves.h"

#include <ceres/ceres.h>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumFittedSamples = 6;
constexpr double kBendSigmaPx = 0.05;
constexpr double kKinkSigmas = 2;   // from here on bends count less
constexpr double kStiffness = 1.2;  // of the width of the smoothing
constexpr double kMinStepPx = 0.2;
constexpr int kMaxNumIterations = 15;
constexpr double kMinGain = 1e-3;  // of a step, share of the cost
// Under robust losses the fit can leave edges. Samples 2 px or more off are cut
// out.
constexpr double kMaxMissPx = 2;
// Wide: damping is in proportion to the bends, which are much stiffer than the
// edges, and would keep samples from these.
constexpr double kTrustRegionRadius = 1e10;

// A sample and the plane across it in which it moves, in pixels.
struct Station {
  Eigen::Vector3d start;
  AcrossAxes axes;  // world units per pixel

  Eigen::Vector3d At(const double* offset) const {
    return start + axes * Eigen::Vector2d(offset[0], offset[1]);
  }
};

// The distances z of a sample from its 2D edges, over sigma, in one cost:
// Ceres' share of the time grows with the number of costs. Ceres has one loss
// for a whole cost, so Cauchy's loss, log(1 + z^2), is in the residuals. Each
// edge has a residual z / sqrt(1 + z^2). The square of the last residual is the
// sum of the losses minus the squares of the others. Its Jacobian is set to 0,
// so that steps are those of iteratively reweighted least squares; with the
// roots of the losses as residuals, Gauss-Newton steps are too long far from
// the edges. `station` must outlive it.
class SupportCost : public ceres::CostFunction {
 public:
  SupportCost(const Station& station,
              std::vector<PlaneMeasurement> measured,
              double sigma_px)
      : station_(&station),
        measured_(std::move(measured)),
        sigma_px_(sigma_px) {
    set_num_residuals(static_cast<int>(measured_.size()) + 1);
    mutable_parameter_block_sizes()->push_back(2);
  }

  bool Evaluate(double const* const* offsets,
                double* residuals,
                double** jacobians) const override {
    const Eigen::Vector3d position = station_->At(offsets[0]);
    const bool has_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    double rest = 0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      const SeenDistance distance = DistanceFrom(measured_[i], position);
      const double z = distance.px / sigma_px_;
      const double weight = 1 / (1 + z * z);
      const double root = std::sqrt(weight);
      residuals[i] = root * z;
      rest += std::log1p(z * z) - weight * z * z;
      if (!has_jacobian) continue;
      Eigen::Map<Eigen::Vector2d>(jacobians[0] + 2 * i) =
          root / sigma_px_ * (station_->axes.transpose() * distance.gradient);
    }
    residuals[measured_.size()] = std::sqrt(std::max(0.0, rest));
    if (has_jacobian) {
      Eigen::Map<Eigen::Vector2d>(jacobians[0] + 2 * measured_.size())
          .setZero();
    }
    return true;
  }

  // From the 2D edges, with the sample at this offset.
  double MedianDistancePx(const double* offset) const {
    const Eigen::Vector3d position = station_->At(offset);
    std::vector<double> distances;
    for (const PlaneMeasurement& plane : measured_) {
      distances.push_back(std::abs(DistanceFrom(plane, position).px));
    }
    return Median(std::move(distances));
  }

  const Station* station() const { return station_; }

 private:
  const Station* station_;
  std::vector<PlaneMeasurement> measured_;
  double sigma_px_;
};

using Segment = std::array<Station, 4>;

// The third derivative of four samples in a row.
class BendCost : public ceres::CostFunction {
 public:
  BendCost(const Segment& segment, double stiffness_px, double pixel)
      : segment_(segment) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->assign(segment_.size(), 2);
    std::array<double, 4> along = {};
    for (std::size_t j = 1; j < along.size(); ++j) {
      const double step = (segment[j].start - segment[j - 1].start).norm();
      along[j] = along[j - 1] + std::max(kMinStepPx, step / pixel);
    }
    const double scale = std::pow(stiffness_px, 3) * std::sqrt(along[3] / 3) /
                         (kBendSigmaPx * pixel);
    for (std::size_t j = 0; j < along.size(); ++j) {
      factors_[j] = 6 * scale;
      for (std::size_t i = 0; i < along.size(); ++i) {
        if (i != j) factors_[j] /= along[j] - along[i];
      }
      jacobians_[j] = factors_[j] * segment_[j].axes;
    }
  }

  bool Evaluate(double const* const* offsets,
                double* residuals,
                double** jacobians) const override {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t j = 0; j < segment_.size(); ++j) {
      sum += factors_[j] * (segment_[j].At(offsets[j]) - segment_[0].start);
      if (jacobians == nullptr || jacobians[j] == nullptr) continue;
      Eigen::Map<Jacobian>{jacobians[j]} = jacobians_[j];
    }
    Eigen::Map<Eigen::Vector3d>{residuals} = sum;
    return true;
  }

 private:
  using Jacobian = Eigen::Matrix<double, 3, 2, Eigen::RowMajor>;

  Segment segment_;
  std::array<double, 4> factors_ = {};
  std::array<Jacobian, 4> jacobians_;  // by the offset of each sample
};

// A curve has many residuals that are cheap: what Ceres would do about each of
// them beside its cost counts.
ceres::Problem::Options WithoutChecksAndOwnership() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

// Ceres' problem of one curve.
class CurveFitter {
 public:
  CurveFitter(Curve curve, double pixel)
      : curve_(std::move(curve)),
        pixel_(pixel),
        offsets_(curve_.samples.size()),
        problem_(WithoutChecksAndOwnership()) {
    stations_.reserve(curve_.samples.size());
    for (const CurveSample& sample : curve_.samples) {
      Station& station = stations_.emplace_back();
      station.start = sample.position;
      station.axes = pixel * AxesAcross(sample.tangent);
    }
  }

  void AddEdges(const RefinementInput& input, const ResponseCurve& response) {
    for (std::size_t k = 0; k < stations_.size(); ++k) {
      std::vector<PlaneMeasurement> measured =
          MeasureUnblurred(curve_, k, pixel_, input, response);
      if (measured.empty()) continue;
      support_costs_.emplace_back(
          stations_[k], std::move(measured), input.edge_sigma_px);
      problem_.AddResidualBlock(
          &support_costs_.back(), nullptr, offsets_[k].data());
    }
  }

  void AddBends(double stiffness_px) {
    const std::size_t size = stations_.size();
    const std::size_t num_bends = curve_.closed ? size : size - 3;
    for (std::size_t k = 0; k < num_bends; ++k) AddBend(k, stiffness_px);
  }

  // The curve, or the parts of it that are near their edges.
  std::vector<Curve> Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    // Faster than CHOLMOD for the small matrices of one curve.
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    options.max_num_iterations = kMaxNumIterations;
    options.function_tolerance = kMinGain;
    options.initial_trust_region_radius = kTrustRegionRadius;
    // All unknowns are pixels.
    options.jacobi_scaling = false;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) return {std::move(curve_)};
    for (std::size_t k = 0; k < stations_.size(); ++k) {
      curve_.samples[k].position = stations_[k].At(offsets_[k].data());
    }
    SetTangentsAlongChords(curve_);
    return KeepRanges(std::move(curve_), AreNearEdges());
  }

 private:
  // By sample; true without edges.
  std::vector<bool> AreNearEdges() const {
    std::vector<bool> near(stations_.size(), true);
    for (const SupportCost& cost : support_costs_) {
      const auto k =
          static_cast<std::size_t>(cost.station() - stations_.data());
      near[k] = cost.MedianDistancePx(offsets_[k].data()) < kMaxMissPx;
    }
    return near;
  }

  // Of the samples from `first` on.
  void AddBend(std::size_t first, double stiffness_px) {
    Segment segment;
    std::vector<double*> offsets;
    for (std::size_t j = 0; j < segment.size(); ++j) {
      const std::size_t sample = (first + j) % stations_.size();
      segment[j] = stations_[sample];
      offsets.push_back(offsets_[sample].data());
    }
    bend_costs_.emplace_back(segment, stiffness_px, pixel_);
    problem_.AddResidualBlock(&bend_costs_.back(), &bend_loss_, offsets);
  }

  Curve curve_;
  double pixel_;  // world units
  std::vector<Station> stations_;
  std::vector<std::array<double, 2>> offsets_;
  // At addresses that stay.
  std::deque<SupportCost> support_costs_;
  std::deque<BendCost> bend_costs_;
  ceres::CauchyLoss bend_loss_{kKinkSigmas};
  ceres::Problem problem_;
};

std::vector<Curve> FitCurve(const Curve& curve,
                            const RefinementInput& input,
                            const ResponseCurve& response) {
  if (curve.samples.size() < kMinNumFittedSamples) return {curve};
  const double pixel = PixelSize(curve, input.views);
  if (!(pixel > 0)) return {curve};
  CurveFitter fitter(curve, pixel);
  fitter.AddEdges(input, response);
  fitter.AddBends(kStiffness * input.options.smoothing_px);
  return fitter.Solve();
}

}  // namespace

void SetTangentsAlongChords(Curve& curve) {
  const std::size_t size = curve.samples.size();
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t before =
        curve.closed ? (k + size - 2) % size : std::max<std::size_t>(k, 2) - 2;
    const std::size_t after =
        curve.closed ? (k + 2) % size : std::min(size - 1, k + 2);
    const Eigen::Vector3d chord =
        curve.samples[after].position - curve.samples[before].position;
    if (chord.norm() > 0) curve.samples[k].tangent = chord.normalized();
  }
}

std::vector<Curve> FitToImages(std::vector<Curve> curves,
                               const RefinementInput& input,
                               const ResponseCurve& response) {
  if (!(input.options.smoothing_px > 0)) return curves;
  std::vector<std::vector<Curve>> fitted(curves.size());
  ForEachCurve(curves.size(), input, [&](std::size_t i) {
    fitted[i] = FitCurve(curves[i], input, response);
  });
  return Concatenate(std::move(fitted));
}

}  // namespace curvix
