// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which lines, arcs, ellipses and splines a curve is
// made of.
#include "fitting/primitive.h"

#include <array>
#include <cmath>

#include "base/infinity.h"

namespace curvix {
namespace {

constexpr std::size_t kMaxPlaces = 80;
constexpr std::size_t kSamplesPerPlace = 5;
constexpr std::size_t kMaxSearched = 400;  // samples that the search looks at
constexpr std::size_t kMinSamples = 10;
// A link that costs as much as so many more arcs is not made longer.
constexpr std::size_t kHopelessArcs = 3;

// What describes a primitive with two ends, and what neighbours share.
constexpr std::size_t kLineParameters = 6;
constexpr std::size_t kArcParameters = 8;
constexpr std::size_t kNodeParameters = 3;

struct FitCost {
  double residual = kInfinity;
  std::size_t num_parameters = 0;

  double Total(double parameter_cost) const {
    return residual + parameter_cost * static_cast<double>(num_parameters);
  }
};

// What a curve is made of.
struct Explanation {
  std::vector<Primitive> primitives;
  FitCost cost;
};

struct Link {
  Shape shape;
  FitCost cost;
};

// The better of a line and an arc. The search is content with rough arcs, which
// may run against the samples.
Link FitLink(FitSpan samples, double parameter_cost, bool is_rough) {
  Link best;
  if (const auto line = FitLine(samples)) {
    const std::vector<double> squared = DistancesFromPart(*line, samples);
    best = {*line, {CostOf(squared, samples), kLineParameters}};
    if (Explains(squared, samples)) return best;
  }
  const double least = best.cost.Total(parameter_cost);
  if (!(parameter_cost * kArcParameters < least)) return best;
  const auto arc = is_rough ? RoughCircle(samples) : FitCircle(samples);
  if (!arc) return best;
  Link link = {
      *arc, {CostOf(SquaredDistances(*arc, samples), samples), kArcParameters}};
  if (!(link.cost.Total(parameter_cost) < least) || GoesRound(*arc, samples)) {
    return best;
  }
  link.cost.residual = CostOf(DistancesFromPart(*arc, samples), samples);
  if (!(link.cost.Total(parameter_cost) < least)) return best;
  if (!is_rough) link.shape = Directed(*arc, samples);
  return link;
}

// Samples first to last of an unrolled curve.
FitSpan Part(FitSpan curve, std::size_t first, std::size_t last) {
  return curve.subspan(first, last - first + 1);
}

// Places for joints, first and last sample included.
std::vector<std::size_t> Places(std::size_t num_samples) {
  const std::size_t n = std::min(kMaxPlaces, num_samples / kSamplesPerPlace);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k <= n; ++k) {
    places.push_back(k * (num_samples - 1) / std::max<std::size_t>(n, 1));
  }
  return places;
}

// Every so many samples, so that at most kMaxSearched remain.
FitSamples Thinned(const FitSamples& curve, std::size_t stride) {
  FitSamples thin;
  for (std::size_t i = 0; i < curve.size(); i += stride) {
    thin.push_back(curve[i]);
  }
  return thin;
}

// The joints, both ends included, with the least cost over all subsets of the
// places: dynamic programming.
std::vector<std::size_t> SearchJoints(const FitSamples& curve,
                                      double parameter_cost) {
  const std::size_t stride = curve.size() / kMaxSearched + 1;
  const FitSamples thin = Thinned(curve, stride);
  const double scale = static_cast<double>(stride);
  const std::vector<std::size_t> places = Places(thin.size());
  const std::size_t min_samples = (kMinSamples + stride - 1) / stride;
  const double hopeless =
      parameter_cost * static_cast<double>(kHopelessArcs * kArcParameters);
  const double line_cost = parameter_cost * kLineParameters;
  std::vector<double> least(places.size(), kInfinity);
  std::vector<std::size_t> from(places.size(), 0);
  least[0] = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (!(least[i] < kInfinity)) continue;
    for (std::size_t j = i + 1; j < places.size(); ++j) {
      if (places[j] - places[i] + 1 < min_samples ||
          least[i] + line_cost >= least[j]) {
        continue;
      }
      const Link link = FitLink(
          Part(thin, places[i], places[j]), parameter_cost / scale, true);
      const double cost =
          least[i] + scale * link.cost.Total(parameter_cost / scale);
      if (cost < least[j]) {
        least[j] = cost;
        from[j] = i;
      }
      if (scale * link.cost.residual > hopeless) break;
    }
  }
  std::vector<std::size_t> joints = {curve.size() - 1};
  for (std::size_t j = from.back(); j > 0; j = from[j]) {
    joints.push_back(places[j] * stride);
  }
  joints.push_back(0);
  std::ranges::reverse(joints);
  return joints;
}

