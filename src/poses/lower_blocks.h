// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Symmetric systems of equations, by blocks.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

namespace curvix {

// The lower half of a symmetric positive definite matrix, by blocks.
class LowerBlocks {
 public:
  // First row (and column) of each block, ascending from 0; then the number of
  // rows.
  explicit LowerBlocks(std::vector<int> first_rows)
      : first_rows_(std::move(first_rows)) {}

  // Adds `block` at the first row and column of blocks, row >= column. Of
  // blocks on the diagonal, the lower half is read.
  template <typename Matrix>
  void Add(int row, int column, const Matrix& block) {
    for (int c = 0; c < block.cols(); ++c) {
      for (int r = row == column ? c : 0; r < block.rows(); ++r) {
        triplets_.emplace_back(row + r, column + c, block(r, c));
      }
    }
  }

  // The solution for `vector`; empty if there is none. Exact up to 600 rows.
  // Larger systems are solved by conjugate gradients, to a residual of a
  // thousandth of `vector`, since the time of the exact solution is cubic.
  Eigen::VectorXd Solve(const Eigen::VectorXd& vector) const;

 private:
  std::vector<int> first_rows_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

}  // namespace curvix
