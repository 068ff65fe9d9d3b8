// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/judge_kind.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/infinity.h"

namespace curvix {
namespace {

// Places along a curve are not independent: their strips share errors of the
// poses and what hides them. Each counts as this share of an independent one.
constexpr float kIndependentShare = 0.35F;

// Directions of two surfaces that differ from opposite ones by at most this
// many of kNumDirections are of one surface or of a step, by at least so many
// of a crease.
constexpr int kMaxMarkingBend = 1;
constexpr int kMinCreaseBend = 3;

// Before images are looked at, as where there is no texture: curves are mostly
// edges of surfaces. A step is the crease at the end of the surface in front.
constexpr double kPriorCrease = 0.84;
constexpr double kPriorStep = 0.05;
constexpr double kPriorBoundary = 0.02;
constexpr double kPriorMarking = 0.09;

// Markings whose log Bayes factor is more than this below that of the best are
// unlikely.
constexpr double kLikelyLogBayes = 25;

// How far two directions are from opposite ones, in steps of directions.
int BendBetween(int a, int b) {
  const int apart = std::abs(a - b);
  return std::abs(std::min(apart, kNumDirections - apart) - kNumDirections / 2);
}

// Of surfaces in directions `a` on side 0 of `first`, and `b` on side 1 of
// `second`.
double LogBayesOf(const SurfaceEvidence& first,
                  int a,
                  const SurfaceEvidence& second,
                  int b) {
  return static_cast<double>(first.log_bayes[0][static_cast<std::size_t>(a)]) +
         static_cast<double>(second.log_bayes[1][static_cast<std::size_t>(b)]);
}

// Calls do_pair(a, b) for all directions on side 0 and side 1 that bend so.
template <typename F>
void ForPairs(int min_bend, int max_bend, const F& do_pair) {
  for (int a = 0; a < kNumDirections; ++a) {
    for (int b = 0; b < kNumDirections; ++b) {
      const int bend = BendBetween(a, b);
      if (bend >= min_bend && bend <= max_bend) do_pair(a, b);
    }
  }
}

// The logarithm of the sum of Bayes factors, of which logarithms are given.
double LogSum(const std::vector<double>& logs) {
  if (logs.empty()) return -kInfinity;
  const double largest = std::ranges::max(logs);
  if (!std::isfinite(largest)) return -kInfinity;
  double sum = 0;
  for (const double log : logs) sum += std::exp(log - largest);
  return largest + std::log(sum);
}

// The same of their mean over the directions that views face; minus infinity
// without any.
double LogMean(std::vector<double> logs) {
  std::erase_if(logs, [](double log) { return !std::isfinite(log); });
  if (logs.empty()) return -kInfinity;
  return LogSum(logs) - std::log(static_cast<double>(logs.size()));
}

// Of a surface that ends, and another that begins behind its end and leads on:
// the mean over all directions and depths. Those that were not looked for count
// as zero.
double LogMeanOfSteps(const DepthEvidence& evidence) {
  std::vector<double> steps;
  ForPairs(0, kMaxMarkingBend, [&](int a, int b) {
    const SurfaceEvidence& front = evidence.front();
    if (!std::isfinite(LogBayesOf(front, a, front, b))) return;
    for (std::size_t depth = 1; depth < kNumDepths; ++depth) {
      steps.push_back(LogBayesOf(front, a, evidence[depth], b));
      steps.push_back(LogBayesOf(evidence[depth], a, front, b));
    }
  });
  if (steps.empty()) return -kInfinity;
  return LogSum(steps) - std::log(static_cast<double>(steps.size()));
}

SurfaceEvidence SumAtDepth(const std::vector<std::size_t>& around,
                           const std::vector<DepthEvidence>& evidence,
                           std::size_t depth) {
  const auto num = static_cast<float>(around.size());
  SurfaceEvidence sum;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t d = 0; d < kNumDirections; ++d) {
      float seen = 0, total = 0;
      for (const std::size_t i : around) {
        const float log_bayes = evidence[i][depth].log_bayes[side][d];
        if (!std::isfinite(log_bayes)) continue;
        total += log_bayes;
        ++seen;
      }
      if (seen == 0 || 2 * seen < num) continue;
      sum.log_bayes[side][d] = total * (kIndependentShare * num / seen);
    }
  }
  return sum;
}

}  // namespace

DepthEvidence SumOver(const std::vector<std::size_t>& around,
                      const std::vector<DepthEvidence>& evidence) {
  DepthEvidence sum;
  for (std::size_t depth = 0; depth < kNumDepths; ++depth) {
    sum[depth] = SumAtDepth(around, evidence, depth);
  }
  return sum;
}

KindProbability JudgeKind(const DepthEvidence& evidence) {
  const SurfaceEvidence& front = evidence.front();
  std::vector<double> marking, crease, boundary;
  for (const auto& side : front.log_bayes) {
    boundary.insert(boundary.end(), side.begin(), side.end());
  }
  ForPairs(0, kMaxMarkingBend, [&](int a, int b) {
    marking.push_back(LogBayesOf(front, a, front, b));
  });
  ForPairs(kMinCreaseBend, kNumDirections, [&](int a, int b) {
    crease.push_back(LogBayesOf(front, a, front, b));
  });
  using Score = std::pair<CurveKind, double>;
  const std::array<Score, 3> scores = {
      {{CurveKind::kCrease,
        LogSum({std::log(kPriorCrease) + LogMean(std::move(crease)),
                std::log(kPriorStep) + LogMeanOfSteps(evidence)})},
       {CurveKind::kBoundary,
        std::log(kPriorBoundary) + LogMean(std::move(boundary))},
       {CurveKind::kMarking,
        std::log(kPriorMarking) + LogMean(std::move(marking))}}};
  const auto best = std::ranges::max_element(scores, {}, &Score::second);
  if (!std::isfinite(best->second)) return {};
  double sum = 0;
  for (const auto& score : scores) sum += std::exp(score.second - best->second);
  return {best->first, 1 / sum};
}

DirectionSet DirectionsOfMarkings(const SurfaceEvidence& evidence) {
  double best = -kInfinity;
  ForPairs(0, kMaxMarkingBend, [&](int a, int b) {
    best = std::max(best, LogBayesOf(evidence, a, evidence, b));
  });
  DirectionSet directions;
  if (!std::isfinite(best)) return directions;
  ForPairs(0, kMaxMarkingBend, [&](int a, int b) {
    if (LogBayesOf(evidence, a, evidence, b) < best - kLikelyLogBayes) return;
    directions.set(static_cast<std::size_t>(a));
    directions.set(static_cast<std::size_t>(b));
  });
  return directions;
}

}  // namespace curvix
