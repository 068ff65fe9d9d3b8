// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "fitting/structure.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/directions.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Indices = std::vector<std::size_t>;

constexpr double kMaxAccidentalPlanes = 0.01;
constexpr double kMinSine = 0.3;  // between two lines that span a plane
// Of the information about a plane, in its standard deviations: that of points
// on a line to a millionth of their extent.
constexpr double kLeastPivot = 1e-12;

// w = offset + slopes (u, v), of (u, v, w) in the frame, whose z is the normal.
struct Plane {
  Vector3d point = Vector3d::Zero();
  Matrix3d frame = Matrix3d::Identity();
  Matrix3d covariance = Matrix3d::Zero();  // of offset and slopes
  double chi_squared = 0;
  int num_observations = 0;
};

// What an end, a centre or a normal says about a plane: row * (offset, slopes)
// = value.
struct PlaneObservation {
  Vector3d row;
  double value = 0;
  double variance = 0;
  double bound = 0;
  double chance_scale = 1;  // what values of unrelated fits spread over
};

// Of the information about offset and slopes, each in its standard deviation
// without the others, so that the unit of length plays no part. nullopt: it
// has none.
std::optional<Matrix3d> InverseOf(const Matrix3d& information) {
  const Vector3d sigmas = information.diagonal().cwiseSqrt().cwiseInverse();
  if (!sigmas.allFinite()) return std::nullopt;
  Eigen::FullPivLU<Matrix3d> lu(sigmas.asDiagonal() * information *
                                sigmas.asDiagonal());
  lu.setThreshold(kLeastPivot);
  if (!lu.isInvertible()) return std::nullopt;
  return sigmas.asDiagonal() * lu.inverse() * sigmas.asDiagonal();
}

bool AreAmong(const Indices& many, const Indices& few) {
  return std::ranges::all_of(few, [&](std::size_t i) {
    return std::ranges::find(many, i) != many.end();
  });
}

class PlaneFinder {
 public:
  PlaneFinder(const std::vector<LineOrArc>& features,
              const FittedCurves& fitted,
              double extent)
      : features_(features), fitted_(fitted), extent_(extent) {}

  void AddTo(std::vector<FitGroup>& groups) {
    const std::vector<Indices> seeds = Seeds();
    std::vector<Indices> planes_of(features_.size());  // indices into groups
    for (const Indices& seed : seeds) {
      const Indices& first = planes_of[seed.front()];
      const Indices& last = planes_of[seed.back()];
      if (std::ranges::find_first_of(first, last) != first.end()) continue;
      Indices members = seed;
      const std::optional<Plane> plane = Grown(members);
      // Without its seed, it is a plane that another seed finds.
      if (!plane || !AreAmong(members, seed) ||
          !IsSignificant(*plane, members, seeds.size())) {
        continue;
      }
      for (const std::size_t i : members) planes_of[i].push_back(groups.size());
      groups.push_back(GroupOf(*plane, members));
    }
  }

