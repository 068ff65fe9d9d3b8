// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves to primitives.
#include <curvix/fitting.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "fitting/end_covariance.h"
#include "fitting/primitive.h"
#include "fitting/structure.h"
#include "model/posed_view.h"

namespace curvix {
namespace {

CurvePrimitives FitAlone(const FitSamples& samples, bool closed) {
  CurvePrimitives result;
  for (Primitive& primitive : ChoosePrimitives(samples, closed)) {
    const FitSamples own = SamplesOf(primitive, samples);
    const PrimitiveEnd at_start = EndOf(primitive.shape, own, false);
    const PrimitiveEnd at_end = EndOf(primitive.shape, own, true);
    result.push_back({std::move(primitive), at_start, at_end});
  }
  return result;
}

// The samples of a curve.
struct CurveToFit {
  std::size_t id = 0;
  bool closed = false;
  FitSamples samples;
};

// Of most samples of a primitive.
CurveKind KindOf(const FitSamples& samples) {
  Curve part;
  for (const FitSample& s : samples) part.samples.emplace_back().kind = s.kind;
  return MainKind(part);
}

// Calls fit(curve) for each curve, on several threads at once; a bounded number
// of curves is in memory.
template <typename Fit>
void FitEach(const CurveSource& curves,
             const std::vector<PosedView>& views,
             int num_threads,
             const Fit& fit) {
  constexpr std::size_t kMaxSamples = 1 << 18;
  std::vector<CurveToFit> some;
  std::size_t num_samples = 0;
  const auto fit_some = [&] {
    ParallelFor(some.size(), num_threads, [&](std::size_t i) { fit(some[i]); });
    some.clear();
    num_samples = 0;
  };
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    some.push_back({id, curve.closed, MakeSamples(curve, views)});
    num_samples += curve.samples.size();
    if (num_samples >= kMaxSamples) fit_some();
  });
  fit_some();
}

// The samples of a primitive and the nodes at its ends.
struct Snapped {
  FitSamples samples;
  std::optional<Eigen::Vector3d> start;
  std::optional<Eigen::Vector3d> end;
  std::vector<UncertainPoint> nodes;
};

FittedLine ChordOf(const FitSamples& samples) {
  const Eigen::Vector3d& from = samples.front().position;
  return {from, (samples.back().position - from).normalized()};
}

// The node, or the foot of the end sample.
Eigen::Vector3d EndOn(const Shape& shape,
                      const std::optional<Eigen::Vector3d>& node,
                      const FitSample& sample) {
  if (node) return *node;
  const auto foot = FootOn(shape, sample.position);
  return foot ? foot->position : sample.position;
}

// Each returns the shape that is drawn, after filling in its own fields.
struct Draw {
  const Snapped& snapped;
  CurveFit& fit;

  Shape operator()(const FittedLine& line) const {
    const FitSamples& samples = snapped.samples;
    fit.kind = FitKind::kLine;
    fit.start = EndOn(line, snapped.start, samples.front());
    fit.end = EndOn(line, snapped.end, samples.back());
    const Eigen::Vector3d chord = fit.end - fit.start;
    if (!(chord.norm() > 0)) return line;
    return FittedLine{fit.start, chord.normalized()};
  }

  Shape operator()(const Conic& free) const {
    Conic conic = free;
    if (snapped.start || snapped.end) {
      const auto through =
          FitThrough(free, snapped.samples, snapped.start, snapped.end);
      if (!through) return (*this)(ChordOf(snapped.samples));
      conic = Directed(*through, snapped.samples);
    }
    fit.kind = conic.a == conic.b ? FitKind::kArc : FitKind::kEllipse;
    fit.start = EndOn(conic, snapped.start, snapped.samples.front());
    fit.end = EndOn(conic, snapped.end, snapped.samples.back());
    if (fit.closed) fit.end = fit.start;
    SetConic(conic, fit);
    if (fit.kind == FitKind::kArc) {
      fit.arc_covariance =
          ArcCovariance(conic, snapped.samples, snapped.nodes, fit.closed);
      fit.radius_sigma = std::sqrt(fit.arc_covariance(6, 6));
    }
    return conic;
  }

  Shape operator()(const Spline& free) const {
    const FitSamples& samples = snapped.samples;
    const std::pair ends = {snapped.start.value_or(free.At(0)),
                            snapped.end.value_or(free.At(1))};
    const auto spline = FitSpline(samples, free.control_points.size(), ends);
    const Spline& drawn = spline ? *spline : free;
    fit.kind = FitKind::kSpline;
    fit.control_points = drawn.control_points;
    fit.knots = drawn.knots;
    fit.start = drawn.control_points.front();
    fit.end = drawn.control_points.back();
    return drawn;
  }
};

