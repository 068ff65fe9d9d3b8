// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_equations.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "base/infinity.h"
#include "base/parallel.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

PoseObservation ObservationOfEdge(const PoseProblem& problem,
                                  std::size_t sample_idx,
                                  const PoseSample::Observation& seen) {
  const auto view_idx = static_cast<std::size_t>(seen.view_idx);
  const View& view = problem.scene.views[view_idx];
  const OccludingContour& contour = problem.samples[sample_idx].contour;
  const Rigid3& pose = view.cam_from_world;
  const Eigen::Vector3d center = pose.Inverse().translation;
  Eigen::Matrix3d moves;
  moves << AxesAcross(contour.axis.tangent), SideSeenFrom(contour, center);
  Eigen::Matrix2d axes;
  axes << -seen.edge.tangent.y(), seen.edge.tangent.x(), 0, 0;
  return {view_idx,
          static_cast<std::size_t>(view.camera_idx),
          sample_idx,
          pose * SeenFrom(contour, center).position,
          pose.rotation.toRotationMatrix() * moves,
          seen.edge.position,
          axes / problem.sigmas_px[view_idx]};
}

PoseObservation ObservationOfPoint(const PoseProblem& problem,
                                   std::size_t point_idx,
                                   const PointSample::Observation& seen) {
  const auto view_idx = static_cast<std::size_t>(seen.view_idx);
  const View& view = problem.scene.views[view_idx];
  return {view_idx,
          static_cast<std::size_t>(view.camera_idx),
          problem.samples.size() + point_idx,
          view.cam_from_world * problem.points[point_idx].position,
          view.cam_from_world.rotation.toRotationMatrix(),
          seen.pixel,
          Eigen::Matrix2d::Identity() / problem.point_sigma_px};
}

}  // namespace

std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem) {
  std::vector<PoseObservation> all;
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    for (const auto& seen : problem.samples[i].observations) {
      all.push_back(ObservationOfEdge(problem, i, seen));
    }
  }
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    for (const auto& seen : problem.points[i].observations) {
      all.push_back(ObservationOfPoint(problem, i, seen));
    }
  }
  return all;
}

namespace {

constexpr double kLensStepPx = 0.01;  // of numerical derivatives

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

// A view during the search.
struct ViewState {
  explicit ViewState(const PoseIncrement& increment)
      : rotation(FromIncrement(increment).rotation.toRotationMatrix()),
        translation(increment.tail<3>()),
        left_jacobian(LeftJacobian(increment.head<3>())) {}

  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  Eigen::Matrix3d left_jacobian;
};

// A camera during the search.
struct CameraState {
  CameraState(const Lens& lens, const LensChange& change, bool has_derivatives)
      : camera(lens.Changed(change)) {
    for (Eigen::Index i = 0; has_derivatives && i < lens.num_used(); ++i) {
      const LensChange step = kLensStepPx * LensChange::Unit(i);
      around.push_back(lens.Changed(change - step));
      around.push_back(lens.Changed(change + step));
    }
  }

  // Of a pixel by the parameters; zero without derivatives.
  Eigen::Matrix<double, 2, 8> Derivatives(const Eigen::Vector2d& ideal) const {
    Eigen::Matrix<double, 2, 8> result = Eigen::Matrix<double, 2, 8>::Zero();
    for (std::size_t i = 0; 2 * i < around.size(); ++i) {
      result.col(static_cast<Eigen::Index>(i)) =
          (ImageFromIdeal(around[2 * i + 1], ideal) -
           ImageFromIdeal(around[2 * i], ideal)) /
          (2 * kLensStepPx);
    }
    return result;
  }

