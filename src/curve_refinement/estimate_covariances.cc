// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How far samples of curves may be off.
#include "curve_refinement/refine_curves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "curve_refinement/curve_ends.h"
#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr double kMinBandwidthPx = 1;
// The chord between two rays, of unit length, at which the errors of their
// views correlate by a half: 6 degrees.
constexpr double kHalfCorrelated = 0.1;
constexpr double kNumParameters = 2;  // a place across a curve
// Degrees of freedom's worth of belief in what is usual in the scene.
constexpr double kPriorFreedom = 4;
constexpr double kMinSlope = 0.1;
// Determinant of the information, over its squared trace: views whose rays are
// nearer to each other than some ten-thousandths do not determine a place.
constexpr double kMinInformation = 1e-8;
// Views that see a smaller share of what an end is carried on from tell nothing
// of it.
constexpr double kMinShare = 0.5;

// How far 2D edges of one view are from a curve; sums while they are added up.
struct MeanDistance {
  std::size_t view = 0;  // its place among those that see the curve
  double weight = 0;
  double distance_px = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // of the distance
};

// The score of Cauchy's loss, which grows like the distance as long as that is
// small, and its derivative.
double Score(double distance_px, double sigma_px) {
  const double r = distance_px / sigma_px;
  return distance_px / (1 + r * r);
}
double ScoreSlope(double distance_px, double sigma_px) {
  const double r = distance_px / sigma_px;
  return (1 - r * r) / ((1 + r * r) * (1 + r * r));
}

// How far the views' mean distances scatter, robustly; sums over views, of
// which those that see only a part of the segment count as less.
struct Scatter {
  double scores2_px2 = 0;
  double slopes = 0;
  double num_views = 0;
  double freedom = 0;

  // `sigma_px`: of a 2D edge, for Cauchy's loss.
  void Add(double share, double distance_px, double sigma_px) {
    const double score = Score(distance_px, sigma_px);
    scores2_px2 += share * score * score;
    slopes += share * ScoreSlope(distance_px, sigma_px);
    num_views += share;
  }
  void Add(double share, const Scatter& other) {
    scores2_px2 += share * other.scores2_px2;
    slopes += share * other.slopes;
    num_views += share * other.num_views;
    freedom += share * other.freedom;
  }
  // Of an M-estimate, after Huber.
  double VariancePx2() const {
    const double slope = std::max(kMinSlope, slopes / num_views);
    return scores2_px2 / (freedom * slope * slope);
  }
};

// What edges of sharp images are off by, if no curve tells.
constexpr Scatter kSharpImages = {0.05 * 0.05, 1, 1, 1};

// How the views agree about a sample.
struct Agreement {
  Scatter scatter;
  // The covariance for mean distances of variance 1.
  std::optional<Eigen::Matrix3d> unit_covariance;
};

class CurveInViews {
 public:
  CurveInViews(const Curve& curve,
               const RefinementInput& input,
               const ResponseCurve& response)
      : curve_(curve), edge_sigma_px_(input.edge_sigma_px) {
    std::map<std::int32_t, std::size_t> places;
    for (std::size_t k = 0; k < curve.samples.size(); ++k) {
      const CurveSample& sample = curve.samples[k];
      const double pixel = pixels_.emplace_back(PixelSize(sample, input.views));
      const std::vector<PlaneMeasurement> measured =
          MeasureUnblurred(curve, k, pixel, input, response);
      std::vector<MeanDistance>& distances = distances_.emplace_back();
      for (std::size_t i = 0; i < measured.size(); ++i) {
        const auto [place, is_new] =
            places.try_emplace(sample.support[i].view_idx, centers_.size());
        if (is_new) centers_.push_back(measured[i].center);
        const SeenDistance distance =
            DistanceFrom(measured[i], sample.position);
        distances.push_back({place->second, 1, distance.px, distance.gradient});
      }
    }
  }

  // Around sample `i`, weighted by a Gaussian along the curve.
  Agreement About(std::size_t i, double bandwidth_px) const {
    const double bandwidth = bandwidth_px * pixels_[i];
    std::vector<Weighted> weighted;
    for (const SampleAround& near :
         SamplesAround(curve_, i, kKernelReach * bandwidth)) {
      const double r = near.along / bandwidth;
      weighted.push_back({near.index, std::exp(-0.5 * r * r)});
    }
    return Summary(curve_.samples[i], weighted, 0);
  }

