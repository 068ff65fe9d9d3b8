// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Straight lines.
#include "fitting/fit_line.h"

#include <Eigen/Eigenvalues>

namespace curvix {
namespace {

std::optional<FittedLine> WeightedLine(const FitSamples& samples,
                                       const std::vector<double>& weights) {
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += weights[i];
    mean += weights[i] * samples[i].position;
  }
  mean /= sum;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d offset = samples[i].position - mean;
    scatter += weights[i] * offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  if (!(eigen.eigenvalues()(2) > 0)) return std::nullopt;
  FittedLine line{mean, eigen.eigenvectors().col(2)};
  const Eigen::Vector3d chord =
      samples.back().position - samples.front().position;
  if (line.direction.dot(chord) < 0) line.direction *= -1;
  return line;
}

}  // namespace

std::optional<FittedLine> FitLine(const FitSamples& samples) {
  if (samples.size() < 2) return std::nullopt;
  std::vector<double> weights;
  for (const FitSample& s : samples) weights.push_back(1 / (s.sigma * s.sigma));
  std::optional<FittedLine> line = WeightedLine(samples, weights);
  for (int round = 0; line && round < kNumRounds; ++round) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Eigen::Vector3d& position = samples[i].position;
      weights[i] =
          RobustWeight((position - line->Closest(position)).squaredNorm(),
                       samples[i].sigma,
                       round);
    }
    line = WeightedLine(samples, weights);
  }
  return line;
}

}  // namespace curvix
