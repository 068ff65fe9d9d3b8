// SPDX-License-Identifier: BSD-3-Clause
#include "poses/adjust_poses.h"

#include <curvix/scene.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/camera_of.h"
#include "geometry/directions.h"
#include "geometry/lens.h"
#include "poses/pose_observations.h"
#include "poses/solve_steps.h"

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
// Edges are matched again after each solution, so none needs to be exact.
constexpr int kMaxNumSteps = 25;
constexpr double kFirstDamping = 1e-4;
constexpr double kDampingFactor = 10;

// A small increment of a camera in its own frame: rotation vector, translation.
using PoseIncrement = Vector6d;

PoseIncrement ToIncrement(const Rigid3& rigid) {
  const Eigen::AngleAxisd turn(rigid.rotation);
  PoseIncrement increment;
  increment << turn.angle() * turn.axis(), rigid.translation;
  return increment;
}

Rigid3 FromIncrement(const PoseIncrement& increment) {
  return {RotationBy(increment.head<3>()), increment.tail<3>()};
}

// J for which a turn by `turn` + d, both small, is one by `turn` and then one
// by J d.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& turn) {
  const double angle2 = turn.squaredNorm();
  const Eigen::Matrix3d cross = CrossMatrix(turn);
  if (angle2 < 1e-8) return Eigen::Matrix3d::Identity() + cross / 2;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / angle2 * cross +
         (angle - std::sin(angle)) / (angle2 * angle) * cross * cross;
}

// Cauchy's: grows with the logarithm of squares beyond `scale2`.
struct CauchyLoss {
  double scale2 = 1;

  double operator()(double square) const {
    return scale2 * std::log1p(square / scale2);
  }
  double RootOfWeight(double square) const {
    return 1 / std::sqrt(1 + square / scale2);
  }
};
constexpr CauchyLoss kLoss{1};
constexpr CauchyLoss kPriorLoss{kPriorLossScale * kPriorLossScale};

// The state of the search.
struct State {
  std::vector<PoseIncrement> increments;  // by view
  std::vector<LensChange> lenses;         // by camera
  // By sample: of the axis across itself, and of the radius. Then by point.
  std::vector<Eigen::Vector3d> offsets;
};

std::vector<Rigid3> RigidIncrements(const State& state) {
  std::vector<Rigid3> increments;
  for (const PoseIncrement& increment : state.increments) {
    increments.push_back(FromIncrement(increment));
  }
  return increments;
}

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

class PoseAdjuster {
 public:
  PoseAdjuster(const PoseProblem& problem,
               const MovedCameras& start,
               int num_threads)
      : num_threads_(num_threads),
        min_gain_(problem.min_gain),
        owners_(OwnersOf(problem)),
        seen_(ObservationsOf(problem)) {
    for (const Rigid3& increment : start.new_cam_from_cam) {
      state_.increments.push_back(ToIncrement(increment));
    }
    for (const Camera& camera : start.cameras) lenses_.emplace_back(camera);
    state_.lenses.assign(lenses_.size(), LensChange::Zero());
    state_.offsets.assign(problem.samples.size() + problem.points.size(),
                          Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < problem.scene.views.size(); ++i) {
      prior_factors_.push_back(PriorFactors(problem, i));
    }
    const std::vector<bool>& is_free = problem.free_lenses;
    if (std::find(is_free.begin(), is_free.end(), true) != is_free.end()) {
      is_free_ = is_free;
      const std::vector<Camera> typical =
          TypicalCameras(start.cameras, is_free);
      for (std::size_t i = 0; i < lenses_.size(); ++i) {
        lens_factors_.push_back(LensPriorFactors(lenses_[i]));
        typical_lenses_.push_back(lenses_[i].ChangeTo(typical[i]));
      }
    }
  }

  // False, and nothing moves, if a sample is behind a camera.
  bool Run(const std::function<bool()>& keep_going) {
    double cost = Cost(state_);
    if (!std::isfinite(cost)) return false;
    double damping = kFirstDamping;
    for (int i = 0; i < kMaxNumSteps && keep_going(); ++i) {
      State next = Next(damping);
      const double next_cost = Cost(next);
      if (!(next_cost < cost)) {
        damping *= kDampingFactor;
        continue;
      }
      damping /= kDampingFactor;
      const bool is_settled = cost - next_cost < min_gain_ * cost;
      state_ = std::move(next);
      cost = next_cost;
      if (is_settled) break;
    }
    return true;
  }