  // About sample `i` of an end that was carried on along what fits the samples
  // `from`, first that next to it: their distances carried on alike. nullopt
  // without a fit.
  std::optional<Agreement> Beyond(std::size_t i,
                                  const std::vector<SampleAround>& from,
                                  bool is_arc) const {
    const Eigen::Index num_powers = is_arc ? 3 : 2;
    const double unit = from.back().along;
    const auto powers_of = [&](double along) -> Eigen::VectorXd {
      const double t = along / unit;
      return Eigen::Vector3d(1, t, t * t).head(num_powers);
    };
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(num_powers, num_powers);
    for (const SampleAround& sample : from) {
      const Eigen::VectorXd powers = powers_of(sample.along);
      normal += powers * powers.transpose();
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> solver(normal);
    if (!solver.isInvertible()) return std::nullopt;
    // At sample `i`, which is at 0.
    const Eigen::VectorXd to_weight = solver.solve(powers_of(0));
    std::vector<Weighted> weighted;
    for (const SampleAround& sample : from) {
      weighted.push_back(
          {sample.index, to_weight.dot(powers_of(sample.along))});
    }
    return Summary(curve_.samples[i], weighted, kMinShare);
  }

 private:
  // A sample and its weight, which is negative for some where a curve is
  // carried on.
  struct Weighted {
    std::size_t index = 0;
    double weight = 0;
  };

  // Of the views with more than `min_share` of the weight.
  Agreement Summary(const CurveSample& sample,
                    const std::vector<Weighted>& weighted,
                    double min_share) const {
    std::vector<MeanDistance> sums(centers_.size());
    double total_weight = 0;
    for (const auto& [index, weight] : weighted) {
      total_weight += weight;
      for (const MeanDistance& d : distances_[index]) {
        MeanDistance& sum = sums[d.view];
        sum.view = d.view;
        sum.weight += weight;
        sum.distance_px += weight * d.distance_px;
        sum.gradient += weight * d.gradient;
      }
    }
    std::erase_if(sums, [&](const MeanDistance& d) {
      return d.weight <= min_share * total_weight;
    });
    const AcrossAxes axes = AxesAcross(sample.tangent);
    Agreement result;
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    std::vector<Eigen::Vector2d> pulls;
    std::vector<Eigen::Vector3d> rays;
    for (const MeanDistance& sum : sums) {
      const double share = std::min(1.0, sum.weight / total_weight);
      const Eigen::Vector2d gradient =
          axes.transpose() * sum.gradient / sum.weight;
      result.scatter.Add(share, sum.distance_px / sum.weight, edge_sigma_px_);
      information += share * gradient * gradient.transpose();
      pulls.push_back(share * gradient);
      rays.push_back((centers_[sum.view] - sample.position).normalized());
    }
    result.scatter.freedom =
        std::max(0.0, result.scatter.num_views - kNumParameters);
    const double trace = information.trace();
    if (!(information.determinant() > kMinInformation * trace * trace)) {
      return result;
    }
    const Eigen::Matrix<double, 3, 2> spread = axes * information.inverse();
    result.unit_covariance =
        spread * SumOfCorrelated(pulls, rays) * spread.transpose();
    return result;
  }

  static Eigen::Matrix2d SumOfCorrelated(
      const std::vector<Eigen::Vector2d>& pulls,
      const std::vector<Eigen::Vector3d>& rays) {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (std::size_t v = 0; v < pulls.size(); ++v) {
      Eigen::Vector2d correlated = Eigen::Vector2d::Zero();
      for (std::size_t w = 0; w < pulls.size(); ++w) {
        const double chord2 = (rays[v] - rays[w]).squaredNorm();
        correlated +=
            pulls[w] / (1 + chord2 / (kHalfCorrelated * kHalfCorrelated));
      }
      sum += pulls[v] * correlated.transpose();
    }
    return sum;
  }

  const Curve& curve_;
  double edge_sigma_px_;
  std::vector<double> pixels_;            // at each sample, world units
  std::vector<Eigen::Vector3d> centers_;  // of the views that see it
  std::vector<std::vector<MeanDistance>> distances_;  // of each sample
};

double StepBetween(const Curve& curve, std::size_t a, std::size_t b) {
  return (curve.samples[a].position - curve.samples[b].position).norm();
}

// Sets the agreement about the samples that an end was carried on by, which no
// edge supports.
void ExtrapolateTo(bool at_head,
                   const Curve& curve,
                   const RefinementInput& input,
                   const CurveInViews& in_views,
                   std::vector<Agreement>& agreements) {
  const std::size_t size = curve.samples.size();
  const auto index = [&](std::size_t k) { return at_head ? size - 1 - k : k; };
  std::size_t num_carried = 0;
  while (num_carried < size &&
         curve.samples[index(num_carried)].support.empty()) {
    ++num_carried;
  }
  if (num_carried == 0 || num_carried == size) return;
  Curve supported = curve;
  CutEnd(supported, at_head, [](const CurveSample& sample) {
    return !sample.support.empty();
  });
  const EndFit fit = FitNearEnd(supported, at_head, 0, kRoundedPx, input.views);
  if (!(fit.length > 0)) return;
  std::vector<SampleAround> from;
  double along = 0;
  for (std::size_t k = num_carried; k < size; ++k) {
    if (k > num_carried) along += StepBetween(curve, index(k - 1), index(k));
    if (along > fit.length * (1 + 1e-9)) break;
    from.push_back({index(k), along});
  }
  for (std::size_t k = num_carried; k-- > 0;) {
    const double step = StepBetween(curve, index(k), index(k + 1));
    for (SampleAround& sample : from) sample.along += step;
    if (auto agreement = in_views.Beyond(index(k), from, !fit.bend.isZero())) {
      agreements[index(k)] = *std::move(agreement);
    }
  }
}

std::vector<Agreement> MeasureAgreement(const Curve& curve,
                                        const RefinementInput& input,
                                        const ResponseCurve& response) {
  const CurveInViews in_views(curve, input, response);
  const double bandwidth_px =
      std::max(kMinBandwidthPx, input.options.smoothing_px);
  std::vector<Agreement> agreements;
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    agreements.push_back(in_views.About(k, bandwidth_px));
  }
  if (!curve.closed) {
    for (const bool at_head : {true, false}) {
      ExtrapolateTo(at_head, curve, input, in_views, agreements);
    }
  }
  return agreements;
}

