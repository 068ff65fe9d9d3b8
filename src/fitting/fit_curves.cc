// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves to primitives.
#include <curvix/fitting.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/median.h"
#include "base/parallel.h"
#include "fitting/choose_primitives.h"
#include "fitting/end_covariance.h"
#include "fitting/fit_conic.h"
#include "fitting/meet_in_nodes.h"
#include "geometry/pixel_size.h"
#include "geometry/posed_views.h"

namespace curvix {
namespace {

constexpr double kUnknownSigmaSteps = 0.05;  // of the distance between samples
// Next to a corner, edges are bent and ends were moved to meet others: pixels,
// and times the error that samples share elsewhere.
constexpr double kBentPx = 4;
constexpr double kBentFactor = 4;

// The median of the known sigmas, else a share of the distance of samples.
double UsualSigma(const Curve& curve) {
  std::vector<double> known;
  for (const CurveSample& s : curve.samples) {
    if (s.sigma > 0) known.push_back(s.sigma);
  }
  if (known.empty()) {
    const double steps =
        static_cast<double>(curve.samples.size() - (curve.closed ? 0 : 1));
    const double sigma = kUnknownSigmaSteps * Length(curve) / steps;
    return sigma > 0 ? sigma : 1;
  }
  return Median(std::move(known));
}

// Of each sample, along the curve, to its nearer end; infinite if it is closed.
std::vector<double> DistancesToEnd(const Curve& curve) {
  const std::size_t n = curve.samples.size();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> distances(n, kInfinity);
  if (curve.closed) return distances;
  const auto step = [&](std::size_t i) {
    return (curve.samples[i + 1].position - curve.samples[i].position).norm();
  };
  distances.front() = distances.back() = 0;
  for (std::size_t i = 1; i < n; ++i) {
    distances[i] = std::min(distances[i], distances[i - 1] + step(i - 1));
  }
  for (std::size_t i = n - 1; i-- > 0;) {
    distances[i] = std::min(distances[i], distances[i + 1] + step(i));
  }
  return distances;
}

// What the primitives of a curve are fitted to.
FitSamples MakeSamples(const Curve& curve,
                       const std::vector<PosedView>& views,
                       const CurveFittingOptions& options) {
  CURVIX_CHECK(curve.samples.size() >= 2, "a curve has two samples or more");
  FitSamples samples;
  const double usual = UsualSigma(curve);
  const std::vector<double> to_end = DistancesToEnd(curve);
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& s = curve.samples[i];
    const double pixel = PixelSize(s.position, s.support, views);
    const double common = options.common_error_px * pixel;
    const double bent = to_end[i] < kBentPx * pixel ? kBentFactor : 1;
    const double own = s.sigma > 0 ? s.sigma : usual;
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - s.tangent * s.tangent.transpose();
    Eigen::Matrix3d covariance = common * common * across;
    covariance += s.covariance.isZero(0) ? Eigen::Matrix3d(own * own * across)
                                         : s.covariance;
    samples.push_back({s.position,
                       std::hypot(own, bent * common),
                       common,
                       pixel,
                       covariance});
  }
  return samples;
}

CurvePrimitives FitAlone(const FitSamples& samples, bool closed) {
  CurvePrimitives result;
  for (Primitive& primitive : ChoosePrimitives(samples, closed)) {
    const FitSamples own = SamplesOf(primitive, samples);
    const auto [at_start, at_end] = EndsOf(primitive.shape, own);
    result.push_back(
        {std::move(primitive), own.front(), own.back(), at_start, at_end});
  }
  return result;
}

// The samples of a curve.
struct CurveToFit {
  std::size_t id = 0;
  bool closed = false;
  FitSamples samples;
  std::vector<CurveKind> kinds;  // of the samples
};

CurveToFit MakeCurveToFit(std::size_t id,
                          const Curve& curve,
                          const std::vector<PosedView>& views,
                          const CurveFittingOptions& options) {
  CurveToFit result{id, curve.closed, MakeSamples(curve, views, options), {}};
  for (const CurveSample& sample : curve.samples) {
    result.kinds.push_back(sample.kind);
  }
  return result;
}

// Of most samples of the primitive.
CurveKind KindOf(const Primitive& primitive,
                 const std::vector<CurveKind>& kinds) {
  Curve part;
  part.samples.resize(primitive.num_samples);
  for (std::size_t i = 0; i < primitive.num_samples; ++i) {
    part.samples[i].kind = kinds[(primitive.first_sample + i) % kinds.size()];
  }
  return MainKind(part);
}

// Calls fit(curve) for each curve, on several threads at once; a bounded number
// of curves is in memory.
template <typename Fit>
void FitEach(const CurveSource& curves,
             const std::vector<PosedView>& views,
             const CurveFittingOptions& options,
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
    some.push_back(MakeCurveToFit(id, curve, views, options));
    num_samples += curve.samples.size();
    if (num_samples >= kMaxSamples) fit_some();
  });
  fit_some();
}

