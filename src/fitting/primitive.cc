// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/primitive.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/angles.h"
#include "base/check.h"
#include "base/infinity.h"
#include "base/median.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Standard deviation of samples that come without: pixels of the view that sees
// the sample largest, and at most this share of the distance between samples.
constexpr double kUnknownSigmaPx = 1;
constexpr double kUnknownSigmaSteps = 0.05;
// Standard deviation of the error that neighbouring samples have in common, as
// of edges in blurred or bent images: added, in squares, to the sigma of each
// sample. Pixels of the view that sees the sample largest.
constexpr double kCommonErrorPx = 0.1;
// Next to a corner, edges are bent and ends were moved to meet others: pixels,
// and times the error that samples share elsewhere.
constexpr double kBentPx = 4;
constexpr double kBentFactor = 4;

// The median of the known sigmas; nullopt if none is known.
std::optional<double> UsualSigma(const Curve& curve) {
  std::vector<double> known;
  for (const CurveSample& s : curve.samples) {
    if (s.sigma > 0) known.push_back(s.sigma);
  }
  if (known.empty()) return std::nullopt;
  return Median(std::move(known));
}

double MeanStep(const Curve& curve) {
  return Length(curve) /
         static_cast<double>(curve.samples.size() - (curve.closed ? 0 : 1));
}

// Where none is known. `pixel`: 0 if no view sees the sample.
double AssumedSigma(double mean_step, double pixel) {
  double sigma = kUnknownSigmaSteps * mean_step;
  if (pixel > 0) sigma = std::min(sigma, kUnknownSigmaPx * pixel);
  return sigma > 0 ? sigma : 1;
}

// Of each sample, along the curve, to its nearer end; infinite if it is closed.
std::vector<double> DistancesToEnd(const Curve& curve) {
  const std::size_t n = curve.samples.size();
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

}  // namespace

FitSamples MakeSamples(const Curve& curve,
                       const std::vector<PosedView>& views) {
  CURVIX_CHECK(curve.samples.size() >= 2, "a curve has two samples or more");
  FitSamples samples;
  const std::optional<double> usual = UsualSigma(curve);
  const double mean_step = MeanStep(curve);
  const std::vector<double> to_end = DistancesToEnd(curve);
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& s = curve.samples[i];
    const double pixel = PixelSize(s, views);
    const double common = kCommonErrorPx * pixel;
    const double bent = to_end[i] < kBentPx * pixel ? kBentFactor : 1;
    const double own =
        s.sigma > 0 ? s.sigma : usual.value_or(AssumedSigma(mean_step, pixel));
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - s.tangent * s.tangent.transpose();
    Eigen::Matrix3d covariance = common * common * across;
    covariance += s.covariance.isZero(0) ? Eigen::Matrix3d(own * own * across)
                                         : s.covariance;
    samples.push_back({s.position,
                       std::hypot(own, bent * common),
                       common,
                       pixel,
                       covariance,
                       s.kind});
  }
  return samples;
}

namespace {

std::optional<FittedLine> WeightedLine(FitSpan samples,
                                       const std::vector<double>& weights) {
  const auto [mean, scatter] = WeightedScatter(samples, weights);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  if (!(eigen.eigenvalues()(2) > 0)) return std::nullopt;
  FittedLine line(mean, eigen.eigenvectors().col(2));
  const Eigen::Vector3d chord =
      samples.back().position - samples.front().position;
  if (line.direction().dot(chord) < 0) line.direction() *= -1;
  return line;
}

double SquaredDistance(const FittedLine& line, const Eigen::Vector3d& point) {
  return (point - line.projection(point)).squaredNorm();
}

struct DistancesFrom {
  FitSpan samples;

  std::vector<double> operator()(const auto& shape) const {
    std::vector<double> squared;
    squared.reserve(samples.size());
    for (const FitSample& s : samples) {
      squared.push_back(SquaredDistance(shape, s.position));
    }
    return squared;
  }
  std::vector<double> operator()(const Spline& spline) const {
    return SquaredDistances(spline, samples);
  }
};

// How far the samples are along a line or conic, from anywhere; of ellipses, at
// least so far. None: a spline.
std::vector<double> PlacesAlong(const Shape& shape, FitSpan samples) {
  std::vector<double> places;
  if (const auto* conic = std::get_if<Conic>(&shape)) {
    places = UnwrappedAngles(*conic, samples);
    for (double& place : places) place *= conic->b;
  } else if (const auto* line = std::get_if<FittedLine>(&shape)) {
    for (const FitSample& s : samples) {
      places.push_back(line->direction().dot(s.position - line->origin()));
    }
  }
  return places;
}

}  // namespace

std::size_t NumParameters(const Shape& shape) {
  if (const auto* spline = std::get_if<Spline>(&shape)) {
    return 3 * spline->control_points.size();
  }
  const auto* conic = std::get_if<Conic>(&shape);
  if (conic == nullptr) return 4;
  return conic->a == conic->b ? 6 : 8;
}

FitSamples SamplesOf(const Primitive& primitive, const FitSamples& curve) {
  FitSamples samples;
  for (std::size_t k = 0; k < primitive.num_samples; ++k) {
    samples.push_back(curve[(primitive.first_sample + k) % curve.size()]);
  }
  return samples;
}

