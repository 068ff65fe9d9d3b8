// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which primitives a curve is made of.
#include "fitting/choose_primitives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fitting/chain_primitives.h"
#include "fitting/fit_conic.h"

namespace curvix {
namespace {

constexpr std::size_t kMinSplinePoints = 4;
// Neighbouring samples err alike: so many of them tell as much as one.
constexpr double kSamplesPerError = 2;

// The best explanation so far.
class Choice {
 public:
  explicit Choice(double parameter_cost) : parameter_cost_(parameter_cost) {}

  // Whether an explanation with so many parameters could be better.
  bool CanWin(std::size_t num_parameters) const {
    return parameter_cost_ * static_cast<double>(num_parameters) < cost_;
  }
  void Offer(std::vector<Primitive> primitives,
             double residual_cost,
             std::size_t num_parameters) {
    const double cost =
        residual_cost + parameter_cost_ * static_cast<double>(num_parameters);
    if (!(cost < cost_)) return;
    cost_ = cost;
    best_ = std::move(primitives);
  }
  std::vector<Primitive> Take() { return std::move(best_); }

 private:
  double parameter_cost_;
  double cost_ = std::numeric_limits<double>::infinity();
  std::vector<Primitive> best_;
};

// The conic as a primitive of the curve; nullopt: a closed curve does not go
// round it.
std::optional<Primitive> OnCurve(const std::optional<Conic>& conic,
                                 const FitSamples& curve,
                                 bool closed) {
  if (!conic) return std::nullopt;
  const Conic directed = Directed(*conic, curve);
  const bool whole = GoesRound(directed, curve);
  if (closed && !whole) return std::nullopt;
  return Primitive{directed, 0, curve.size(), whole};
}

void OfferSplines(const FitSamples& curve, bool closed, Choice& choice) {
  FitSamples samples = curve;
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> ends;
  if (closed) {
    samples.push_back(curve.front());
    ends = {curve.front().position, curve.front().position};
  }
  for (std::size_t n = kMinSplinePoints;
       2 * n <= samples.size() + kMinSplinePoints && choice.CanWin(3 * n);
       n += std::max<std::size_t>(1, n / 4)) {
    const std::optional<Spline> spline = FitSpline(samples, n, ends);
    if (!spline) continue;
    choice.Offer({{*spline, 0, samples.size(), closed}},
                 CostOf(*spline, samples),
                 3 * n);
  }
}

// The single primitives that a curve may be, by number of parameters.
using SingleFit = std::optional<Primitive> (*)(const FitSamples&, bool);

std::optional<Primitive> Line(const FitSamples& curve, bool closed) {
  const auto line = FitLine(curve);
  if (!line || closed) return std::nullopt;
  return Primitive{*line, 0, curve.size(), false};
}
std::optional<Primitive> Arc(const FitSamples& curve, bool closed) {
  return OnCurve(FitCircle(curve), curve, closed);
}
std::optional<Primitive> Ellipse(const FitSamples& curve, bool closed) {
  const std::optional<Conic> ellipse = FitEllipse(curve);
  if (!ellipse) return std::nullopt;
  double sigma = 0;
  for (const FitSample& s : curve) sigma = std::max(sigma, s.sigma);
  // So round that a circle leaves no outliers: a circle.
  if (ellipse->a - ellipse->b < 2 * kOutlierSigmas * sigma) return std::nullopt;
  return OnCurve(ellipse, curve, closed);
}

struct Single {
  SingleFit fit;
  std::size_t num_parameters;  // of the shape, without its ends
};

constexpr Single kSingles[] = {{Line, 4}, {Arc, 6}, {Ellipse, 8}};

}  // namespace

std::vector<Primitive> ChoosePrimitives(const FitSamples& curve, bool closed) {
  const double parameter_cost =
      kSamplesPerError * std::log(static_cast<double>(curve.size()));
  Choice choice(parameter_cost);
  for (const Single& single : kSingles) {
    const auto primitive = single.fit(curve, closed);
    if (!primitive) continue;
    if (Explains(primitive->shape, curve)) return {*primitive};
    choice.Offer({*primitive},
                 CostOf(primitive->shape, curve),
                 single.num_parameters + (primitive->closed ? 0 : 2));
  }
  if (choice.CanWin(2 * kLineParameters - kNodeParameters)) {
    const Chain chain = ChainPrimitives(curve, closed, parameter_cost);
    choice.Offer(chain.primitives, chain.residual_cost, chain.num_parameters);
  }
  OfferSplines(curve, closed, choice);
  std::vector<Primitive> best = choice.Take();
  if (best.empty()) {  // all samples in one place, say
    best.push_back(
        {FittedLine{curve.front().position, Eigen::Vector3d::UnitX()},
         0,
         curve.size(),
         false});
  }
  return best;
}

}  // namespace curvix
