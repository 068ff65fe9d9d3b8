// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The observations of AdjustPoses in one form, their
// residuals and derivatives.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/lens.h"
#include "poses/adjust_poses.h"

namespace curvix {

// Where a view sees a sample or a point.
struct PoseObservation {
  std::size_t view_idx;
  std::size_t camera_idx;
  std::size_t sample_idx;    // indices of points follow those of samples
  Eigen::Vector3d position;  // in the camera with its input pose
  Eigen::Matrix3d moves;     // Jacobian of position by the sample's unknowns
  Eigen::Vector2d pixel;
  // By row what is measured from `pixel`, over sigma: of a point x and y, of an
  // edge the distance across and nothing.
  Eigen::Matrix2d axes;
};

// One for each edge of a sample, then for each pixel of a point.
std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem);

// A small increment of a camera in its own frame: rotation vector, translation.
using PoseIncrement = Eigen::Matrix<double, 6, 1>;

PoseIncrement ToIncrement(const Rigid3& rigid);
Rigid3 FromIncrement(const PoseIncrement& increment);

struct PoseUnknowns {
  std::vector<PoseIncrement> increments;  // by view
  std::vector<LensChange> lenses;         // by camera
  // By sample: of the axis across itself, and of the radius. Then by point.
  std::vector<Eigen::Vector3d> offsets;
};

// An observation, and its derivatives in the order of Ceres. Each row is
// multiplied by the root of its weight in Cauchy's loss.
struct PoseEquation {
  template <int kColumns>
  using Rows = Eigen::Matrix<double, 2, kColumns, Eigen::RowMajor>;

  double loss = 0;  // of both rows; infinite behind the camera
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Rows<3> by_offset = Rows<3>::Zero();
  Rows<6> by_pose = Rows<6>::Zero();
  Rows<8> by_lens = Rows<8>::Zero();  // if the camera is free
};

// The equations of all observations. Ceres calls this for new values of the
// unknowns: the threads share the work, and what observations of a view have in
// common is computed once. Costs of Ceres then only copy.
class PoseEquations : public ceres::EvaluationCallback {
 public:
  // `free_lenses`: by camera. `unknowns` must outlive this.
  PoseEquations(std::vector<PoseObservation> observations,
                const std::vector<Camera>& cameras,
                std::vector<bool> free_lenses,
                const PoseUnknowns& unknowns,
                int num_threads);

  void PrepareForEvaluation(bool has_derivatives, bool is_new) override;

  const std::vector<PoseObservation>& observations() const {
    return observations_;
  }
  const std::vector<PoseEquation>& equations() const { return equations_; }
  const std::vector<Lens>& lenses() const { return lenses_; }

 private:
  const std::vector<PoseObservation> observations_;
  std::vector<Lens> lenses_;
  const std::vector<bool> free_lenses_;
  const PoseUnknowns& unknowns_;
  const int num_threads_;
  std::vector<PoseEquation> equations_;
};

// Of a sample, a view, and a camera if `num_lens_params` is not 0. Fails behind
// the camera.
class ObservationCost : public ceres::CostFunction {
 public:
  // `equation` must outlive this.
  ObservationCost(const PoseEquation& equation, int num_lens_params);

  bool Evaluate(double const* const* unknowns,
                double* residuals,
                double** jacobians) const override;

 private:
  const PoseEquation& equation_;
  const int num_lens_params_;
};

// The loss of the equation: Ceres' own losses are of all rows together.
class ObservationLoss : public ceres::LossFunction {
 public:
  // `equation` must outlive this.
  explicit ObservationLoss(const PoseEquation& equation)
      : equation_(equation) {}

  void Evaluate(double square, double* loss) const override;

 private:
  const PoseEquation& equation_;
};

}  // namespace curvix
