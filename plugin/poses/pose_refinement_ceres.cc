// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>
#include <curvix/scene.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/cancelled.h"
#include "base/median.h"
#include "geometry/directions.h"
#include "plugin/poses/pose_refiners.h"

namespace curvix {
namespace {

constexpr double kLossScalePx = 1;
// Standard deviation of the prior on poses, as a shift in the image.
constexpr double kPriorPx = 10;
constexpr int kMaxNumIterations = 100;

using Vector6d = Eigen::Matrix<double, 6, 1>;
using RowMatrix23d = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowMatrix26d = Eigen::Matrix<double, 2, 6, Eigen::RowMajor>;

// RotationBy(w + dw) ~ RotationBy(w) RotationBy(J dw) for small dw: this is J.
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& w) {
  const double angle2 = w.squaredNorm();
  const double angle = std::sqrt(angle2);
  const bool small = angle < 1e-4;
  const double a = small ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double b = small ? 1.0 / 6 - angle2 / 120
                         : (angle - std::sin(angle)) / (angle2 * angle);
  const Eigen::Matrix3d cross = CrossMatrix(w);
  return Eigen::Matrix3d::Identity() - a * cross + b * cross * cross;
}

// A pose is the input pose followed by an increment: rotation vector, then
// translation, both in the camera's frame.
Rigid3 Moved(const Vector6d& motion, const Rigid3& pose) {
  return Rigid3{RotationBy(motion.head<3>()), motion.tail<3>()} * pose;
}

// Projected minus observed, in pixels. Parameters: the increment of the pose
// (6) and the point (3).
class ReprojectionCost : public ceres::SizedCostFunction<2, 6, 3> {
 public:
  ReprojectionCost(const Camera& camera,
                   const Rigid3& pose,
                   const Eigen::Vector2d& pixel)
      : camera_(camera), pose_(pose), pixel_(pixel) {}

  // False behind the camera and where it has no pixel.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> point(parameters[1]);
    const Eigen::Vector3d before = pose_ * point;
    const Eigen::Map<const Vector6d> motion(parameters[0]);
    const Eigen::Quaterniond turn = RotationBy(motion.head<3>());
    const Eigen::Vector3d x = turn * before + motion.tail<3>();
    if (!(x.z() > 0)) return false;
    const Eigen::Vector2d uv = x.hnormalized();
    const Eigen::Vector2d seen = ImageFromIdeal(camera_, uv);
    if (!seen.allFinite()) return false;
    Eigen::Map<Eigen::Vector2d> residual(residuals);
    residual = seen - pixel_;
    if (jacobians == nullptr) return true;

    RowMatrix23d by_x;
    by_x << 1, 0, -uv.x(), 0, 1, -uv.y();
    by_x = ImageFromIdealJacobian(camera_, uv) * by_x / x.z();
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMatrix26d> by_motion(jacobians[0]);
      by_motion.leftCols<3>() = -by_x * turn.toRotationMatrix() *
                                CrossMatrix(before) *
                                RightJacobian(motion.head<3>());
      by_motion.rightCols<3>() = by_x;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<RowMatrix23d> by_point(jacobians[1]);
      by_point = by_x * (turn * pose_.rotation).toRotationMatrix();
    }
    return true;
  }

 private:
  const Camera& camera_;
  const Rigid3 pose_;
  const Eigen::Vector2d pixel_;
};

// Prior of a pose: each of the six residuals is 1 where the increment shifts
// the image by kPriorPx.
class PriorCost : public ceres::SizedCostFunction<6, 6> {
 public:
  // Focal length in pixels; distance to what the view sees.
  PriorCost(double focal_px, double distance) {
    weights_.head<3>().setConstant(focal_px / kPriorPx);
    weights_.tail<3>().setConstant(focal_px / (distance * kPriorPx));
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Vector6d> motion(parameters[0]);
    Eigen::Map<Vector6d> residual(residuals);
    residual = weights_.cwiseProduct(motion);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> by_motion(
          jacobians[0]);
      by_motion = weights_.asDiagonal();
    }
    return true;
  }

 private:
  Vector6d weights_;
};

