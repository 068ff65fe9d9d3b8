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
  // Where blocks begin, rows and columns alike: ascending, 0 first; and the
  // end.
  explicit LowerBlocks(std::vector<int> first_rows)
      : first_rows_(std::move(first_rows)) {}

  // Adds `block` at a row and a column at which blocks begin, row >= column.
  // Of blocks on the diagonal, the lower half is read.
  template <typename Matrix>
  void Add(int row, int column, const Matrix& block) {
    for (int c = 0; c < block.cols(); ++c) {
      for (int r = row == column ? c : 0; r < block.rows(); ++r) {
        triplets_.emplace_back(row + r, column + c, block(r, c));
      }
    }
  }

  // The solution for `vector`; empty if there is none. Exact up to 600 rows:
  // the time of more would grow with their third power, so they are solved by
  // conjugate gradients, to a thousandth of `vector`.
  Eigen::VectorXd Solve(const Eigen::VectorXd& vector) const;

 private:
  std::vector<int> first_rows_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

}  // namespace curvix