// Of all curves together, for one degree of freedom.
Scatter UsualScatter(const std::vector<Curve>& curves,
                     const std::vector<std::vector<Agreement>>& agreements) {
  Scatter sum;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    // They are elsewhere in every view.
    if (MainKind(curves[i]) == CurveKind::kOccludingContour) continue;
    for (std::size_t k = 0; k < agreements[i].size(); ++k) {
      // What ends were carried on by scatters more.
      const Scatter& scatter = agreements[i][k].scatter;
      if (curves[i].samples[k].support.empty() || !(scatter.freedom > 0)) {
        continue;
      }
      sum.Add(1, scatter);
    }
  }
  if (!(sum.freedom > 0)) return kSharpImages;
  Scatter usual;
  usual.Add(1 / sum.freedom, sum);
  return usual;
}

}  // namespace

std::vector<Curve> EstimateCovariances(std::vector<Curve> curves,
                                       const RefinementInput& input,
                                       const ResponseCurve& response) {
  std::vector<std::vector<Agreement>> agreements(curves.size());
  ForEachCurve(curves.size(), input, [&](std::size_t i) {
    agreements[i] = MeasureAgreement(curves[i], input, response);
  });
  const Scatter usual = UsualScatter(curves, agreements);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (std::size_t k = 0; k < agreements[i].size(); ++k) {
      const Agreement& agreement = agreements[i][k];
      if (!agreement.unit_covariance) continue;
      Scatter scatter = agreement.scatter;
      scatter.Add(kPriorFreedom, usual);
      CurveSample& sample = curves[i].samples[k];
      sample.covariance = scatter.VariancePx2() * *agreement.unit_covariance;
      sample.sigma = std::sqrt(sample.covariance.trace() / 2);
    }
  }
  return curves;
}

}  // namespace curvix