  Camera camera;
  std::vector<Camera> around;  // each parameter decreased, then increased
};

void Evaluate(const PoseObservation& seen,
              const ViewState& view,
              const CameraState& camera,
              const Eigen::Vector3d& offset,
              bool has_derivatives,
              PoseEquation& equation) {
  const Eigen::Vector3d turned =
      view.rotation * (seen.position + seen.moves * offset);
  const Eigen::Vector3d x = turned + view.translation;
  if (!(x.z() > 0)) {
    equation.loss = kInfinity;
    return;
  }
  const Eigen::Vector2d ideal = x.hnormalized();
  const Eigen::Vector2d distances =
      seen.axes * (ImageFromIdeal(camera.camera, ideal) - seen.pixel);
  const Eigen::Array2d squares = distances.array().square();
  const Eigen::Vector2d roots = (1 + squares).sqrt().inverse().matrix();
  equation.loss = std::log1p(squares[0]) + std::log1p(squares[1]);
  equation.residual = roots.cwiseProduct(distances);
  if (!has_derivatives) return;
  const Eigen::Matrix2d by_pixel = roots.asDiagonal() * seen.axes;
  const Eigen::Matrix<double, 2, 3> by_x =
      by_pixel * PixelJacobian(camera.camera, x);
  equation.by_offset = by_x * view.rotation * seen.moves;
  equation.by_pose << -by_x * CrossMatrix(turned) * view.left_jacobian, by_x;
  if (!camera.around.empty()) {
    equation.by_lens = by_pixel * camera.Derivatives(ideal);
  }
}

}  // namespace

PoseIncrement ToIncrement(const Rigid3& rigid) {
  const Eigen::AngleAxisd turn(rigid.rotation);
  PoseIncrement increment;
  increment << turn.angle() * turn.axis(), rigid.translation;
  return increment;
}

Rigid3 FromIncrement(const PoseIncrement& increment) {
  return {RotationBy(increment.head<3>()), increment.tail<3>()};
}

PoseEquations::PoseEquations(std::vector<PoseObservation> observations,
                             const std::vector<Camera>& cameras,
                             std::vector<bool> free_lenses,
                             const PoseUnknowns& unknowns,
                             int num_threads)
    : observations_(std::move(observations)),
      lenses_(cameras.begin(), cameras.end()),
      free_lenses_(std::move(free_lenses)),
      unknowns_(unknowns),
      num_threads_(num_threads),
      equations_(observations_.size()) {}

void PoseEquations::PrepareForEvaluation(bool has_derivatives, bool is_new) {
  if (!has_derivatives && !is_new) return;
  const std::vector<ViewState> views(unknowns_.increments.begin(),
                                     unknowns_.increments.end());
  std::vector<CameraState> cameras;
  for (std::size_t i = 0; i < lenses_.size(); ++i) {
    cameras.emplace_back(
        lenses_[i], unknowns_.lenses[i], has_derivatives && free_lenses_[i]);
  }
  ParallelFor(equations_.size(), num_threads_, [&](std::size_t i) {
    const PoseObservation& seen = observations_[i];
    Evaluate(seen,
             views[seen.view_idx],
             cameras[seen.camera_idx],
             unknowns_.offsets[seen.sample_idx],
             has_derivatives,
             equations_[i]);
  });
}

ObservationCost::ObservationCost(const PoseEquation& equation,
                                 int num_lens_params)
    : equation_(equation), num_lens_params_(num_lens_params) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {3, 6};
  if (num_lens_params > 0) {
    mutable_parameter_block_sizes()->push_back(num_lens_params);
  }
}

bool ObservationCost::Evaluate(double const* const* /*unknowns*/,
                               double* residuals,
                               double** jacobians) const {
  if (!std::isfinite(equation_.loss)) return false;
  Eigen::Map<Eigen::Vector2d>{residuals} = equation_.residual;
  if (jacobians == nullptr) return true;
  const auto copy = [&](std::size_t block, const auto& columns) {
    using Columns = PoseEquation::Rows<Eigen::Dynamic>;
    if (jacobians[block] == nullptr) return;
    Eigen::Map<Columns>(jacobians[block], 2, columns.cols()) = columns;
  };
  copy(0, equation_.by_offset);
  copy(1, equation_.by_pose);
  if (num_lens_params_ > 0) {
    copy(2, equation_.by_lens.leftCols(num_lens_params_));
  }
  return true;
}

// The residual is weighted already, so its square is not to be weighted again.
void ObservationLoss::Evaluate(double /*square*/, double* loss) const {
  loss[0] = equation_.loss;
  loss[1] = 1;
  loss[2] = 0;
}

}  // namespace curvix
