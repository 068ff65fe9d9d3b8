// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "poses/adjust_poses.h"

#include <curvix/parallel.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/median.h"
#include "geometry/axes_across.h"
#include "poses/solve_steps.h"

namespace curvix {
namespace {

// A pose that is off by many times what is usual is let go.
constexpr double kPriorLossScale = 3;
// Edges are looked up anew after each solution, so none need be exact.
constexpr int kMaxNumIterations = 10;
constexpr double kMinGain = 1e-3;
constexpr double kFirstDamping = 1e-4;
constexpr double kDampingFactor = 10;

// A small motion of a camera in its own frame: rotation vector, translation.
using Motion = Vector6d;

Motion ToMotion(const Rigid3& rigid) {
  const Eigen::AngleAxisd turn(rigid.rotation);
  Motion motion;
  motion << turn.angle() * turn.axis(), rigid.translation;
  return motion;
}

Rigid3 FromMotion(const Motion& motion) {
  const Eigen::Vector3d turn = motion.head<3>();
  Rigid3 rigid;
  rigid.translation = motion.tail<3>();
  const double angle = turn.norm();
  if (angle > 0) rigid.rotation = Eigen::AngleAxisd(angle, turn / angle);
  return rigid;
}

// J for which a turn by `turn` + d, both small, is one by `turn` and then one
// by J d.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& turn) {
  const double angle2 = turn.squaredNorm();
  Eigen::Matrix3d cross;
  cross << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(),
      0;
  if (angle2 < 1e-8) return Eigen::Matrix3d::Identity() + cross / 2;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / angle2 * cross +
         (angle - std::sin(angle)) / (angle2 * angle) * cross * cross;
}

// Cauchy's: grows with the logarithm of squares beyond `scale2`.
struct Loss {
  double scale2 = 1;

  double operator()(double square) const {
    return scale2 * std::log1p(square / scale2);
  }
  double RootOfWeight(double square) const {
    return 1 / std::sqrt(1 + square / scale2);
  }
};
constexpr Loss kEdgeLoss{1};
constexpr Loss kPriorLoss{kPriorLossScale * kPriorLossScale};

// A sample and the line of its edge, in the camera as it was in the beginning.
struct SeenSample {
  Eigen::Vector3d position;
  Eigen::Matrix3d moves;  // of the position, by the unknowns of the sample
  Eigen::Vector3d line;   // residual = line . x / x.z
};

SeenSample SeenBy(const PosedView& view,
                  const Rim& rim,
                  const ImageEdge& edge,
                  double sigma_px) {
  const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
  Eigen::Vector3d line = view.calibration.topRows<2>().transpose() * normal;
  line.z() -= normal.dot(edge.position);
  Eigen::Matrix3d moves;
  moves << AxesAcross(rim.axis.tangent), SideSeenFrom(rim, view.center);
  return {view.InCamera(SeenFrom(rim, view.center).position),
          view.rotation * moves,
          line / sigma_px};
}

// Where the search stands.
struct State {
  std::vector<Motion> motions;  // by view
  // By sample: of the axis across itself, and of the radius.
  std::vector<Eigen::Vector3d> offsets;
};

std::vector<Rigid3> RigidMotions(const State& state) {
  std::vector<Rigid3> motions;
  for (const Motion& motion : state.motions) {
    motions.push_back(FromMotion(motion));
  }
  return motions;
}

EquationOwners OwnersOf(const PoseProblem& problem) {
  std::vector<EquationOwners::Owner> owners;
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    for (const PoseSample::Observation& seen :
         problem.samples[i].observations) {
      owners.push_back({static_cast<std::size_t>(seen.view_idx), i});
    }
  }
  return {std::move(owners), problem.views.size(), problem.samples.size()};
}

class Search {
 public:
  Search(const PoseProblem& problem,
         const std::vector<Rigid3>& start,
         int num_threads)
      : num_threads_(num_threads), owners_(OwnersOf(problem)) {
    for (const Rigid3& motion : start) {
      state_.motions.push_back(ToMotion(motion));
    }
    state_.offsets.assign(problem.samples.size(), Eigen::Vector3d::Zero());
    for (const PoseSample& sample : problem.samples) {
      for (const PoseSample::Observation& seen : sample.observations) {
        const auto i = static_cast<std::size_t>(seen.view_idx);
        seen_.push_back(SeenBy(
            problem.views[i], sample.rim, seen.edge, problem.sigmas_px[i]));
      }
    }
    for (std::size_t i = 0; i < problem.views.size(); ++i) {
      prior_factors_.push_back(PriorFactors(problem, i));
    }
  }

  // False, and nothing moves, if a sample is behind a camera.
  bool Run(const std::function<bool()>& keep_going) {
    double cost = Cost(state_);
    if (!std::isfinite(cost)) return false;
    double damping = kFirstDamping;
    for (int i = 0; i < kMaxNumIterations && keep_going(); ++i) {
      State next = Next(damping);
      const double next_cost = Cost(next);
      if (!(next_cost < cost)) {
        damping *= kDampingFactor;
        continue;
      }
      damping /= kDampingFactor;
      const bool is_settled = cost - next_cost < kMinGain * cost;
      state_ = std::move(next);
      cost = next_cost;
      if (is_settled) break;
    }
    return true;
  }

