// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "poses/adjust_poses.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/median.h"
#include "geometry/axes_across.h"

namespace curvix {
namespace {

// A pose that is off by many times what is usual is let go.
constexpr double kPriorLossScale = 3;
// Edges are looked up anew after each solution, so none need be exact.
constexpr int kMaxNumIterations = 10;
constexpr double kFunctionTolerance = 1e-3;

// A small motion of a camera in its own frame: rotation vector, translation.
using Motion = std::array<double, 6>;
using Offset = std::array<double, 2>;  // of a sample, across its tangent

Motion ToMotion(const Rigid3& rigid) {
  const Eigen::AngleAxisd turn(rigid.rotation);
  const Eigen::Vector3d w = turn.angle() * turn.axis();
  const Eigen::Vector3d& t = rigid.translation;
  return {w.x(), w.y(), w.z(), t.x(), t.y(), t.z()};
}

Rigid3 FromMotion(const Motion& motion) {
  const Eigen::Vector3d turn(motion[0], motion[1], motion[2]);
  Rigid3 rigid;
  rigid.translation = {motion[3], motion[4], motion[5]};
  const double angle = turn.norm();
  if (angle > 0) rigid.rotation = Eigen::AngleAxisd(angle, turn / angle);
  return rigid;
}

// The distance of a projected sample from the line of its edge.
class EdgeCost {
 public:
  EdgeCost(const PosedView& view,
           const SpaceEdge& sample,
           const ImageEdge& edge,
           double sigma_px)
      : in_camera_(view.InCamera(sample.position)),
        across_(view.rotation * AxesAcross(sample.tangent)) {
    const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
    line_ = view.calibration.topRows<2>().transpose() * normal;
    line_.z() -= normal.dot(edge.position);
    line_ /= sigma_px;
  }

  // False behind the camera.
  template <typename T>
  bool operator()(const T* motion, const T* offset, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 2, 1>> across(offset);
    const Eigen::Matrix<T, 3, 1> before =
        in_camera_.cast<T>() + across_.cast<T>() * across;
    Eigen::Matrix<T, 3, 1> x;
    ceres::AngleAxisRotatePoint(motion, before.data(), x.data());
    x += Eigen::Map<const Eigen::Matrix<T, 3, 1>>(motion + 3);
    if (!(x.z() > T(0))) return false;
    *residual = line_.cast<T>().dot(x) / x.z();
    return true;
  }

 private:
  Eigen::Vector3d in_camera_;
  AcrossAxes across_;
  Eigen::Vector3d line_;  // residual = line . x / x.z, in camera coordinates
};

// Six residuals, each 1 where the motion shifts the image by prior_px.
class PriorCost {
 public:
  PriorCost(double focal_px, double depth, double prior_px)
      : turn_(focal_px / prior_px), shift_(focal_px / (depth * prior_px)) {}

  template <typename T>
  bool operator()(const T* motion, T* residuals) const {
    for (int i = 0; i < 3; ++i) {
      residuals[i] = turn_ * motion[i];
      residuals[i + 3] = shift_ * motion[i + 3];
    }
    return true;
  }

 private:
  double turn_, shift_;
};

class Solver {
 public:
  Solver(const PoseProblem& problem, const std::vector<Rigid3>& start)
      : offsets_(problem.samples.size(), Offset{}) {
    for (const Rigid3& motion : start) motions_.push_back(ToMotion(motion));
    std::vector<std::vector<double>> depths(problem.views.size());
    for (std::size_t i = 0; i < problem.samples.size(); ++i) {
      const PoseSample& sample = problem.samples[i];
      for (const PoseSample::Observation& seen : sample.observations) {
        const auto view_idx = static_cast<std::size_t>(seen.view_idx);
        const PosedView& view = problem.views[view_idx];
        auto cost = std::make_unique<EdgeCost>(
            view, sample.edge, seen.edge, problem.sigmas_px[view_idx]);
        problem_.AddResidualBlock(
            new ceres::AutoDiffCostFunction<EdgeCost, 1, 6, 2>(cost.release()),
            &loss_,
            motions_[view_idx].data(),
            offsets_[i].data());
        depths[view_idx].push_back(view.InCamera(sample.edge.position).z());
      }
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (!depths[i].empty()) {
        AddPrior(problem, i, std::move(depths[i]));
      }
    }
  }

  bool Solve(const std::function<bool()>& keep_going) {
    Stopper stopper(keep_going);
    ceres::Solver::Options options;
    options.max_num_iterations = kMaxNumIterations;
    options.function_tolerance = kFunctionTolerance;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&stopper);
    constexpr std::size_t kMaxDenseViews = 60;
    options.linear_solver_type = motions_.size() <= kMaxDenseViews
                                     ? ceres::DENSE_SCHUR
                                     : ceres::SPARSE_SCHUR;
    // Not one that sums in threads of its own.
    if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::EIGEN_SPARSE)) {
      options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  Rigid3 MotionOf(std::size_t view_idx) const {
    return FromMotion(motions_[view_idx]);
  }

  Eigen::Vector3d PositionOf(const SpaceEdge& edge, std::size_t i) const {
    return edge.position +
           AxesAcross(edge.tangent) *
               Eigen::Map<const Eigen::Vector2d>(offsets_[i].data());
  }

 private:
  class Stopper : public ceres::IterationCallback {
   public:
    explicit Stopper(const std::function<bool()>& keep_going)
        : keep_going_(keep_going) {}
    ceres::CallbackReturnType operator()(
        const ceres::IterationSummary&) override {
      return keep_going_() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
    }

   private:
    const std::function<bool()>& keep_going_;
  };

  void AddPrior(const PoseProblem& problem,
                std::size_t view_idx,
                std::vector<double> depths) {
    auto cost =
        std::make_unique<PriorCost>(problem.views[view_idx].calibration(0, 0),
                                    Median(std::move(depths)),
                                    problem.prior_px);
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PriorCost, 6, 6>(cost.release()),
        &prior_loss_,
        motions_[view_idx].data());
  }

  static ceres::Problem::Options LossesAreNotOwned() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  // Neither may be resized once problem_ points into them.
  std::vector<Motion> motions_;
  std::vector<Offset> offsets_;
  ceres::CauchyLoss loss_{1};
  ceres::CauchyLoss prior_loss_{kPriorLossScale};
  ceres::Problem problem_{LossesAreNotOwned()};
};

}  // namespace

AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const std::vector<Rigid3>& start,
                          const std::function<bool()>& keep_going) {
  Solver solver(problem, start);
  const bool is_usable = solver.Solve(keep_going);
  AdjustedPoses adjusted;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    adjusted.new_cam_from_cam.push_back(is_usable ? solver.MotionOf(i)
                                                  : start[i]);
  }
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    const SpaceEdge& edge = problem.samples[i].edge;
    adjusted.positions.push_back(is_usable ? solver.PositionOf(edge, i)
                                           : edge.position);
  }
  return adjusted;
}

}  // namespace curvix