// Moves inner joint k by `step`, to the side where its two links fit better, if
// they do.
void MoveJoint(const FitSamples& curve,
               double parameter_cost,
               std::size_t step,
               std::size_t k,
               std::vector<std::size_t>& joints) {
  const std::size_t before = joints[k - 1];
  const std::size_t here = joints[k];
  const std::size_t after = joints[k + 1];
  const auto cost = [&](std::size_t joint) {
    return FitLink(Part(curve, before, joint), parameter_cost, true)
               .cost.Total(parameter_cost) +
           FitLink(Part(curve, joint, after), parameter_cost, true)
               .cost.Total(parameter_cost);
  };
  double least = cost(here);
  for (const std::size_t there : {here - std::min(step, here), here + step}) {
    const bool has_room =
        there >= before + kMinSamples - 1 && there + kMinSamples - 1 <= after;
    const double moved = has_room ? cost(there) : kInfinity;
    if (moved < least) {
      least = moved;
      joints[k] = there;
    }
  }
}

// Moves each inner joint by ever smaller steps to where its two links fit best.
void MoveJoints(const FitSamples& curve,
                double parameter_cost,
                std::vector<std::size_t>& joints) {
  for (std::size_t step = curve.size() / kMaxPlaces + kSamplesPerPlace;
       step > 0;
       step /= 2) {
    for (std::size_t k = 1; k + 1 < joints.size(); ++k) {
      MoveJoint(curve, parameter_cost, step, k, joints);
    }
  }
}

// A closed curve from sample `first` back to it.
FitSamples Unrolled(const FitSamples& curve, std::size_t first) {
  return SamplesOf({{}, first, curve.size() + 1}, curve);
}

// The chain of lines and arcs with the least cost: residual costs and
// `parameter_cost` for each parameter. Joints are looked for five samples
// apart, at most at 80 places along the curve, and then moved to the best
// sample nearby; ties go to the joint that comes first. No primitive has fewer
// than 10 samples, so that a few bent samples are outliers and no primitive of
// their own. A closed curve is a chain of two or more, or of none at infinite
// cost.
Explanation ChainPrimitives(const FitSamples& curve,
                            bool closed,
                            double parameter_cost) {
  FitSamples samples = closed ? Unrolled(curve, 0) : curve;
  std::vector<std::size_t> joints = SearchJoints(samples, parameter_cost);
  std::size_t first = 0;
  if (closed && joints.size() > 2) {
    // The seam was in any place; the first joint is a better one.
    MoveJoints(samples, parameter_cost, joints);
    first = joints[1];
    samples = Unrolled(curve, first);
    joints = SearchJoints(samples, parameter_cost);
  }
  if (closed && joints.size() == 2) return {};
  MoveJoints(samples, parameter_cost, joints);
  Explanation chain;
  chain.cost.residual = 0;
  for (std::size_t k = 1; k < joints.size(); ++k) {
    const Link link =
        FitLink(Part(samples, joints[k - 1], joints[k]), parameter_cost, false);
    chain.primitives.push_back({link.shape,
                                (first + joints[k - 1]) % curve.size(),
                                joints[k] - joints[k - 1] + 1,
                                false});
    chain.cost.residual += link.cost.residual;
    chain.cost.num_parameters += link.cost.num_parameters;
    if (k > 1 || closed) chain.cost.num_parameters -= kNodeParameters;
  }
  return chain;
}

constexpr std::size_t kMinSplinePoints = 4;
// Neighbouring samples err alike: so many of them tell as much as one.
constexpr double kSamplesPerError = 2;

// The best explanation so far.
struct Choice {
  double parameter_cost;
  Explanation best = {};

  // Whether an explanation with so many parameters could be better.
  bool CanWin(std::size_t num_parameters) const {
    return parameter_cost * static_cast<double>(num_parameters) <
           best.cost.Total(parameter_cost);
  }
  void Offer(Explanation other) {
    if (other.cost.Total(parameter_cost) < best.cost.Total(parameter_cost)) {
      best = std::move(other);
    }
  }
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
  const FitSamples samples = closed ? Unrolled(curve, 0) : curve;
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> ends;
  if (closed) ends = {curve.front().position, curve.front().position};
  for (std::size_t n = kMinSplinePoints;
       2 * n <= samples.size() + kMinSplinePoints && choice.CanWin(3 * n);
       n += std::max<std::size_t>(1, n / 4)) {
    const std::optional<Spline> spline = FitSpline(samples, n, ends);
    if (!spline) continue;
    choice.Offer(
        {{{*spline, 0, samples.size(), closed}},
         {CostOf(SquaredDistances(*spline, samples), samples), 3 * n}});
  }
}

