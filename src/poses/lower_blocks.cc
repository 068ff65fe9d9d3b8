// SPDX-License-Identifier: BSD-3-Clause
#include "poses/lower_blocks.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <cstddef>
#include <utility>

namespace curvix {
namespace {

constexpr Eigen::Index kMaxExactRows = 600;
constexpr int kMaxNumIterations = 200;
constexpr double kTolerance = 1e-3;

using SparseMatrix = Eigen::SparseMatrix<double>;

Eigen::VectorXd SolveExactly(const SparseMatrix& lower,
                             const Eigen::VectorXd& vector) {
  const Eigen::SimplicialLDLT<SparseMatrix> solver(lower);
  if (solver.info() != Eigen::Success) return {};
  return solver.solve(vector);
}

// The inverse of the blocks on the diagonal.
class DiagonalInverse {
 public:
  DiagonalInverse(const SparseMatrix& lower, const std::vector<int>& first_rows)
      : first_rows_(first_rows) {
    for (std::size_t i = 0; i + 1 < first_rows.size(); ++i) {
      const int size = first_rows[i + 1] - first_rows[i];
      const Eigen::MatrixXd block =
          lower.block(first_rows[i], first_rows[i], size, size);
      blocks_.emplace_back(block);  // reads the lower half
    }
  }

  bool exists() const {
    for (const auto& block : blocks_) {
      if (block.info() != Eigen::Success) return false;
    }
    return true;
  }

  Eigen::VectorXd operator*(const Eigen::VectorXd& vector) const {
    Eigen::VectorXd result(vector.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const int row = first_rows_[i], size = first_rows_[i + 1] - row;
      result.segment(row, size) = blocks_[i].solve(vector.segment(row, size));
    }
    return result;
  }

 private:
  const std::vector<int>& first_rows_;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> blocks_;
};

Eigen::VectorXd SolveByGradients(const SparseMatrix& lower,
                                 const std::vector<int>& first_rows,
                                 const Eigen::VectorXd& vector) {
  const DiagonalInverse inverse(lower, first_rows);
  if (!inverse.exists()) return {};
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(vector.size());
  Eigen::VectorXd residual = vector;
  Eigen::VectorXd scaled = inverse * residual;
  Eigen::VectorXd direction = scaled;
  double square = residual.dot(scaled);
  const double enough = kTolerance * kTolerance * square;
  for (int i = 0; i < kMaxNumIterations && square > enough; ++i) {
    const Eigen::VectorXd image =
        lower.selfadjointView<Eigen::Lower>() * direction;
    const double curvature = direction.dot(image);
    if (!(curvature > 0)) return {};
    solution += square / curvature * direction;
    residual -= square / curvature * image;
    scaled = inverse * residual;
    const double next = residual.dot(scaled);
    direction = scaled + next / square * direction;
    square = next;
  }
  return solution;
}

}  // namespace

Eigen::VectorXd LowerBlocks::Solve(const Eigen::VectorXd& vector) const {
  SparseMatrix lower(vector.size(), vector.size());
  lower.setFromTriplets(triplets_.begin(), triplets_.end());
  return vector.size() <= kMaxExactRows
             ? SolveExactly(lower, vector)
             : SolveByGradients(lower, first_rows_, vector);
}

}  // namespace curvix
