// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Steps of views, cameras and samples, by normal
// equations from which the samples are eliminated (Schur complement).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace curvix {

using Vector6d = Eigen::Matrix<double, 6, 1>;
// Of the parameters of a camera; zero for those that it does not have.
using Vector8d = Eigen::Matrix<double, 8, 1>;

// residual + by_pose . step of the view + by_lens . step of its camera +
// by_offset . step of the sample = 0, multiplied by the root of its weight.
struct StepEquation {
  double residual = 0;
  Vector6d by_pose = Vector6d::Zero();
  Eigen::Vector3d by_offset = Eigen::Vector3d::Zero();
  Vector8d by_lens = Vector8d::Zero();  // not read if cameras stay
};

// Equations of the increment of a view, or of the lens of a camera, alone:
// factors * step = -residuals, element by element.
template <typename Vector>
struct PriorEquations {
  Vector factors = Vector::Zero();
  Vector residuals = Vector::Zero();
};
using StepPrior = PriorEquations<Vector6d>;
using LensPrior = PriorEquations<Vector8d>;

// View and sample of each equation; those of one sample are successive.
struct EquationOwners {
  struct Owner {
    std::size_t view_idx, sample_idx;
  };
  std::vector<Owner> of_equation;
  std::vector<std::vector<std::size_t>> by_view;  // equations, ascending
  std::vector<std::size_t> first_of_sample;       // and the end
  std::vector<std::size_t> camera_of_view;

  EquationOwners(std::vector<Owner> of_equation,
                 std::vector<std::size_t> camera_of_view,
                 std::size_t num_samples);
};

struct Steps {
  std::vector<Vector6d> increments;      // by view
  std::vector<Vector8d> lenses;          // by camera; none if cameras stay
  std::vector<Eigen::Vector3d> offsets;  // by sample
};

// The steps of least squares with Marquardt's damping: the diagonal of the
// normal equations is multiplied by 1 + `damping` (> 0). Before, 1e-9 of the
// trace of each sample is added to the diagonal of its third unknown. If the
// equations of the increments have no solution, increments are zero, and
// offsets those of the samples alone. `lens_priors`: one per camera; without
// any, cameras are fixed. The result does not depend on the number of threads.
Steps SolveSteps(const EquationOwners& owners,
                 const std::vector<StepEquation>& equations,
                 const std::vector<StepPrior>& priors,
                 const std::vector<LensPrior>& lens_priors,
                 double damping,
                 int num_threads);

}  // namespace curvix
