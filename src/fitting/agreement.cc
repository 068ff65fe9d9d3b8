// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which of many uncertain values are the same.
#include "fitting/structure.h"

#include <Eigen/Dense>
#include <algorithm>

#include "base/infinity.h"

namespace curvix {
namespace {

constexpr double kMaxFalseDiscoveryRate = 0.01;

// The inverse of a covariance whose second dimension may not exist.
Eigen::Matrix2d Information(const Eigen::Matrix2d& covariance, int dimensions) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  if (dimensions == 1) {
    information(0, 0) = 1 / covariance(0, 0);
  } else {
    information = covariance.inverse();
  }
  return information;
}

class Finder {
 public:
  Finder(
      int dimensions,
      const std::function<UncertainValue(std::size_t, std::size_t)>& relative)
      : dimensions_(dimensions), relative_(relative) {}

  std::vector<ValueGroup> Find(std::vector<std::size_t> order) {
    std::vector<ValueGroup> groups = Grouped(order);
    const std::vector<Test> tests = Tests(order, groups);
    const double limit = LargestChance(tests);
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < order.size(); ++k) {
      // What is alone may stay.
      const double chance = tests[k].chance;
      if (chance <= limit || chance == 1) kept.push_back(order[k]);
    }
    if (kept.size() < order.size()) groups = Grouped(kept);
    for (ValueGroup& group : groups) DropOutliers(group);
    return groups;
  }

 private:
  std::vector<ValueGroup> Grouped(const std::vector<std::size_t>& order) const {
    std::vector<ValueGroup> groups;
    for (const std::size_t i : order) {
      const std::size_t g = Nearest(i, groups);
      if (g == groups.size()) groups.push_back({i, {}});
      groups[g].members.push_back(i);
      Update(groups[g]);
    }
    // Means have moved since the first fits came.
    std::vector<std::vector<std::size_t>> members(groups.size());
    for (const std::size_t i : order) {
      const std::size_t g = Nearest(i, groups);
      if (g < groups.size()) members[g].push_back(i);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      groups[g].members = members[g];
      std::ranges::sort(groups[g].members);
      Update(groups[g]);
    }
    std::erase_if(groups,
                  [](const ValueGroup& g) { return g.members.empty(); });
    return groups;
  }

  // The square of an offset in standard deviations.
  double Squared(const Eigen::Vector2d& off,
                 const Eigen::Matrix2d& covariance) const {
    return off.dot(Information(covariance, dimensions_) * off);
  }

  // From the group, in standard deviations; infinite: too far.
  double SquaredDistance(std::size_t i, const ValueGroup& group) const {
    const UncertainValue v = relative_(i, group.seed);
    const Eigen::Vector2d off = v.value - group.mean;
    if (!(off.norm() <= v.bound)) return kInfinity;
    const bool is_member =
        std::ranges::find(group.members, i) != group.members.end();
    // A member's own part of the mean makes it nearer than it is.
    const Eigen::Matrix2d covariance =
        is_member ? v.covariance
                  : Eigen::Matrix2d(v.covariance + group.covariance);
    const double squared = Squared(off, covariance);
    return squared <= ChiSquaredLimit(dimensions_) ? squared : kInfinity;
  }

  std::size_t Nearest(std::size_t i,
                      const std::vector<ValueGroup>& groups) const {
    std::size_t nearest = groups.size();
    double least = kInfinity;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double squared = SquaredDistance(i, groups[g]);
      if (squared < least) nearest = g;
      least = std::min(least, squared);
    }
    return nearest;
  }

  void Update(ValueGroup& group) const {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double squares = 0;
    for (const std::size_t i : group.members) {
      const UncertainValue v = relative_(i, group.seed);
      const Eigen::Matrix2d own = Information(v.covariance, dimensions_);
      sum += own;
      right += own * v.value;
      squares += v.value.dot(own * v.value);
    }
    if (group.members.empty()) return;
    group.covariance = Information(sum, dimensions_);
    group.mean = group.covariance * right;
    group.chi_squared = std::max(0.0, squares - group.mean.dot(right));
    group.degrees_of_freedom =
        dimensions_ * (static_cast<int>(group.members.size()) - 1);
  }

  // Of each value: the chance that one from anywhere comes as near to a group;
  // 1 if it is in none.
  std::vector<Test> Tests(const std::vector<std::size_t>& order,
                          const std::vector<ValueGroup>& groups) const {
    double num_shared = 0;
    for (const ValueGroup& g : groups) num_shared += g.members.size() > 1;
    std::vector<Test> tests(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      const std::size_t g = Nearest(i, groups);
      if (g == groups.size() || groups[g].seed == i) continue;
      const UncertainValue v = relative_(i, groups[g].seed);
      const Eigen::Vector2d off = v.value - groups[g].mean;
      const double reach = dimensions_ == 1
                               ? 2 * off.norm()
                               : kPi * Squared(off, v.covariance) *
                                     std::sqrt(v.covariance.determinant());
      tests[k].chance = std::min(1.0, num_shared * reach / v.space);
    }
    return tests;
  }

  void DropOutliers(ValueGroup& group) const {
    while (group.degrees_of_freedom > 0 &&
           group.chi_squared > ChiSquaredLimit(group.degrees_of_freedom)) {
      std::size_t worst = 0;
      double most = -1;
      for (std::size_t k = 0; k < group.members.size(); ++k) {
        const UncertainValue v = relative_(group.members[k], group.seed);
        const double squared = Squared(v.value - group.mean, v.covariance);
        if (squared > most) worst = k;
        most = std::max(most, squared);
      }
      group.members.erase(group.members.begin() +
                          static_cast<std::ptrdiff_t>(worst));
      Update(group);
    }
  }

  int dimensions_;
  const std::function<UncertainValue(std::size_t, std::size_t)>& relative_;
};

}  // namespace

double ChiSquaredLimit(int degrees_of_freedom) {
  constexpr double kQuantile = 2.782;  // of the normal distribution: 99.73 %
  const double part = 2.0 / (9 * degrees_of_freedom);
  return degrees_of_freedom *
         std::pow(1 - part + kQuantile * std::sqrt(part), 3);
}

double LargestChance(std::vector<Test> tests) {
  std::ranges::sort(tests, {}, &Test::chance);
  double failed = 0, passed = 0, largest = -1;
  for (const Test& test : tests) {
    if (test.chance == 1) failed += test.weight;
  }
  for (const Test& test : tests) {
    if (test.chance == 1) break;
    passed += test.weight;
    const double accidents = (failed + test.weight) * test.chance;
    if (accidents <= kMaxFalseDiscoveryRate * passed) largest = test.chance;
  }
  return largest;
}

std::vector<ValueGroup> FindAgreements(
    const std::vector<std::size_t>& order,
    int num_dimensions,
    const std::function<UncertainValue(std::size_t, std::size_t)>& relative) {
  return Finder(num_dimensions, relative).Find(order);
}

}  // namespace curvix
