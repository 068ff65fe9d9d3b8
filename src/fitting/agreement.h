// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which of many uncertain values are the same.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace curvix {

// The 99.7 % quantile of chi-square, by Wilson and Hilferty's formula.
double ChiSquaredLimit(int degrees_of_freedom);

struct Test {
  double chance = 1;  // that what is unrelated agrees as well; 1: it failed
  double weight = 1;  // what it counts for
};

// The largest `chance` at which the false discovery rate is one in a hundred,
// tests counted by their weight; -1: there is none. By Benjamini and Hochberg's
// rule, with Storey's estimate of the number of unrelated tests: those that
// failed, and one more.
double LargestChance(std::vector<Test> tests);

// A value of one (the first) or two dimensions.
struct UncertainValue {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double bound = 0;  // the largest difference from the mean of its group
  double space = 1;  // in which unrelated values lie: length or area
};

// Values that agree.
struct ValueGroup {
  std::size_t seed = 0;                            // its surest member
  std::vector<std::size_t> members;                // ascending
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // relative to the seed
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double chi_squared = 0;
  int degrees_of_freedom = 0;
};

// Groups of values, as FindStructure describes them, those of one included; in
// the order of seeds. `order`: the values, the surest first. relative(i, seed):
// value i in coordinates that are good near the seed.
std::vector<ValueGroup> FindAgreements(
    const std::vector<std::size_t>& order,
    int num_dimensions,
    const std::function<UncertainValue(std::size_t, std::size_t)>& relative);

}  // namespace curvix