  const State& state() const { return state_; }

  std::vector<double> CostsBySample() const {
    std::vector<double> sums(state_.offsets.size(), 0);
    const std::vector<double> costs = Costs(state_);
    for (std::size_t e = 0; e < costs.size(); ++e) {
      sums[owners_.of_equation[e].sample_idx] += costs[e];
    }
    return sums;
  }

  std::vector<Camera> Cameras() const {
    std::vector<Camera> cameras;
    for (const CameraState& camera : CameraStates(state_, false)) {
      cameras.push_back(camera.camera());
    }
    return cameras;
  }

 private:
  std::vector<CameraState> CameraStates(const State& state,
                                        bool has_derivatives) const {
    std::vector<CameraState> cameras;
    for (std::size_t i = 0; i < lenses_.size(); ++i) {
      cameras.emplace_back(
          lenses_[i], state.lenses[i], has_derivatives && IsFree(i));
    }
    return cameras;
  }

  // What an increment is multiplied by to give six residuals, each 1 where it
  // shifts the image by prior_px. None for a view without samples.
  Vector6d PriorFactors(const PoseProblem& problem,
                        std::size_t view_idx) const {
    std::vector<double> depths;
    for (const std::size_t e : owners_.by_view[view_idx]) {
      depths.push_back(seen_[e].position.z());
    }
    Vector6d factors = Vector6d::Zero();
    if (depths.empty()) return factors;
    const View& view = problem.scene.views[view_idx];
    const Camera& camera = CameraOf(problem.scene, view);
    const double turn = PinholeCalibration(camera)(0, 0) / problem.prior_px;
    factors.head<3>().setConstant(turn);
    factors.tail<3>().setConstant(turn / Median(std::move(depths)));
    return factors;
  }

  // Residuals of the prior of a camera.
  LensChange LensResiduals(const State& state, std::size_t camera_idx) const {
    return lens_factors_[camera_idx].cwiseProduct(state.lenses[camera_idx] -
                                                  typical_lenses_[camera_idx]);
  }

  bool IsFree(std::size_t camera_idx) const {
    return !is_free_.empty() && is_free_[camera_idx];
  }

  // By observation; infinite if a sample is behind a camera.
  std::vector<double> Costs(const State& state) const {
    const std::vector<Rigid3> increments = RigidIncrements(state);
    const std::vector<CameraState> cameras = CameraStates(state, false);
    std::vector<double> costs(seen_.size());
    ParallelFor(costs.size(), num_threads_, [&](std::size_t e) {
      const auto [view_idx, sample_idx] = owners_.of_equation[e];
      const PoseObservation& seen = seen_[e];
      const Eigen::Vector3d x =
          increments[view_idx] *
          (seen.position + seen.moves * state.offsets[sample_idx]);
      const double residual = seen.direction.dot(
          ImageFromIdeal(cameras[seen.camera_idx].camera(), x.hnormalized()) -
          seen.pixel);
      costs[e] = x.z() > 0 ? kLoss(residual * residual)
                           : std::numeric_limits<double>::infinity();
    });
    return costs;
  }

  double Cost(const State& state) const {
    double sum = 0;
    for (const double cost : Costs(state)) sum += cost;
    for (std::size_t i = 0; i < state.increments.size(); ++i) {
      sum += kPriorLoss(
          prior_factors_[i].cwiseProduct(state.increments[i]).squaredNorm());
    }
    for (std::size_t i = 0; i < lens_factors_.size(); ++i) {
      sum += kPriorLoss(LensResiduals(state, i).squaredNorm());
    }
    return sum;
  }

