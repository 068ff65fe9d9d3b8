// SPDX-License-Identifier: BSD-3-Clause
#include "poses/adjust_poses.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/lens.h"
#include "poses/pose_equations.h"

namespace curvix {
namespace {

// Scale of the robust loss of the priors: they hardly pull poses and cameras
// that are off by many times the usual.
constexpr double kPriorLossScale = 3;
// Prior of each parameter of a camera: standard deviation of its effect on the
// image, about the start or, of cameras that are alike, about their median.
constexpr double kLensPriorPx = 3;
// Standard deviation of the effect of another ratio of two focal lengths:
// pixels are square, or as the input says. Upright images do not determine the
// ratio, since the world can stretch.
constexpr double kAspectRatioPriorPx = 0.15;
constexpr std::size_t kMinAlikeCameras = 3;
// A smaller one takes more steps; curves of photographs are no better for it.
constexpr double kMinGain = 3e-3;  // of a step, share of the cost
constexpr int kMaxNumSteps = 25;
// Wide: priors fix what observations leave free, so steps need little damping.
constexpr double kTrustRegionRadius = 1e8;
// Weight of the prior of a radius, about the start, as a share of the weights
// of its sample: radii that are nearly unobservable stay.
constexpr double kRadiusWeight = 1e-9;
// Larger systems are solved by conjugate gradients, since the time of the exact
// solution is cubic.
constexpr int kMaxExactUnknowns = 600;  // of views and cameras
constexpr int kMaxNumGradients = 200;
constexpr double kGradientsTolerance = 1e-3;
// Of unknowns. The first is eliminated; in each, the order is that of
// addresses, so each must be in one vector.
enum Group { kSamples, kViews, kCameras };

// What a change of a lens is multiplied by to give the residuals of its prior.
LensChange LensPriorFactors(const Lens& lens) {
  LensChange factors = LensChange::Constant(1 / kLensPriorPx);
  if (const std::optional<Eigen::Index> i = lens.AspectRatioIndex()) {
    factors[*i] = 1 / kAspectRatioPriorPx;
  }
  return factors;
}

bool AreAlike(const Camera& a, const Camera& b) {
  return a.model == b.model && a.width == b.width && a.height == b.height;
}

// By camera: the median of the free ones of its model and size, which are
// likely the same camera, if it is one of several; else itself.
std::vector<Camera> TypicalCameras(const std::vector<Camera>& cameras,
                                   std::vector<bool> is_free) {
  std::vector<Camera> typical = cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::vector<std::size_t> alike;
    for (std::size_t k = i; k < cameras.size(); ++k) {
      if (!is_free[i] || !is_free[k]) continue;
      if (AreAlike(cameras[i], cameras[k])) alike.push_back(k);
    }
    if (alike.size() < kMinAlikeCameras) continue;
    Camera median = cameras[i];
    for (std::size_t p = 0; p < median.params.size(); ++p) {
      std::vector<double> values;
      for (const std::size_t k : alike) values.push_back(cameras[k].params[p]);
      median.params[p] = Median(std::move(values));
    }
    for (const std::size_t k : alike) {
      typical[k] = median;
      is_free[k] = false;  // done
    }
  }
  return typical;
}

PoseUnknowns UnknownsOf(const PoseProblem& problem, const MovedCameras& start) {
  PoseUnknowns unknowns;
  for (const Rigid3& increment : start.new_cam_from_cam) {
    unknowns.increments.push_back(ToIncrement(increment));
  }
  unknowns.lenses.assign(start.cameras.size(), LensChange::Zero());
  unknowns.offsets.assign(problem.samples.size() + problem.points.size(),
                          Eigen::Vector3d::Zero());
  return unknowns;
}

// Ends the search after a step of small gain. Ceres' own tolerance would undo
// that step.
class EndOfSearch : public ceres::IterationCallback {
 public:
  explicit EndOfSearch(const std::function<bool()>& keep_going)
      : keep_going_(keep_going) {}

  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary& step) override {
    const bool is_settled =
        step.iteration > 0 && step.step_is_successful &&
        step.cost_change < kMinGain * (step.cost + step.cost_change);
    return is_settled || !keep_going_() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                        : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& keep_going_;
};

ceres::Problem::Options ProblemOptions(PoseEquations* equations) {
  ceres::Problem::Options options;
  options.disable_all_safety_checks = true;
  options.evaluation_callback = equations;
  // Ceres counts the references to what it owns, which takes time.
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

std::vector<bool> FreeLenses(const PoseProblem& problem,
                             std::size_t num_cameras) {
  std::vector<bool> is_free = problem.free_lenses;
  is_free.resize(num_cameras, false);
  return is_free;
}

// Ceres' problem, from which samples and points are eliminated.
class PoseAdjuster {
 public:
  PoseAdjuster(const PoseProblem& problem,
               const MovedCameras& start,
               int num_threads)
      : is_free_(FreeLenses(problem, start.cameras.size())),
        unknowns_(UnknownsOf(problem, start)),
        equations_(ObservationsOf(problem),
                   start.cameras,
                   is_free_,
                   unknowns_,
                   num_threads),
        ceres_(ProblemOptions(&equations_)) {
    equations_.PrepareForEvaluation(true, true);
    start_costs_ = CostsBySample();
    AddObservations();
    AddRadiusPriors(problem.samples.size());
    AddPosePriors(problem);
    AddLensPriors(start.cameras);
  }

  // False if no solution was found.
  bool Run(const std::function<bool()>& keep_going) {
    if (ceres_.NumResidualBlocks() == 0) return true;
    EndOfSearch end(keep_going);
    ceres::Solver::Options options;
    options.callbacks = {&end};
    const int num_exact =
        ceres_.NumParameters() - 3 * ordering_->GroupSize(kSamples);
    options.linear_solver_type = num_exact > kMaxExactUnknowns
                                     ? ceres::ITERATIVE_SCHUR
                                     : ceres::DENSE_SCHUR;
    options.preconditioner_type = ceres::SCHUR_JACOBI;
    options.max_linear_solver_iterations = kMaxNumGradients;
    options.eta = kGradientsTolerance;
    options.linear_solver_ordering = ordering_;
    options.initial_trust_region_radius = kTrustRegionRadius;
    options.max_num_iterations = kMaxNumSteps;
    // Steps that move something behind a camera.
    options.max_num_consecutive_invalid_steps = kMaxNumSteps;
    options.function_tolerance = 0;
    options.num_threads = 1;  // sums of several are in any order
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    equations_.PrepareForEvaluation(false, true);
    return summary.IsSolutionUsable();
  }

  const PoseUnknowns& unknowns() const { return unknowns_; }

  std::vector<double> CostsBySample() const {
    std::vector<double> sums(unknowns_.offsets.size(), 0);
    for (std::size_t i = 0; i < equations_.equations().size(); ++i) {
      sums[equations_.observations()[i].sample_idx] +=
          equations_.equations()[i].loss;
    }
    return sums;
  }

  MovedCameras Moved() const {
    MovedCameras moved;
    for (const PoseIncrement& increment : unknowns_.increments) {
      moved.new_cam_from_cam.push_back(FromIncrement(increment));
    }
    for (std::size_t i = 0; i < unknowns_.lenses.size(); ++i) {
      moved.cameras.push_back(
          equations_.lenses()[i].Changed(unknowns_.lenses[i]));
    }
    return moved;
  }

 private:
  // Without those of samples that are behind a camera.
  void AddObservations() {
    for (std::size_t i = 0; i < equations_.observations().size(); ++i) {
      const PoseObservation& seen = equations_.observations()[i];
      const PoseEquation& equation = equations_.equations()[i];
      if (!std::isfinite(start_costs_[seen.sample_idx])) continue;
      const std::array unknowns = {unknowns_.offsets[seen.sample_idx].data(),
                                   unknowns_.increments[seen.view_idx].data(),
                                   unknowns_.lenses[seen.camera_idx].data()};
      const bool is_free = is_free_[seen.camera_idx];
      const int num_lens_params =
          is_free ? equations_.lenses()[seen.camera_idx].num_used() : 0;
      ceres_.AddResidualBlock(&costs_.emplace_back(equation, num_lens_params),
                              &losses_.emplace_back(equation),
                              unknowns.data(),
                              is_free ? 3 : 2);
    }
    for (Eigen::Vector3d& offset : unknowns_.offsets) {
      if (!ceres_.HasParameterBlock(offset.data())) continue;
      ordering_->AddElementToGroup(offset.data(), kSamples);
    }
  }

  void AddRadiusPriors(std::size_t num_samples) {
    std::vector<double> weights(num_samples, 0);
    for (std::size_t i = 0; i < equations_.observations().size(); ++i) {
      const std::size_t sample_idx = equations_.observations()[i].sample_idx;
      if (sample_idx >= num_samples) continue;
      weights[sample_idx] +=
          equations_.equations()[i].by_offset.squaredNorm() * kRadiusWeight;
    }
    for (std::size_t i = 0; i < num_samples; ++i) {
      double* offset = unknowns_.offsets[i].data();
      if (!(weights[i] > 0) || !ceres_.HasParameterBlock(offset)) continue;
      ceres::Matrix factors = ceres::Matrix::Zero(2, 3);
      factors(0, 2) = std::sqrt(weights[i]);
      ceres_.AddResidualBlock(
          &priors_.emplace_back(factors, Eigen::Vector3d::Zero()),
          nullptr,
          offset);
    }
  }

  // Residuals: `factors` times the distances of the `unknowns` from `center`.
  template <typename Vector>
  void AddPrior(const Vector& factors,
                const Vector& center,
                double* unknowns,
                Group group) {
    ceres_.AddResidualBlock(
        &priors_.emplace_back(ceres::Matrix(factors.asDiagonal()), center),
        &prior_loss_,
        unknowns);
    ordering_->AddElementToGroup(unknowns, group);
  }

  // Residuals of an increment are 1 where it shifts the image by prior_px.
  void AddPosePriors(const PoseProblem& problem) {
    std::vector<std::vector<double>> depths(unknowns_.increments.size());
    for (const PoseObservation& seen : equations_.observations()) {
      if (!std::isfinite(start_costs_[seen.sample_idx])) continue;
      depths[seen.view_idx].push_back(seen.position.z());
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (depths[i].empty()) continue;
      const View& view = problem.scene.views[i];
      const Camera& camera = CameraOf(problem.scene, view);
      const double turn = PinholeCalibration(camera)(0, 0) / problem.prior_px;
      PoseIncrement factors;
      factors.head<3>().setConstant(turn);
      factors.tail<3>().setConstant(turn / Median(std::move(depths[i])));
      AddPrior<PoseIncrement>(factors,
                              PoseIncrement::Zero(),
                              unknowns_.increments[i].data(),
                              kViews);
    }
  }

  void AddLensPriors(const std::vector<Camera>& cameras) {
    const std::vector<Camera> typical = TypicalCameras(cameras, is_free_);
    for (std::size_t i = 0; i < typical.size(); ++i) {
      double* change = unknowns_.lenses[i].data();
      if (!is_free_[i] || !ceres_.HasParameterBlock(change)) continue;
      const Lens& lens = equations_.lenses()[i];
      const int size = lens.num_used();
      AddPrior<Eigen::VectorXd>(LensPriorFactors(lens).head(size),
                                lens.ChangeTo(typical[i]).head(size),
                                change,
                                kCameras);
    }
  }

  std::vector<bool> is_free_;  // by camera
  PoseUnknowns unknowns_;
  PoseEquations equations_;
  std::vector<double> start_costs_;  // by sample; infinite behind a camera
  std::deque<ObservationCost> costs_;
  std::deque<ObservationLoss> losses_;
  std::deque<ceres::NormalPrior> priors_;
  ceres::CauchyLoss prior_loss_{kPriorLossScale};
  ceres::Problem ceres_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_ =
      std::make_shared<ceres::ParameterBlockOrdering>();
};

}  // namespace

AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const MovedCameras& start,
                          int num_threads,
                          const std::function<bool()>& keep_going) {
  PoseAdjuster adjuster(problem, start, num_threads);
  AdjustedPoses adjusted;
  adjusted.moved = start;
  if (adjuster.Run(keep_going)) {
    adjusted.moved = adjuster.Moved();
  }
  adjusted.costs = adjuster.CostsBySample();
  std::size_t next = 0;
  for (const PoseSample& sample : problem.samples) {
    OccludingContour& contour = adjusted.contours.emplace_back(sample.contour);
    const Eigen::Vector3d& offset = adjuster.unknowns().offsets[next++];
    contour.axis.position +=
        AxesAcross(contour.axis.tangent) * offset.head<2>();
    contour.radius += offset.z();
  }
  for (const PointSample& point : problem.points) {
    adjusted.points.push_back(point.position +
                              adjuster.unknowns().offsets[next++]);
  }
  return adjusted;
}

}  // namespace curvix