void Judge(const Shape& shape, const FitSamples& samples, CurveFit& fit) {
  const std::vector<double> squared = SquaredDistances(shape, samples);
  double sum = 0, max = 0, variance = 0;
  std::size_t num_inliers = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double s2 = samples[i].sigma * samples[i].sigma;
    variance += s2;
    if (squared[i] > kOutlierSigmas * kOutlierSigmas * s2) continue;
    ++num_inliers;
    sum += squared[i];
    max = std::max(max, squared[i]);
  }
  const double n = static_cast<double>(samples.size());
  const double inliers = static_cast<double>(num_inliers);
  fit.inlier_share = inliers / n;
  fit.rms_residual = num_inliers > 0 ? std::sqrt(sum / inliers) : 0;
  fit.max_residual = std::sqrt(max);
  // Each sample measures two directions across.
  const double share =
      static_cast<double>(NumParameters(shape)) / (2 * std::max(inliers, 1.0));
  const double shared = fit.kind == FitKind::kLine ? 0 : SharedSigma(samples);
  fit.sigma =
      std::hypot(std::sqrt(variance / n * std::min(1.0, share)), shared);
}

// A line or arc as it is drawn; nullopt: another kind.
std::optional<Shape> ShapeOf(const CurveFit& fit) {
  if (fit.kind == FitKind::kLine) {
    return FittedLine{fit.start, (fit.end - fit.start).normalized()};
  }
  if (fit.kind != FitKind::kArc) return std::nullopt;
  Conic conic;
  conic.center = fit.center;
  conic.a = conic.b = fit.major.norm();
  const Eigen::Vector3d x = fit.major.normalized(), y = fit.minor.normalized();
  conic.frame << x, y, x.cross(y);
  return conic;
}

CurveFit FitInNodes(const PrimitiveOfCurve& alone,
                    const std::vector<CurveNode>& nodes,
                    FitSamples samples) {
  CurveFit fit;
  fit.closed = alone.primitive.closed;
  fit.first_sample = alone.primitive.first_sample;
  fit.num_samples = alone.primitive.num_samples;
  fit.curve_kind = KindOf(samples);
  fit.start_node = alone.at_start.node;
  fit.end_node = alone.at_end.node;
  Snapped snapped{std::move(samples), {}, {}, {}};
  const auto snap = [&](const PrimitiveEnd& end,
                        std::optional<Eigen::Vector3d>& position) {
    if (end.node < 0) return MeetingCovariance({end}, end.foot);
    const CurveNode& node = nodes[static_cast<std::size_t>(end.node)];
    position = node.position;
    snapped.nodes.push_back({node.position, node.covariance});
    return node.covariance;
  };
  const Eigen::Matrix3d at_start = snap(alone.at_start, snapped.start);
  const Eigen::Matrix3d at_end = snap(alone.at_end, snapped.end);
  if (!fit.closed) {
    fit.start_covariance = at_start;
    fit.end_covariance = at_end;
  }
  const Shape drawn = std::visit(Draw{snapped, fit}, alone.primitive.shape);
  Judge(drawn, snapped.samples, fit);
  return fit;
}

}  // namespace

FittedCurves FitCurves(const CurveSource& curves,
                       const Scene& scene,
                       const CurveFittingOptions& options,
                       int num_threads) {
  const std::vector<PosedView> views = MakePosedViews(scene);
  std::vector<CurvePrimitives> alone(curves.size());
  FitEach(curves, views, num_threads, [&](const CurveToFit& curve) {
    alone[curve.id] = FitAlone(curve.samples, curve.closed);
  });
  FittedCurves result;
  result.nodes = MeetInNodes(alone);
  result.curves.resize(alone.size());
  const auto fit_one = [&](const CurveToFit& curve, std::size_t f) {
    const PrimitiveOfCurve& own = alone[curve.id][f];
    return FitInNodes(
        own, result.nodes, SamplesOf(own.primitive, curve.samples));
  };
  FitEach(curves, views, num_threads, [&](const CurveToFit& curve) {
    for (std::size_t f = 0; f < alone[curve.id].size(); ++f) {
      result.curves[curve.id].fits.push_back(fit_one(curve, f));
    }
  });
  result.structure = FindStructure(result);
  if (!options.regularize) return result;
  Regularize(result);
  // Lines and arcs have moved; the others follow their nodes.
  FitEach(curves, views, num_threads, [&](const CurveToFit& curve) {
    for (std::size_t f = 0; f < alone[curve.id].size(); ++f) {
      CurveFit& fit = result.curves[curve.id].fits[f];
      if (const std::optional<Shape> shape = ShapeOf(fit)) {
        Judge(*shape,
              SamplesOf(alone[curve.id][f].primitive, curve.samples),
              fit);
      } else {
        fit = fit_one(curve, f);
      }
    }
  });
  return result;
}

}  // namespace curvix
