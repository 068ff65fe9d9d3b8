// SPDX-License-Identifier: BSD-3-Clause
#include "poses/lower_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/random.h"

namespace curvix {
namespace {

// Blocks of six rows, like those of views, of which each shares equations with
// some others, and their matrix.
struct Blocks {
  LowerBlocks lower{{0}};
  Eigen::MatrixXd matrix;

  Blocks(int num_blocks, double sign) {
    std::vector<int> first_rows;
    for (int i = 0; i <= num_blocks; ++i) first_rows.push_back(6 * i);
    lower = LowerBlocks(first_rows);
    matrix.setZero(6 * num_blocks, 6 * num_blocks);
    Random random(3);
    for (int i = 0; i < num_blocks; ++i) {
      for (const int k : {i, (i * 7) % (i + 1), i / 2}) {
        Eigen::Matrix<double, 6, 12> both;
        for (double& x : both.reshaped()) x = random.Normal();
        const Eigen::Matrix<double, 12, 12> square = both.transpose() * both;
        Add(i, i, sign * square.topLeftCorner<6, 6>());
        Add(k, k, sign * square.bottomRightCorner<6, 6>());
        Add(i, k, sign * square.topRightCorner<6, 6>());
      }
      Add(i, i, sign * Eigen::MatrixXd::Identity(6, 6));
    }
  }

  void Add(int i, int k, const Eigen::MatrixXd& block) {
    if (i == k) {
      const Eigen::MatrixXd symmetric = (block + block.transpose()) / 2;
      lower.Add(6 * i, 6 * i, symmetric);
      matrix.block(6 * i, 6 * i, 6, 6) += symmetric;
      return;
    }
    lower.Add(6 * i, 6 * k, block);
    matrix.block(6 * i, 6 * k, 6, 6) += block;
    matrix.block(6 * k, 6 * i, 6, 6) += block.transpose();
  }
};

Eigen::VectorXd SomeVector(Eigen::Index size) {
  Random random(5);
  Eigen::VectorXd vector(size);
  for (double& x : vector) x = random.Normal();
  return vector;
}

TEST(LowerBlocks, SolvesFewRowsExactly) {
  const Blocks blocks(20, 1);
  const Eigen::VectorXd meant = SomeVector(120);
  const Eigen::VectorXd solution = blocks.lower.Solve(blocks.matrix * meant);
  ASSERT_EQ(solution.size(), 120);
  EXPECT_LT((solution - meant).norm(), 1e-8 * meant.norm());
}

TEST(LowerBlocks, SolvesManyRowsToAThousandth) {
  const Blocks blocks(150, 1);
  const Eigen::VectorXd vector = SomeVector(900);
  const Eigen::VectorXd solution = blocks.lower.Solve(vector);
  ASSERT_EQ(solution.size(), 900);
  EXPECT_LT((blocks.matrix * solution - vector).norm(), 3e-3 * vector.norm());
}

TEST(LowerBlocks, HasNoSolutionIfManyRowsAreNotPositive) {
  EXPECT_EQ(Blocks(150, -1).lower.Solve(SomeVector(900)).size(), 0);
}

TEST(LowerBlocks, IsZeroForZero) {
  EXPECT_EQ(Blocks(150, 1).lower.Solve(Eigen::VectorXd::Zero(900)).norm(), 0);
}

}  // namespace
}  // namespace curvix