  State Next(double damping) const {
    std::vector<StepEquation> equations(seen_.size());
    std::vector<StepPrior> priors(state_.increments.size());
    const std::vector<CameraState> cameras = CameraStates(state_, true);
    ParallelFor(priors.size(), num_threads_, [&](std::size_t i) {
      Linearise(i, cameras, equations);
      priors[i] = LinearPrior(i);
    });
    std::vector<LensPrior> lens_priors;
    for (std::size_t i = 0; i < lens_factors_.size(); ++i) {
      const LensChange residuals = LensResiduals(state_, i);
      const double root = kPriorLoss.RootOfWeight(residuals.squaredNorm());
      lens_priors.push_back({root * lens_factors_[i], root * residuals});
    }
    const Steps steps = SolveSteps(
        owners_, equations, priors, lens_priors, damping, num_threads_);
    State next = state_;
    for (std::size_t i = 0; i < next.increments.size(); ++i) {
      next.increments[i] += steps.increments[i];
    }
    for (std::size_t i = 0; i < steps.lenses.size(); ++i) {
      next.lenses[i] += steps.lenses[i];
    }
    for (std::size_t i = 0; i < next.offsets.size(); ++i) {
      next.offsets[i] += steps.offsets[i];
    }
    return next;
  }

  // Writes the equations of one view.
  void Linearise(std::size_t view_idx,
                 const std::vector<CameraState>& cameras,
                 std::vector<StepEquation>& equations) const {
    const PoseIncrement& increment = state_.increments[view_idx];
    const Rigid3 rigid = FromIncrement(increment);
    const Eigen::Matrix3d rotation = rigid.rotation.toRotationMatrix();
    const Eigen::Matrix3d left_jacobian = LeftJacobian(increment.head<3>());
    for (const std::size_t e : owners_.by_view[view_idx]) {
      const PoseObservation& seen = seen_[e];
      const CameraState& camera = cameras[seen.camera_idx];
      const std::size_t sample_idx = owners_.of_equation[e].sample_idx;
      const Eigen::Vector3d turned =
          rotation * (seen.position + seen.moves * state_.offsets[sample_idx]);
      const Eigen::Vector3d x = turned + rigid.translation;
      const Eigen::Vector2d ideal = x.hnormalized();
      const double residual = seen.direction.dot(
          ImageFromIdeal(camera.camera(), ideal) - seen.pixel);
      const double root = kLoss.RootOfWeight(residual * residual);
      const Eigen::Vector2d direction = root * seen.direction;
      const Eigen::Vector2d by_ideal =
          ImageFromIdealJacobian(camera.camera(), ideal).transpose() *
          direction;
      const Eigen::Vector3d by_x(by_ideal.x() / x.z(),
                                 by_ideal.y() / x.z(),
                                 -by_ideal.dot(ideal) / x.z());
      StepEquation& equation = equations[e];
      equation.residual = root * residual;
      equation.by_pose << left_jacobian.transpose() * turned.cross(by_x), by_x;
      equation.by_offset =
          seen.moves.transpose() * (rotation.transpose() * by_x);
      if (IsFree(seen.camera_idx)) {
        equation.by_lens = camera.Derivatives(direction, ideal);
      }
    }
  }

  StepPrior LinearPrior(std::size_t view_idx) const {
    const Vector6d& factors = prior_factors_[view_idx];
    const Vector6d residuals =
        factors.cwiseProduct(state_.increments[view_idx]);
    const double root = kPriorLoss.RootOfWeight(residuals.squaredNorm());
    return {root * factors, root * residuals};
  }

  const int num_threads_;
  const double min_gain_;
  const EquationOwners owners_;
  const std::vector<PoseObservation> seen_;  // by equation
  std::vector<Lens> lenses_;                 // by camera
  std::vector<Vector6d> prior_factors_;      // by view
  std::vector<bool> is_free_;                // by camera; empty if none is
  std::vector<LensChange> lens_factors_;     // by camera; none if cameras stay
  std::vector<LensChange> typical_lenses_;   // likewise
  State state_;
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
    adjusted.moved = {RigidIncrements(adjuster.state()), adjuster.Cameras()};
  }
  adjusted.costs = adjuster.CostsBySample();
  std::size_t next = 0;
  for (const PoseSample& sample : problem.samples) {
    OccludingContour& contour = adjusted.contours.emplace_back(sample.contour);
    const Eigen::Vector3d& offset = adjuster.state().offsets[next++];
    contour.axis.position +=
        AxesAcross(contour.axis.tangent) * offset.head<2>();
    contour.radius += offset.z();
  }
  for (const PointSample& point : problem.points) {
    adjusted.points.push_back(point.position +
                              adjuster.state().offsets[next++]);
  }
  return adjusted;
}

}  // namespace curvix
