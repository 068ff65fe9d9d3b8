// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Steps of cameras and samples that bring both to
// agree, by normal equations of which the samples are eliminated.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace curvix {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// residual + by_motion . step of the view + by_offset . step of the sample = 0,
// already times the root of its weight.
struct StepEquation {
  double residual = 0;
  Vector6d by_motion = Vector6d::Zero();
  Eigen::Vector3d by_offset = Eigen::Vector3d::Zero();
};

// Six equations of the motion of a view alone: factors * step = -residuals,
// element by element.
struct StepPrior {
  Vector6d factors = Vector6d::Zero();
  Vector6d residuals = Vector6d::Zero();
};

// Which equation is whose; those of one sample follow each other.
struct EquationOwners {
  struct Owner {
    std::size_t view_idx, sample_idx;
  };
  std::vector<Owner> of_equation;
  std::vector<std::vector<std::size_t>> by_view;  // equations, ascending
  std::vector<std::size_t> first_of_sample;       // and the end

  EquationOwners(std::vector<Owner> of_equation,
                 std::size_t num_views,
                 std::size_t num_samples);
};

struct Steps {
  std::vector<Vector6d> motions;         // by view
  std::vector<Eigen::Vector3d> offsets;  // by sample
};

// The steps of least squares, once the diagonal of the normal equations has
// grown by its `damping`-fold (> 0), as Marquardt does, and that of each third
// unknown of a sample by 1e-9 of the sample's trace before. If the motions have
// none, they are zero, and the offsets those of the samples alone. The same for
// any number of threads.
Steps SolveSteps(const EquationOwners& owners,
                 const std::vector<StepEquation>& equations,
                 const std::vector<StepPrior>& priors,
                 double damping,
                 int num_threads);

}  // namespace curvix
