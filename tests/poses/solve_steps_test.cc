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
// Views share cameras in turns, from the last camera to the first.
struct TestProblem {
  EquationOwners owners;
  std::vector<StepEquation> equations;
  std::vector<StepPrior> priors;
  std::vector<LensPrior> lens_priors;  // none: cameras stay
};

Vector8d Vector8(Random& random) {
  Vector8d v;
  for (double& value : v) value = random.Normal();
  return v;
}

// With no cameras to solve for, cameras stay.
TestProblem MakeProblem(std::size_t num_cameras = 0) {
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
      equations.push_back(
          {random.Normal(), vector6(), random.NormalVector(), Vector8(random)});
    }
  }
  std::vector<StepPrior> priors(kNumViews);
  for (std::size_t i = 0; i + 1 < kNumViews; ++i) {
    priors[i] = {vector6(), vector6()};
  }
  std::vector<LensPrior> lens_priors;
  for (std::size_t i = 0; i < num_cameras; ++i) {
    lens_priors.push_back({Vector8(random), Vector8(random)});
  }
  std::vector<std::size_t> camera_of_view;
  for (std::size_t i = 0; i < kNumViews; ++i) {
    camera_of_view.push_back(
        num_cameras == 0 ? 0 : num_cameras - 1 - i % num_cameras);
  }
  return {
      {owners, camera_of_view, kNumSamples}, equations, priors, lens_priors};
}

// Of all unknowns at once: increments, lenses, offsets.
Eigen::VectorXd SolveAtOnce(const TestProblem& problem) {
  const auto num_equations =
      static_cast<Eigen::Index>(problem.equations.size());
  const auto num_cameras =
      static_cast<Eigen::Index>(problem.lens_priors.size());
  const auto num_increments = static_cast<Eigen::Index>(6 * kNumViews);
  const Eigen::Index num_poses = num_increments + 8 * num_cameras;
  const auto num_unknowns =
      num_poses + static_cast<Eigen::Index>(3 * kNumSamples);
  Eigen::MatrixXd jacobian =
      Eigen::MatrixXd::Zero(num_equations + num_poses, num_unknowns);
  Eigen::VectorXd residuals(jacobian.rows());
  for (Eigen::Index e = 0; e < num_equations; ++e) {
    const auto& owner = problem.owners.of_equation[static_cast<std::size_t>(e)];
    const auto& equation = problem.equations[static_cast<std::size_t>(e)];
    residuals(e) = equation.residual;
    jacobian.row(e).segment<6>(static_cast<Eigen::Index>(6 * owner.view_idx)) =
        equation.by_pose;
    if (num_cameras > 0) {
      const std::size_t camera_idx =
          problem.owners.camera_of_view[owner.view_idx];
      jacobian.row(e).segment<8>(num_increments +
                                 static_cast<Eigen::Index>(8 * camera_idx)) =
          equation.by_lens;
    }
    jacobian.row(e).segment<3>(
        num_poses + static_cast<Eigen::Index>(3 * owner.sample_idx)) =
        equation.by_offset;
  }
  for (std::size_t i = 0; i < kNumViews; ++i) {
    const auto begin = static_cast<Eigen::Index>(6 * i);
    residuals.segment<6>(num_equations + begin) = problem.priors[i].residuals;
    jacobian.block<6, 6>(num_equations + begin, begin) =
        problem.priors[i].factors.asDiagonal();
  }
  for (Eigen::Index i = 0; i < num_cameras; ++i) {
    const LensPrior& prior = problem.lens_priors[static_cast<std::size_t>(i)];
    const Eigen::Index begin = num_increments + 8 * i;
    residuals.segment<8>(num_equations + begin) = prior.residuals;
    jacobian.block<8, 8>(num_equations + begin, begin) =
        prior.factors.asDiagonal();
  }
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    const auto begin = num_poses + static_cast<Eigen::Index>(3 * i);
    normal(begin + 2, begin + 2) +=
        1e-9 * normal.diagonal().segment<3>(begin).sum();
  }
  normal.diagonal() += kDamping * normal.diagonal();
  // Nothing tells of the last view.
  for (Eigen::Index i = num_increments - 6; i < num_increments; ++i)
    normal(i, i) = 1;
  return normal.ldlt().solve(-(jacobian.transpose() * residuals));
}

Steps Solve(const TestProblem& problem, int num_threads) {
  return SolveSteps(problem.owners,
                    problem.equations,
                    problem.priors,
                    problem.lens_priors,
                    kDamping,
                    num_threads);
}

void ExpectStepsOfAllAtOnce(const TestProblem& problem) {
  const Steps steps = Solve(problem, 2);
  Eigen::VectorXd all(SolveAtOnce(problem).size());
  Eigen::Index at = 0;
  const auto append = [&](const auto& vectors) {
    for (const auto& vector : vectors) {
      all.segment(at, vector.size()) = vector;
      at += vector.size();
    }
  };
  append(steps.increments);
  append(steps.lenses);
  append(steps.offsets);
  ASSERT_EQ(at, all.size());
  EXPECT_LT((all - SolveAtOnce(problem)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(SolveSteps, AgreesWithTheSolutionOfAllUnknownsAtOnce) {
  ExpectStepsOfAllAtOnce(MakeProblem());
}

TEST(SolveSteps, AgreesWithItIfSharedLensesChangeToo) {
  ExpectStepsOfAllAtOnce(MakeProblem(2));
}

TEST(SolveSteps, AgreesWithItIfSomeOrAllLensesAreOfOneView) {
  ExpectStepsOfAllAtOnce(MakeProblem(4));
  ExpectStepsOfAllAtOnce(MakeProblem(kNumViews));
}

TEST(SolveSteps, LeavesAViewThatSeesNothingWhereItIs) {
  const TestProblem problem = MakeProblem();
  const Steps steps = Solve(problem, 1);
  EXPECT_TRUE(steps.increments.back().isZero(0));
  EXPECT_FALSE(steps.increments.front().isZero(1e-3));
}

TEST(SolveSteps, IsTheSameForAnyNumberOfThreads) {
  const TestProblem problem = MakeProblem(4);
  const Steps one = Solve(problem, 1);
  const Steps three = Solve(problem, 3);
  EXPECT_EQ(one.increments, three.increments);
  EXPECT_EQ(one.lenses, three.lenses);
  EXPECT_EQ(one.offsets, three.offsets);
}

TEST(SolveSteps, HasNoStepsWithoutEquations) {
  const Steps steps =
      SolveSteps({{}, {0, 0}, 1}, {}, {{}, {}}, {}, kDamping, 1);
  ASSERT_EQ(steps.increments.size(), 2U);
  EXPECT_TRUE(steps.increments[1].isZero(0));
  ASSERT_EQ(steps.offsets.size(), 1U);
  EXPECT_TRUE(steps.offsets[0].isZero(0));
}

}  // namespace
}  // namespace curvix