// Median depths of what the views see.
std::vector<double> MedianDepths(const Bundle& bundle) {
  std::vector<std::vector<double>> depths(bundle.views.size());
  for (const BundlePoint& point : bundle.points) {
    for (const BundleObservation& seen : point.observations) {
      const Rigid3& pose = bundle.views[seen.view_idx].cam_from_world;
      depths[seen.view_idx].push_back((pose * point.position).z());
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& values : depths) {
    medians.push_back(values.empty() ? 1 : MedianOrNan(std::move(values)));
  }
  return medians;
}

class Stopper : public ceres::IterationCallback {
 public:
  explicit Stopper(const KeepGoing& keep_going) : keep_going_(keep_going) {}
  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary&) override {
    return keep_going_() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  const KeepGoing& keep_going_;
};

// The unknowns of a bundle, as Ceres moves them.
class BundleProblem {
 public:
  explicit BundleProblem(const Bundle& bundle)
      : bundle_(bundle), motions_(bundle.views.size(), Vector6d::Zero()) {
    for (const BundlePoint& point : bundle.points) {
      positions_.push_back(point.position);
    }
    AddObservations();
    AddPriors();
  }

  ceres::Solver::Summary Solve(const KeepGoing& keep_going) {
    Stopper stopper(keep_going);
    ceres::Solver::Options options;
    options.max_num_iterations = kMaxNumIterations;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&stopper);
    constexpr std::size_t kMaxDenseViews = 60;
    options.linear_solver_type = bundle_.views.size() <= kMaxDenseViews
                                     ? ceres::DENSE_SCHUR
                                     : ceres::SPARSE_SCHUR;
    // Not one that sums in threads of its own.
    if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::EIGEN_SPARSE)) {
      options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  Bundle Solution() const {
    Bundle result = bundle_;
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      Rigid3& pose = result.views[i].cam_from_world;
      pose = Moved(motions_[i], pose);
    }
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      result.points[i].position = positions_[i];
    }
    return result;
  }

 private:
  void AddObservations() {
    for (std::size_t i = 0; i < bundle_.points.size(); ++i) {
      for (const BundleObservation& seen : bundle_.points[i].observations) {
        const BundleView& view = bundle_.views[seen.view_idx];
        auto cost = std::make_unique<ReprojectionCost>(
            bundle_.cameras[view.camera_idx], view.cam_from_world, seen.pixel);
        problem_.AddResidualBlock(cost.release(),
                                  &loss_,
                                  motions_[seen.view_idx].data(),
                                  positions_[i].data());
      }
    }
  }

  void AddPriors() {
    const std::vector<double> depths = MedianDepths(bundle_);
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const Camera& camera = bundle_.cameras[bundle_.views[i].camera_idx];
      const double focal_px = PinholeCalibration(camera)(0, 0);
      auto prior = std::make_unique<PriorCost>(focal_px, depths[i]);
      problem_.AddResidualBlock(prior.release(), nullptr, motions_[i].data());
    }
  }

  static ceres::Problem::Options LossesAreNotOwned() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  const Bundle& bundle_;
  // None of these may be resized once problem_ points into them.
  std::vector<Vector6d> motions_;
  std::vector<Eigen::Vector3d> positions_;
  ceres::CauchyLoss loss_{kLossScalePx};
  ceres::Problem problem_{LossesAreNotOwned()};
};

}  // namespace

Result<Bundle> RefineWithCeres(const Bundle& bundle,
                               const KeepGoing& keep_going) {
  BundleProblem problem(bundle);
  const ceres::Solver::Summary summary = problem.Solve(keep_going);
  if (summary.termination_type == ceres::USER_FAILURE) {
    return CancelledStatus();
  }
  if (!summary.IsSolutionUsable()) {
    return Status(StatusCode::kExternalTool,
                  "Ceres found no solution (" + summary.message + ")");
  }
  return problem.Solution();
}

}  // namespace curvix