  const State& state() const { return state_; }

 private:
  // What a motion is multiplied by to give six residuals, each 1 where it
  // shifts the image by prior_px. None for a view without samples.
  Vector6d PriorFactors(const PoseProblem& problem,
                        std::size_t view_idx) const {
    std::vector<double> depths;
    for (const std::size_t e : owners_.by_view[view_idx]) {
      depths.push_back(seen_[e].position.z());
    }
    Vector6d factors = Vector6d::Zero();
    if (depths.empty()) return factors;
    const double turn =
        problem.views[view_idx].calibration(0, 0) / problem.prior_px;
    factors.head<3>().setConstant(turn);
    factors.tail<3>().setConstant(turn / Median(std::move(depths)));
    return factors;
  }

  // Infinite if a sample is behind a camera.
  double Cost(const State& state) const {
    const std::vector<Rigid3> motions = RigidMotions(state);
    std::vector<double> costs(seen_.size());
    ParallelFor(costs.size(), num_threads_, [&](std::size_t e) {
      const auto [view_idx, sample_idx] = owners_.of_equation[e];
      const Eigen::Vector3d x =
          motions[view_idx] *
          (seen_[e].position + seen_[e].moves * state.offsets[sample_idx]);
      const double residual = seen_[e].line.dot(x) / x.z();
      costs[e] = x.z() > 0 ? kEdgeLoss(residual * residual)
                           : std::numeric_limits<double>::infinity();
    });
    double sum = 0;
    for (const double cost : costs) sum += cost;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      sum += kPriorLoss(
          prior_factors_[i].cwiseProduct(state.motions[i]).squaredNorm());
    }
    return sum;
  }

  State Next(double damping) const {
    std::vector<StepEquation> equations(seen_.size());
    std::vector<StepPrior> priors(state_.motions.size());
    ParallelFor(priors.size(), num_threads_, [&](std::size_t i) {
      Linearise(i, equations);
      priors[i] = LinearPrior(i);
    });
    const Steps steps =
        SolveSteps(owners_, equations, priors, damping, num_threads_);
    State next = state_;
    for (std::size_t i = 0; i < next.motions.size(); ++i) {
      next.motions[i] += steps.motions[i];
    }
    for (std::size_t i = 0; i < next.offsets.size(); ++i) {
      next.offsets[i] += steps.offsets[i];
    }
    return next;
  }

  // Writes the equations of one view.
  void Linearise(std::size_t view_idx,
                 std::vector<StepEquation>& equations) const {
    const Motion& motion = state_.motions[view_idx];
    const Rigid3 rigid = FromMotion(motion);
    const Eigen::Matrix3d rotation = rigid.rotation.toRotationMatrix();
    const Eigen::Matrix3d left_jacobian = LeftJacobian(motion.head<3>());
    for (const std::size_t e : owners_.by_view[view_idx]) {
      const auto& [position, moves, line] = seen_[e];
      const std::size_t sample_idx = owners_.of_equation[e].sample_idx;
      const Eigen::Vector3d turned =
          rotation * (position + moves * state_.offsets[sample_idx]);
      const Eigen::Vector3d x = turned + rigid.translation;
      const double residual = line.dot(x) / x.z();
      const double root = kEdgeLoss.RootOfWeight(residual * residual);
      const Eigen::Vector3d by_x =
          root / x.z() * (line - residual * Eigen::Vector3d::UnitZ());
      StepEquation& equation = equations[e];
      equation.residual = root * residual;
      equation.by_motion << left_jacobian.transpose() * turned.cross(by_x),
          by_x;
      equation.by_offset = moves.transpose() * (rotation.transpose() * by_x);
    }
  }

  StepPrior LinearPrior(std::size_t view_idx) const {
    const Vector6d& factors = prior_factors_[view_idx];
    const Vector6d residuals = factors.cwiseProduct(state_.motions[view_idx]);
    const double root = kPriorLoss.RootOfWeight(residuals.squaredNorm());
    return {root * factors, root * residuals};
  }

  const int num_threads_;
  const EquationOwners owners_;
  std::vector<SeenSample> seen_;         // by equation
  std::vector<Vector6d> prior_factors_;  // by view
  State state_;
};

}  // namespace

AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const std::vector<Rigid3>& start,
                          int num_threads,
                          const std::function<bool()>& keep_going) {
  Search search(problem, start, num_threads);
  AdjustedPoses adjusted;
  adjusted.new_cam_from_cam =
      search.Run(keep_going) ? RigidMotions(search.state()) : start;
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    Rim& rim = adjusted.rims.emplace_back(problem.samples[i].rim);
    const Eigen::Vector3d& offset = search.state().offsets[i];
    rim.axis.position += AxesAcross(rim.axis.tangent) * offset.head<2>();
    rim.radius += offset.z();
  }
  return adjusted;
}

}  // namespace curvix