 private:
  // Arcs, and pairs of lines that meet; the largest first.
  std::vector<Indices> Seeds() const {
    std::map<FitIndex, std::size_t> feature_of;
    std::vector<std::pair<double, Indices>> seeds;
    for (std::size_t i = 0; i < features_.size(); ++i) {
      const LineOrArc& f = features_[i];
      feature_of[f.index] = i;
      if (f.is_arc()) seeds.push_back({f.size * Length(*f.fit), {i}});
    }
    for (const CurveNode& node : fitted_.nodes) {
      Indices lines;
      for (const CurveNode::End& end : node.ends) {
        const auto found = feature_of.find({end.curve_idx, end.fit_idx});
        if (found != feature_of.end() && !features_[found->second].is_arc()) {
          lines.push_back(found->second);
        }
      }
      for (std::size_t a = 0; a < lines.size(); ++a) {
        for (std::size_t b = a + 1; b < lines.size(); ++b) {
          const LineOrArc& first = features_[lines[a]];
          const LineOrArc& second = features_[lines[b]];
          const double sine = first.along.cross(second.along).norm();
          if (sine < kMinSine) continue;
          seeds.push_back(
              {sine * first.size * second.size, {lines[a], lines[b]}});
        }
      }
    }
    std::ranges::stable_sort(
        seeds, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Indices> sorted;
    for (auto& [size, seed] : seeds) sorted.push_back(std::move(seed));
    return sorted;
  }

  PlaneObservation PointOn(const Plane& plane,
                           const Vector3d& point,
                           const Matrix3d& covariance,
                           double size) const {
    const Vector3d local = plane.frame.transpose() * (point - plane.point);
    const Vector3d normal = plane.frame.col(2);
    return {{1, local.x(), local.y()},
            local.z(),
            normal.dot(covariance * normal),
            kNear * size,
            extent_};
  }

  // Of one fit; ends in nodes that are in `known` are left out, and the others
  // put there.
  std::vector<PlaneObservation> Of(const Plane& plane,
                                   const LineOrArc& feature,
                                   std::set<int>* known) const {
    std::vector<PlaneObservation> observations;
    if (feature.is_arc()) {
      observations.push_back(PointOn(
          plane, feature.point, feature.point_covariance, feature.size));
      Vector3d normal = plane.frame.transpose() * feature.along;
      if (normal.z() < 0) normal = -normal;
      const Matrix3d covariance =
          plane.frame.transpose() * feature.along_covariance * plane.frame;
      for (const int k : {0, 1}) {
        observations.push_back({Vector3d::Unit(k + 1),
                                -normal(k) / std::max(normal.z(), 1e-3),
                                covariance(k, k),
                                kNearAngle,
                                1});
      }
      return observations;
    }
    const CurveFit& fit = *feature.fit;
    for (const bool at_end : {false, true}) {
      const int node = at_end ? fit.end_node : fit.start_node;
      if (known != nullptr && node >= 0 && !known->insert(node).second) {
        continue;
      }
      observations.push_back(
          PointOn(plane,
                  at_end ? fit.end : fit.start,
                  at_end ? fit.end_covariance : fit.start_covariance,
                  feature.size));
    }
    return observations;
  }

  std::vector<PlaneObservation> OfAll(const Plane& plane,
                                      const Indices& members) const {
    std::vector<PlaneObservation> all;
    std::set<int> known;
    for (const std::size_t i : members) {
      const auto own = Of(plane, features_[i], &known);
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }

  // The plane through the seed.
  Plane Through(const Indices& seed) const {
    Plane plane;
    const LineOrArc& first = features_[seed.front()];
    const LineOrArc& last = features_[seed.back()];
    plane.point = first.point;
    const Vector3d normal = first.is_arc()
                                ? first.along
                                : first.along.cross(last.along).normalized();
    plane.frame << AxesAcross(normal), normal;
    return plane;
  }

  // Least squares over the members, about their mean. nullopt: they span none.
  std::optional<Plane> Fitted(Plane plane, const Indices& members) const {
    Vector3d mean = Vector3d::Zero();
    for (const std::size_t i : members) mean += features_[i].point;
    mean /= static_cast<double>(members.size());
    const Vector3d normal = plane.frame.col(2);
    plane.point = mean - normal.dot(mean - plane.point) * normal;
    Matrix3d information = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    double squares = 0;
    const std::vector<PlaneObservation> all = OfAll(plane, members);
    for (const PlaneObservation& o : all) {
      information += o.row * o.row.transpose() / o.variance;
      right += o.row * o.value / o.variance;
      squares += o.value * o.value / o.variance;
    }
    plane.num_observations = static_cast<int>(all.size());
    if (plane.num_observations < 3) return std::nullopt;
    const std::optional<Matrix3d> covariance = InverseOf(information);
    if (!covariance) return std::nullopt;
    plane.covariance = *covariance;
    const Vector3d solution = plane.covariance * right;
    plane.chi_squared = std::max(0.0, squares - solution.dot(right));
    plane.point += solution.x() * normal;
    const Vector3d turned =
        (plane.frame * Vector3d(-solution.y(), -solution.z(), 1)).normalized();
    plane.frame =
        ShortestRotation(normal, turned).toRotationMatrix() * plane.frame;
    return plane;
  }

  bool IsIn(const Plane& plane, const LineOrArc& feature) const {
    // Most are far off: this is the bound of the first observation.
    const Vector3d& first =
        feature.is_arc() ? feature.point : feature.fit->start;
    const double off = plane.frame.col(2).dot(first - plane.point);
    if (std::abs(off) > (1 + 1e-9) * kNear * feature.size) return false;
    const double limit = ChiSquaredLimit(1);
    for (const PlaneObservation& o : Of(plane, feature, nullptr)) {
      const double variance = o.variance + o.row.dot(plane.covariance * o.row);
      if (!(std::abs(o.value) <= o.bound) ||
          o.value * o.value > limit * variance) {
        return false;
      }
    }
    return true;
  }

  // The furthest off of the members, by its worst observation.
  std::size_t Worst(const Plane& plane, const Indices& members) const {
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (const PlaneObservation& o :
           Of(plane, features_[members[k]], nullptr)) {
        const double squared = o.value * o.value / o.variance;
        if (squared > most) worst = k;
        most = std::max(most, squared);
      }
    }
    return worst;
  }

  // The plane with all fits that are in it.
  std::optional<Plane> Grown(Indices& members) const {
    constexpr int kNumRounds = 3;
    std::optional<Plane> plane = Fitted(Through(members), members);
    for (int round = 0; plane && round < kNumRounds; ++round) {
      members.clear();
      for (std::size_t i = 0; i < features_.size(); ++i) {
        if (IsIn(*plane, features_[i])) members.push_back(i);
      }
      if (members.empty()) return std::nullopt;
      plane = Fitted(*plane, members);
    }
    while (plane && plane->num_observations > 3 &&
           plane->chi_squared > ChiSquaredLimit(plane->num_observations - 3)) {
      members.erase(members.begin() +
                    static_cast<std::ptrdiff_t>(Worst(*plane, members)));
      if (members.empty()) return std::nullopt;
      plane = Fitted(*plane, members);
    }
    return plane;
  }

  bool IsSignificant(const Plane& plane,
                     const Indices& members,
                     std::size_t num_candidates) const {
    std::vector<double> chances;
    const double limit = ChiSquaredLimit(1);
    for (const PlaneObservation& o : OfAll(plane, members)) {
      chances.push_back(2 * std::min(std::sqrt(limit * o.variance), o.bound) /
                        o.chance_scale);
    }
    std::ranges::sort(chances);
    const double n = static_cast<double>(chances.size());
    double accidents = static_cast<double>(num_candidates);
    for (std::size_t k = 3; k < chances.size(); ++k) {
      accidents *= std::min(1.0, n * chances[k]);
    }
    return chances.size() > 3 && accidents < kMaxAccidentalPlanes;
  }

  FitGroup GroupOf(const Plane& plane, const Indices& members) const {
    FitGroup group;
    group.kind = GroupKind::kCoplanar;
    for (const std::size_t i : members)
      group.fits.push_back(features_[i].index);
    group.direction = Upright(plane.frame.col(2));
    group.point = plane.point;
    group.sigma = std::sqrt(plane.covariance(0, 0));
    group.chi_squared = plane.chi_squared;
    group.degrees_of_freedom = plane.num_observations - 3;
    return group;
  }

  const std::vector<LineOrArc>& features_;
  const FittedCurves& fitted_;
  double extent_;
};

}  // namespace

void AddPlanes(const std::vector<LineOrArc>& features,
               const FittedCurves& fitted,
               double extent,
               std::vector<FitGroup>& groups) {
  PlaneFinder(features, fitted, extent).AddTo(groups);
}

}  // namespace curvix
