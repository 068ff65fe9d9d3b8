// SPDX-License-Identifier: BSD-3-Clause
#include "poses/solve_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr std::size_t kNumViews = 5;
constexpr std::size_t kNumSamples = 30;
constexpr double kDamping = 0.1;

// Every sample is seen by four of the views, of which the last sees nothing.
struct TestProblem {
  EquationOwners owners;
  std::vector<StepEquation> equations;
  std::vector<StepPrior> priors;
};

TestProblem MakeProblem() {
  Random random(7);
  const auto vector6 = [&] {
    Vector6d v;
    v << random.NormalVector(), random.NormalVector();
    return v;
  };
  std::vector<EquationOwners::Owner> owners;
  std::vector<StepEquation> equations;
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      owners.push_back({(i + k) % (kNumViews - 1), i});
      equations.push_back({random.Normal(), vector6(), random.NormalVector()});
    }
  }
  std::vector<StepPrior> priors(kNumViews);
  for (std::size_t i = 0; i + 1 < kNumViews; ++i) {
    priors[i] = {vector6(), vector6()};
  }
  return {{owners, kNumViews, kNumSamples}, equations, priors};
}

// Of all unknowns at once, motions first.
Eigen::VectorXd SolveAtOnce(const TestProblem& problem) {
  const auto num_equations =
      static_cast<Eigen::Index>(problem.equations.size());
  const auto num_motions = static_cast<Eigen::Index>(6 * kNumViews);
  const auto num_unknowns =
      num_motions + static_cast<Eigen::Index>(3 * kNumSamples);
  Eigen::MatrixXd jacobian =
      Eigen::MatrixXd::Zero(num_equations + num_motions, num_unknowns);
  Eigen::VectorXd residuals(jacobian.rows());
  for (Eigen::Index e = 0; e < num_equations; ++e) {
    const auto& owner = problem.owners.of_equation[static_cast<std::size_t>(e)];
    const auto& equation = problem.equations[static_cast<std::size_t>(e)];
    residuals(e) = equation.residual;
    jacobian.row(e).segment<6>(static_cast<Eigen::Index>(6 * owner.view_idx)) =
        equation.by_motion;
    jacobian.row(e).segment<3>(
        num_motions + static_cast<Eigen::Index>(3 * owner.sample_idx)) =
        equation.by_offset;
  }
  for (std::size_t i = 0; i < kNumViews; ++i) {
    const auto begin = static_cast<Eigen::Index>(6 * i);
    residuals.segment<6>(num_equations + begin) = problem.priors[i].residuals;
    jacobian.block<6, 6>(num_equations + begin, begin) =
        problem.priors[i].factors.asDiagonal();
  }
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    const auto begin = num_motions + static_cast<Eigen::Index>(3 * i);
    normal(begin + 2, begin + 2) +=
        1e-9 * normal.diagonal().segment<3>(begin).sum();
  }
  normal.diagonal() += kDamping * normal.diagonal();
  // Nothing tells of the last view.
  for (Eigen::Index i = num_motions - 6; i < num_motions; ++i) normal(i, i) = 1;
  return normal.ldlt().solve(-(jacobian.transpose() * residuals));
}

TEST(SolveSteps, AgreesWithTheSolutionOfAllUnknownsAtOnce) {
  const TestProblem problem = MakeProblem();
  const Steps steps = SolveSteps(
      problem.owners, problem.equations, problem.priors, kDamping, 2);
  const Eigen::VectorXd expected = SolveAtOnce(problem);
  for (std::size_t i = 0; i < kNumViews; ++i) {
    const auto begin = static_cast<Eigen::Index>(6 * i);
    EXPECT_LT((steps.motions[i] - expected.segment<6>(begin)).norm(), 1e-9);
  }
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    const auto begin = static_cast<Eigen::Index>(6 * kNumViews + 3 * i);
    EXPECT_LT((steps.offsets[i] - expected.segment<3>(begin)).norm(), 1e-9);
  }
}

TEST(SolveSteps, LeavesAViewThatSeesNothingWhereItIs) {
  const TestProblem problem = MakeProblem();
  const Steps steps = SolveSteps(
      problem.owners, problem.equations, problem.priors, kDamping, 1);
  EXPECT_TRUE(steps.motions.back().isZero(0));
  EXPECT_FALSE(steps.motions.front().isZero(1e-3));
}

TEST(SolveSteps, IsTheSameForAnyNumberOfThreads) {
  const TestProblem problem = MakeProblem();
  const Steps one = SolveSteps(
      problem.owners, problem.equations, problem.priors, kDamping, 1);
  const Steps three = SolveSteps(
      problem.owners, problem.equations, problem.priors, kDamping, 3);
  EXPECT_EQ(one.motions, three.motions);
  EXPECT_EQ(one.offsets, three.offsets);
}

TEST(SolveSteps, HasNoStepsWithoutEquations) {
  const Steps steps = SolveSteps({{}, 2, 1}, {}, {{}, {}}, kDamping, 1);
  ASSERT_EQ(steps.motions.size(), 2U);
  EXPECT_TRUE(steps.motions[1].isZero(0));
  ASSERT_EQ(steps.offsets.size(), 1U);
  EXPECT_TRUE(steps.offsets[0].isZero(0));
}

}  // namespace
}  // namespace curvix