// One primitive and the nodes at its ends.
struct Snapped {
  const Primitive& primitive;
  FitSamples samples;
  std::optional<Eigen::Vector3d> start;
  std::optional<Eigen::Vector3d> end;
};

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
    std::vector<Eigen::Vector3d> points;
    if (snapped.start) points.push_back(*snapped.start);
    if (snapped.end) points.push_back(*snapped.end);
    const Conic conic =
        points.empty() ? free
                       : Directed(FitThrough(free, snapped.samples, points),
                                  snapped.samples);
    fit.kind = conic.a == conic.b ? FitKind::kArc : FitKind::kEllipse;
    fit.center = conic.center;
    fit.major = conic.a * conic.frame.col(0);
    fit.minor = conic.b * conic.frame.col(1);
    fit.start = EndOn(conic, snapped.start, snapped.samples.front());
    fit.end = EndOn(conic, snapped.end, snapped.samples.back());
    fit.start_angle = NearestParameter(conic, fit.start);
    if (fit.closed) {
      fit.end = fit.start;
      fit.end_angle = fit.start_angle + 2 * kPi;
    } else {
      fit.end_angle = NearestParameter(conic, fit.end);
      while (fit.end_angle <= fit.start_angle) fit.end_angle += 2 * kPi;
    }
    if (fit.kind == FitKind::kArc) {
      fit.radius_sigma = std::hypot(RadiusSigma(conic, snapped.samples),
                                    SharedSigma(snapped.samples));
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

std::size_t NumParameters(const CurveFit& fit) {
  switch (fit.kind) {
    case FitKind::kLine:
      return 4;
    case FitKind::kArc:
      return 6;
    case FitKind::kEllipse:
      return 8;
    case FitKind::kSpline:
      return 3 * fit.control_points.size();
  }
  return 0;
}

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
      static_cast<double>(NumParameters(fit)) / (2 * std::max(inliers, 1.0));
  const double shared = fit.kind == FitKind::kLine ? 0 : SharedSigma(samples);
  fit.sigma =
      std::hypot(std::sqrt(variance / n * std::min(1.0, share)), shared);
}

CurveFit MakeFit(const Snapped& snapped) {
  CurveFit fit;
  fit.closed = snapped.primitive.closed;
  fit.first_sample = snapped.primitive.first_sample;
  fit.num_samples = snapped.primitive.num_samples;
  const Shape drawn = std::visit(Draw{snapped, fit}, snapped.primitive.shape);
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
  FitEach(curves, views, options, num_threads, [&](const CurveToFit& curve) {
    alone[curve.id] = FitAlone(curve.samples, curve.closed);
  });
  FittedCurves result;
  result.nodes = MeetInNodes(alone);
  std::vector<std::vector<std::pair<int, int>>> node_of(alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    node_of[i].assign(alone[i].size(), {-1, -1});
  }
  for (std::size_t n = 0; n < result.nodes.size(); ++n) {
    for (const CurveNode::End& end : result.nodes[n].ends) {
      auto& [start, stop] = node_of[end.curve_idx][end.fit_idx];
      (end.at_end ? stop : start) = static_cast<int>(n);
    }
  }
  const auto position = [&](int node) -> std::optional<Eigen::Vector3d> {
    if (node < 0) return std::nullopt;
    return result.nodes[static_cast<std::size_t>(node)].position;
  };
  const auto end_covariance = [&](int node, const PrimitiveEnd& end) {
    return node < 0 ? MeetingCovariance({end}, end.foot)
                    : result.nodes[static_cast<std::size_t>(node)].covariance;
  };
  result.curves.resize(alone.size());
  FitEach(curves, views, options, num_threads, [&](const CurveToFit& curve) {
    for (std::size_t f = 0; f < alone[curve.id].size(); ++f) {
      const Primitive& primitive = alone[curve.id][f].primitive;
      const auto [start, end] = node_of[curve.id][f];
      CurveFit fit = MakeFit({primitive,
                              SamplesOf(primitive, curve.samples),
                              position(start),
                              position(end)});
      fit.curve_kind = KindOf(primitive, curve.kinds);
      fit.start_node = start;
      fit.end_node = end;
      fit.start_covariance = end_covariance(start, alone[curve.id][f].at_start);
      fit.end_covariance = end_covariance(end, alone[curve.id][f].at_end);
      if (fit.closed) fit.start_covariance = fit.end_covariance.setZero();
      result.curves[curve.id].fits.push_back(std::move(fit));
    }
  });
  return result;
}

}  // namespace curvix