std::vector<double> SquaredDistances(const Shape& shape, FitSpan samples) {
  return std::visit(DistancesFrom{samples}, shape);
}

double CostOf(const std::vector<double>& squared_distances, FitSpan samples) {
  double cost = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double sigma = samples[i].sigma;
    cost += std::min(squared_distances[i] / (sigma * sigma),
                     kOutlierSigmas * kOutlierSigmas);
  }
  return cost;
}

std::vector<double> DistancesFromPart(const Shape& shape, FitSpan samples) {
  std::vector<double> squared = SquaredDistances(shape, samples);
  const std::vector<double> places = PlacesAlong(shape, samples);
  if (places.empty()) return squared;
  const auto [from, to] = std::minmax(places.front(), places.back());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double beyond = std::max(from - places[i], places[i] - to);
    if (beyond > kOutlierSigmas * samples[i].sigma) {
      squared[i] += beyond * beyond;
    }
  }
  return squared;
}

bool Explains(const std::vector<double>& squared_distances, FitSpan samples) {
  constexpr double kMinInlierShare = 0.9;
  constexpr double kAxesAcross = 2;  // sigma is that of each
  double sum = 0, num_inliers = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double sigma = samples[i].sigma;
    const double ratio = squared_distances[i] / (sigma * sigma);
    if (ratio > kOutlierSigmas * kOutlierSigmas) continue;
    sum += ratio;
    ++num_inliers;
  }
  return sum <= kAxesAcross * num_inliers &&
         num_inliers >= kMinInlierShare * static_cast<double>(samples.size());
}

std::vector<double> UnwrappedAngles(const Conic& conic, FitSpan samples) {
  std::vector<double> angles;
  angles.reserve(samples.size());
  for (const FitSample& s : samples) {
    const double t = NearestParameter(conic, s.position);
    const double last = angles.empty() ? t : angles.back();
    angles.push_back(last + std::remainder(t - last, 2 * kPi));
  }
  return angles;
}

Conic Directed(const Conic& conic, FitSpan samples) {
  const std::vector<double> angles = UnwrappedAngles(conic, samples);
  Conic directed = conic;
  if (angles.back() < angles.front()) directed.frame.rightCols<2>() *= -1;
  return directed;
}

bool GoesRound(const Conic& conic, FitSpan samples) {
  const std::vector<double> angles = UnwrappedAngles(conic, samples);
  const double sweep = std::abs(angles.back() - angles.front());
  const double step = sweep / static_cast<double>(samples.size() - 1);
  return sweep > 2 * kPi - std::max(4 * step, 0.1);
}

void SetConic(const Conic& conic, CurveFit& fit) {
  fit.center = conic.center;
  fit.major = conic.a * conic.frame.col(0);
  fit.minor = conic.b * conic.frame.col(1);
  fit.start_angle = NearestParameter(conic, fit.start);
  fit.end_angle = fit.start_angle + 2 * kPi;
  if (fit.closed) return;
  fit.end_angle = NearestParameter(conic, fit.end);
  while (fit.end_angle <= fit.start_angle) fit.end_angle += 2 * kPi;
}

std::string_view KindName(const CurveFit& fit) {
  switch (fit.kind) {
    case FitKind::kLine:
      return "line";
    case FitKind::kArc:
      return fit.closed ? "circle" : "arc";
    case FitKind::kEllipse:
      return "ellipse";
    case FitKind::kSpline:
      return "spline";
  }
  return "";
}

Eigen::Vector3d PointAt(const CurveFit& fit, double t) {
  switch (fit.kind) {
    case FitKind::kLine:
      return fit.start + t * (fit.end - fit.start);
    case FitKind::kArc:
    case FitKind::kEllipse: {
      const double angle =
          fit.start_angle + t * (fit.end_angle - fit.start_angle);
      return fit.center + std::cos(angle) * fit.major +
             std::sin(angle) * fit.minor;
    }
    case FitKind::kSpline:
      return SplineAt(fit.control_points, fit.knots, t);
  }
  return fit.start;
}

double Length(const CurveFit& fit) {
  if (fit.kind == FitKind::kLine) return (fit.end - fit.start).norm();
  if (fit.kind == FitKind::kArc) {
    return fit.major.norm() * (fit.end_angle - fit.start_angle);
  }
  constexpr int kNumChords = 1000;
  double length = 0;
  Eigen::Vector3d last = PointAt(fit, 0);
  for (int i = 1; i <= kNumChords; ++i) {
    const Eigen::Vector3d next =
        PointAt(fit, static_cast<double>(i) / kNumChords);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

std::optional<FittedLine> FitLine(FitSpan samples) {
  if (samples.size() < 2) return std::nullopt;
  std::vector<double> weights = EqualWeights(samples);
  std::optional<FittedLine> line = WeightedLine(samples, weights);
  for (int round = 0; line && round < kNumRounds; ++round) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      weights[i] = RobustWeight(
          SquaredDistance(*line, samples[i].position), samples[i].sigma, round);
    }
    line = WeightedLine(samples, weights);
  }
  return line;
}

}  // namespace curvix
