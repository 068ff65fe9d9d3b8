// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "poses/solve_steps.h"

#include <curvix/parallel.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <optional>
#include <utility>

#include "base/check.h"

namespace curvix {
namespace {

// Of the diagonal that damping multiplies: what nothing tells stays where it
// is.
constexpr double kMinDiagonal = 1e-6;

// Of the trace: radii that views hardly tell from a shift stay.
constexpr double kRadiusDamping = 1e-9;

using Matrix6d = Eigen::Matrix<double, 6, 6>;

template <typename Matrix>
void Damp(double damping, Matrix& matrix) {
  matrix.diagonal() += damping * matrix.diagonal().cwiseMax(kMinDiagonal);
}

// The normal equations of one sample.
struct SampleNormal {
  Eigen::Matrix3d inverse;
  Eigen::Vector3d gradient;
};

// The normal equations of one view without samples, up to its own column.
struct ViewNormal {
  std::vector<std::size_t> view_idxs;
  std::vector<Matrix6d> blocks;
  Vector6d gradient;
};

class System {
 public:
  System(const EquationOwners& owners,
         const std::vector<StepEquation>& equations,
         const std::vector<StepPrior>& priors,
         double damping,
         int num_threads)
      : owners_(owners),
        equations_(equations),
        priors_(priors),
        damping_(damping),
        num_threads_(num_threads),
        samples_(owners.first_of_sample.size() - 1) {}

  Steps Solve() {
    ParallelFor(samples_.size(), num_threads_, [&](std::size_t i) {
      samples_[i] = NormalOfSample(i);
    });
    std::vector<ViewNormal> views(priors_.size());
    ParallelFor(views.size(), num_threads_, [&](std::size_t i) {
      views[i] = NormalOfView(i);
    });
    Steps steps;
    steps.motions = SolveMotions(views);
    steps.offsets.resize(samples_.size());
    ParallelFor(samples_.size(), num_threads_, [&](std::size_t i) {
      steps.offsets[i] = OffsetOf(i, steps.motions);
    });
    return steps;
  }

 private:
  template <typename F>
  void VisitSample(std::size_t sample_idx, const F& f) const {
    for (std::size_t e = owners_.first_of_sample[sample_idx];
         e < owners_.first_of_sample[sample_idx + 1];
         ++e) {
      f(equations_[e], owners_.of_equation[e].view_idx);
    }
  }

  SampleNormal NormalOfSample(std::size_t sample_idx) const {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    VisitSample(sample_idx, [&](const StepEquation& equation, std::size_t) {
      matrix += equation.by_offset * equation.by_offset.transpose();
      gradient += equation.residual * equation.by_offset;
    });
    matrix(2, 2) += kRadiusDamping * matrix.trace();
    Damp(damping_, matrix);
    return {matrix.inverse(), gradient};
  }

  // Of the view's equations alone, as if samples stayed.
  Matrix6d OwnBlock(std::size_t view_idx) const {
    Matrix6d block = priors_[view_idx].factors.cwiseAbs2().asDiagonal();
    for (const std::size_t e : owners_.by_view[view_idx]) {
      block += equations_[e].by_motion * equations_[e].by_motion.transpose();
    }
    Damp(damping_, block);
    return block;
  }

  ViewNormal NormalOfView(std::size_t view_idx) const {
    ViewNormal normal;
    std::vector<std::optional<std::size_t>> places(view_idx + 1);
    const auto block_of = [&](std::size_t other_idx) -> Matrix6d& {
      if (!places[other_idx]) {
        places[other_idx] = normal.blocks.size();
        normal.view_idxs.push_back(other_idx);
        normal.blocks.push_back(Matrix6d::Zero());
      }
      return normal.blocks[*places[other_idx]];
    };
    block_of(view_idx) = OwnBlock(view_idx);
    const StepPrior& prior = priors_[view_idx];
    normal.gradient = prior.factors.cwiseProduct(prior.residuals);
    for (const std::size_t e : owners_.by_view[view_idx]) {
      const StepEquation& own = equations_[e];
      const std::size_t sample_idx = owners_.of_equation[e].sample_idx;
      const SampleNormal& sample = samples_[sample_idx];
      const Eigen::Vector3d pull = sample.inverse * own.by_offset;
      normal.gradient +=
          (own.residual - pull.dot(sample.gradient)) * own.by_motion;
      VisitSample(sample_idx, [&](const StepEquation& other, std::size_t i) {
        if (i > view_idx) return;
        const Vector6d pulled = pull.dot(other.by_offset) * own.by_motion;
        block_of(i).noalias() -= pulled * other.by_motion.transpose();
      });
    }
    return normal;
  }

  static std::vector<Vector6d> SolveMotions(
      const std::vector<ViewNormal>& views) {
    const auto size = static_cast<Eigen::Index>(6 * views.size());
    Eigen::VectorXd gradient(size);
    std::vector<Eigen::Triplet<double>> lower;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto row = static_cast<int>(6 * i);
      gradient.segment<6>(row) = views[i].gradient;
      for (std::size_t k = 0; k < views[i].blocks.size(); ++k) {
        const auto column = static_cast<int>(6 * views[i].view_idxs[k]);
        for (int c = 0; c < 6; ++c) {
          for (int r = 0; r < 6; ++r) {
            lower.emplace_back(row + r, column + c, views[i].blocks[k](r, c));
          }
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(lower.begin(), lower.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    std::vector<Vector6d> steps(views.size(), Vector6d::Zero());
    if (solver.info() != Eigen::Success) return steps;
    const Eigen::VectorXd solution = solver.solve(-gradient);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      steps[i] = solution.segment<6>(static_cast<Eigen::Index>(6 * i));
    }
    return steps;
  }

  // The step of a sample once those of the motions are known.
  Eigen::Vector3d OffsetOf(std::size_t sample_idx,
                           const std::vector<Vector6d>& motions) const {
    Eigen::Vector3d gradient = samples_[sample_idx].gradient;
    VisitSample(sample_idx, [&](const StepEquation& equation, std::size_t i) {
      gradient += equation.by_motion.dot(motions[i]) * equation.by_offset;
    });
    return -(samples_[sample_idx].inverse * gradient);
  }

  const EquationOwners& owners_;
  const std::vector<StepEquation>& equations_;
  const std::vector<StepPrior>& priors_;
  const double damping_;
  const int num_threads_;
  std::vector<SampleNormal> samples_;
};

}  // namespace

EquationOwners::EquationOwners(std::vector<Owner> of_equation_,
                               std::size_t num_views,
                               std::size_t num_samples)
    : of_equation(std::move(of_equation_)),
      by_view(num_views),
      first_of_sample(num_samples + 1, 0) {
  for (std::size_t e = 0; e < of_equation.size(); ++e) {
    by_view[of_equation[e].view_idx].push_back(e);
    ++first_of_sample[of_equation[e].sample_idx + 1];
  }
  for (std::size_t i = 0; i < num_samples; ++i) {
    first_of_sample[i + 1] += first_of_sample[i];
  }
}

Steps SolveSteps(const EquationOwners& owners,
                 const std::vector<StepEquation>& equations,
                 const std::vector<StepPrior>& priors,
                 double damping,
                 int num_threads) {
  CURVIX_CHECK(damping > 0, "damping is " << damping);
  return System(owners, equations, priors, damping, num_threads).Solve();
}

}  // namespace curvix