std::optional<Primitive> SingleLine(const FitSamples& curve, bool closed) {
  if (closed) return std::nullopt;
  const auto line = FitLine(curve);
  if (!line) return std::nullopt;
  return Primitive{*line, 0, curve.size(), false};
}
std::optional<Primitive> SingleArc(const FitSamples& curve, bool closed) {
  return OnCurve(FitCircle(curve), curve, closed);
}
std::optional<Primitive> SingleEllipse(const FitSamples& curve, bool closed) {
  return OnCurve(FitEllipse(curve), curve, closed);
}

// Whether there are samples only at corners: most turn by more than 30 degrees,
// which their errors do not explain.
bool IsPolygon(const FitSamples& curve, bool closed) {
  constexpr double kLargestCosine = 0.866;
  constexpr double kMinSigmas = 10;  // between samples
  const std::size_t n = curve.size();
  const std::size_t num_ends = closed ? 0 : 1;  // on either side
  std::size_t num_places = 0, num_turns = 0;
  for (std::size_t i = num_ends; i + num_ends < n; ++i) {
    const Eigen::Vector3d& here = curve[i].position;
    const Eigen::Vector3d before = here - curve[(i + n - 1) % n].position;
    const Eigen::Vector3d after = curve[(i + 1) % n].position - here;
    const double a = before.norm();
    const double b = after.norm();
    ++num_places;
    num_turns += std::min(a, b) > kMinSigmas * curve[i].sigma &&
                         before.dot(after) < kLargestCosine * a * b
                     ? 1
                     : 0;
  }
  return 2 * num_turns > num_places;
}

std::vector<Primitive> LinesBetween(const FitSamples& curve, bool closed) {
  const FitSamples samples = closed ? Unrolled(curve, 0) : curve;
  std::vector<Primitive> lines;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    if (const auto line = FitLine(Part(samples, i, i + 1))) {
      lines.push_back({*line, i, 2, false});
    }
  }
  return lines;
}

// The single primitives that a curve may be, by number of parameters.
constexpr std::array kSingles = {SingleLine, SingleArc, SingleEllipse};

// A circle instead of an ellipse so round that the circle leaves no outliers.
Primitive WithoutSlightOvalness(const Primitive& primitive,
                                const FitSamples& curve,
                                bool closed) {
  const auto* ellipse = std::get_if<Conic>(&primitive.shape);
  if (ellipse == nullptr) return primitive;
  double sigma = 0;
  for (const FitSample& s : curve) sigma = std::max(sigma, s.sigma);
  if (ellipse->a - ellipse->b >= 2 * kOutlierSigmas * sigma) return primitive;
  return SingleArc(curve, closed).value_or(primitive);
}

}  // namespace

std::vector<Primitive> ChoosePrimitives(const FitSamples& curve, bool closed) {
  if (curve.size() > 2 && IsPolygon(curve, closed)) {
    return LinesBetween(curve, closed);
  }
  const double parameter_cost =
      kSamplesPerError * std::log(static_cast<double>(curve.size()));
  Choice choice{parameter_cost};
  for (const auto fit_single : kSingles) {
    const auto primitive = fit_single(curve, closed);
    if (!primitive) continue;
    const auto squared = DistancesFromPart(primitive->shape, curve);
    if (Explains(squared, curve)) {
      return {WithoutSlightOvalness(*primitive, curve, closed)};
    }
    choice.Offer(
        {{*primitive},
         {CostOf(squared, curve),
          NumParameters(primitive->shape) + (primitive->closed ? 0 : 2)}});
  }
  if (choice.CanWin(2 * kLineParameters - kNodeParameters)) {
    choice.Offer(ChainPrimitives(curve, closed, parameter_cost));
  }
  OfferSplines(curve, closed, choice);
  if (choice.best.primitives.empty()) {  // all samples in one place, say
    const FittedLine line(curve.front().position, Eigen::Vector3d::UnitX());
    return {{line, 0, curve.size(), false}};
  }
  if (choice.best.primitives.size() > 1) return choice.best.primitives;
  return {WithoutSlightOvalness(choice.best.primitives.front(), curve, closed)};
}

}  // namespace curvix
