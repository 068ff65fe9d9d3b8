// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_equations.h"

#include <curvix/scene.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

namespace curvix {
namespace {

Camera RadialCamera() {
  return {CameraModel::kRadial, 640, 480, {600, 320, 240, -0.05, 0.01}};
}

// A pixel that is 2 sigma and 1 sigma off in x and y.
PoseObservation Observation() {
  Eigen::Matrix3d moves;
  moves << 1, 0.2, 0.1, -0.3, 1, 0.2, 0.1, 0.4, 0.8;
  return {0,
          0,
          0,
          {0.3, -0.2, 3},
          moves,
          {384, 203},
          Eigen::Matrix2d{{2, 0.3}, {-0.1, 1.5}}};
}

PoseUnknowns Unknowns() {
  PoseUnknowns unknowns;
  unknowns.increments.emplace_back();
  unknowns.increments[0] << 0.02, -0.03, 0.01, 0.05, 0.02, -0.04;
  unknowns.lenses.push_back(LensChange::Zero());
  unknowns.offsets.emplace_back(0.01, -0.02, 0.03);
  return unknowns;
}

PoseEquation EquationAt(const PoseUnknowns& unknowns) {
  PoseEquations equations(
      {Observation()}, {RadialCamera()}, {true}, unknowns, 1);
  equations.PrepareForEvaluation(true, true);
  return equations.equations()[0];
}

// Ceres takes it for residual . derivative.
double HalfLossSlope(double* unknown, const PoseUnknowns& unknowns) {
  const double start = *unknown;
  const double step = 1e-5;
  *unknown = start + step;
  const double above = EquationAt(unknowns).loss;
  *unknown = start - step;
  const double below = EquationAt(unknowns).loss;
  *unknown = start;
  return (above - below) / (4 * step);
}

TEST(PoseEquations, HaveTheGradientOfTheLoss) {
  PoseUnknowns unknowns = Unknowns();
  const PoseEquation equation = EquationAt(unknowns);
  ASSERT_GT(equation.loss, 1);
  const Eigen::RowVector2d residual = equation.residual.transpose();
  const auto expect = [&](double* first, const Eigen::RowVectorXd& gradient) {
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      EXPECT_NEAR(HalfLossSlope(first + i, unknowns),
                  gradient[i],
                  1e-4 * (1 + std::abs(gradient[i])))
          << i;
    }
  };
  expect(unknowns.offsets[0].data(), residual * equation.by_offset);
  expect(unknowns.increments[0].data(), residual * equation.by_pose);
  expect(unknowns.lenses[0].data(), residual * equation.by_lens);
}

TEST(PoseEquations, AreInfiniteBehindTheCamera) {
  PoseUnknowns unknowns = Unknowns();
  unknowns.increments[0][5] = -4;
  EXPECT_TRUE(std::isinf(EquationAt(unknowns).loss));
}

TEST(PoseEquations, AreOfEverySampleForAnyNumberOfThreads) {
  const PoseUnknowns unknowns = Unknowns();
  const std::vector<PoseObservation> seen(50, Observation());
  PoseEquations equations(seen, {RadialCamera()}, {false}, unknowns, 3);
  equations.PrepareForEvaluation(false, true);
  for (const PoseEquation& equation : equations.equations()) {
    EXPECT_EQ(equation.residual, EquationAt(unknowns).residual);
  }
}

}  // namespace
}  // namespace curvix
