// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "fitting/structure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "geometry/directions.h"

namespace curvix {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

using Indices = std::vector<std::size_t>;

LineOrArc FromLine(const FitIndex& index, const CurveFit& fit) {
  LineOrArc line;
  line.index = index;
  line.fit = &fit;
  const Vector3d chord = fit.end - fit.start;
  line.size = chord.norm();
  line.along = chord / line.size;
  line.point = (fit.start + fit.end) / 2;
  const Matrix3d sum = fit.start_covariance + fit.end_covariance;
  const Matrix3d across =
      Matrix3d::Identity() - line.along * line.along.transpose();
  line.along_covariance = across * sum * across / chord.squaredNorm();
  line.point_covariance = sum / 4;
  return line;
}

LineOrArc FromArc(const FitIndex& index, const CurveFit& fit) {
  LineOrArc arc;
  arc.index = index;
  arc.fit = &fit;
  arc.size = fit.major.norm();
  arc.along = NormalOf(fit);
  arc.along_covariance = fit.arc_covariance.block<3, 3>(3, 3);
  arc.point = fit.center;
  arc.point_covariance = fit.arc_covariance.topLeftCorner<3, 3>();
  return arc;
}

// Ascending; without lines of no length and arcs whose covariance is not
// finite.
std::vector<LineOrArc> LinesAndArcs(const FittedCurves& fitted) {
  std::vector<LineOrArc> features;
  for (std::size_t c = 0; c < fitted.curves.size(); ++c) {
    const std::vector<CurveFit>& fits = fitted.curves[c].fits;
    for (std::size_t f = 0; f < fits.size(); ++f) {
      const CurveFit& fit = fits[f];
      if (fit.kind == FitKind::kLine && (fit.end - fit.start).norm() > 0) {
        features.push_back(FromLine({c, f}, fit));
      } else if (fit.kind == FitKind::kArc && fit.arc_covariance.allFinite()) {
        features.push_back(FromArc({c, f}, fit));
      }
    }
  }
  return features;
}

// The diameter of a sphere about the mean of all ends that holds them.
double ExtentOf(const std::vector<LineOrArc>& features) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const LineOrArc& f : features) mean += f.fit->start + f.fit->end;
  mean /= 2 * std::max<double>(1, static_cast<double>(features.size()));
  double furthest = 0;
  for (const LineOrArc& f : features) {
    furthest = std::max(
        {furthest, (f.fit->start - mean).norm(), (f.fit->end - mean).norm()});
  }
  return 2 * furthest;
}

// The given ones of the features, the surest first.
template <typename SigmaOf>
Indices BySigma(Indices order, const SigmaOf& sigma_of) {
  std::ranges::stable_sort(order, {}, sigma_of);
  return order;
}

FitGroup GroupOf(GroupKind kind,
                 const ValueGroup& agreement,
                 const std::vector<LineOrArc>& features) {
  FitGroup group;
  group.kind = kind;
  for (const std::size_t i : agreement.members) {
    group.fits.push_back(features[i].index);
  }
  group.chi_squared = agreement.chi_squared;
  group.degrees_of_freedom = agreement.degrees_of_freedom;
  group.sigma = kind == GroupKind::kEqualRadius
                    ? std::sqrt(agreement.covariance(0, 0))
                    : std::sqrt(agreement.covariance.trace() / 2);
  return group;
}

// A direction that features share, or one has.
struct Direction {
  ValueGroup agreement;
  Vector3d along;
  Matrix3d covariance;
};

std::vector<Direction> FindDirections(const std::vector<LineOrArc>& features) {
  Indices known;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features[i].along_sigma() <= kNearAngle) known.push_back(i);
  }
  const Indices order =
      BySigma(known, [&](std::size_t i) { return features[i].along_sigma(); });
  const auto relative = [&](std::size_t i, std::size_t seed) {
    UncertainValue v;
    v.bound = kNearAngle;
    v.space = 2 * kPi;
    const Vector3d& axis = features[seed].along;
    const double along = features[i].along.dot(axis);
    v.value = Eigen::Vector2d::Constant(2);  // far
    if (std::abs(along) < 0.5) return v;
    const AcrossAxes across = AxesAcross(axis);
    v.value = across.transpose() * features[i].along / along;
    v.covariance = across.transpose() * features[i].along_covariance * across;
    return v;
  };
  std::vector<Direction> directions;
  for (const ValueGroup& a : FindAgreements(order, 2, relative)) {
    const AcrossAxes across = AxesAcross(features[a.seed].along);
    Vector3d along = (features[a.seed].along + across * a.mean).normalized();
    directions.push_back(
        {a, Upright(along), across * a.covariance * across.transpose()});
  }
  return directions;
}

double NumFits(const Direction& direction) {
  return static_cast<double>(direction.agreement.members.size());
}

// Tests count as much as there are pairs of fits.
std::vector<PerpendicularGroups> FindPerpendicular(
    const std::vector<Direction>& directions) {
  std::vector<PerpendicularGroups> found, kept;
  std::vector<Test> tests;
  Test failed = {1, 0};         // together, of pairs that are many
  std::vector<double> chances;  // of those found
  for (std::size_t a = 0; a < directions.size(); ++a) {
    for (std::size_t b = a + 1; b < directions.size(); ++b) {
      const Vector3d& first = directions[a].along;
      const Vector3d& second = directions[b].along;
      const double cosine = std::abs(first.dot(second));
      const double variance = first.dot(directions[b].covariance * first) +
                              second.dot(directions[a].covariance * second);
      const double squared = cosine * cosine / variance;
      const double weight = NumFits(directions[a]) * NumFits(directions[b]);
      if (cosine > kNearAngle || squared > ChiSquaredLimit(1)) {
        failed.weight += weight;
        continue;
      }
      // The share of directions that are so near to a plane.
      tests.push_back({cosine, weight});
      chances.push_back(cosine);
      found.push_back({a, b, squared});
    }
  }
  tests.push_back(failed);
  const double limit = LargestChance(std::move(tests));
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (chances[k] <= limit) kept.push_back(found[k]);
  }
  return kept;
}

// Those of parallel features that lie on one line, or around one axis.
void AddAxes(const Direction& direction,
             const Indices& members,
             GroupKind kind,
             double extent,
             const std::vector<LineOrArc>& features,
             std::vector<FitGroup>& groups) {
  const AcrossAxes across = AxesAcross(direction.along);
  const auto covariance_of = [&](std::size_t i) -> Matrix2d {
    return across.transpose() * features[i].point_covariance * across;
  };
  const Indices order =
      BySigma(members, [&](std::size_t i) { return covariance_of(i).trace(); });
  const auto relative = [&](std::size_t i, std::size_t seed) {
    const Vector3d off = features[i].point - features[seed].point;
    const double along = direction.along.dot(off);
    const Matrix2d turn = across.transpose() * direction.covariance * across;
    return UncertainValue{across.transpose() * off,
                          covariance_of(i) + along * along * turn,
                          kNear * features[i].size,
                          extent * extent};
  };
  for (const ValueGroup& a : FindAgreements(order, 2, relative)) {
    if (a.members.size() < 2) continue;
    FitGroup group = GroupOf(kind, a, features);
    group.direction = direction.along;
    group.point = features[a.seed].point + across * a.mean;
    groups.push_back(group);
  }
}

void AddRadii(const Indices& arcs,
              double extent,
              const std::vector<LineOrArc>& features,
              std::vector<FitGroup>& groups) {
  const auto sigma_of = [&](std::size_t i) {
    return features[i].fit->radius_sigma;
  };
  const auto relative = [&](std::size_t i, std::size_t seed) {
    UncertainValue v;
    v.value.x() = features[i].size - features[seed].size;
    v.covariance(0, 0) = sigma_of(i) * sigma_of(i);
    v.bound = kNear * features[i].size;
    v.space = extent;
    return v;
  };
  for (const ValueGroup& a :
       FindAgreements(BySigma(arcs, sigma_of), 1, relative)) {
    if (a.members.size() < 2) continue;
    FitGroup group = GroupOf(GroupKind::kEqualRadius, a, features);
    group.radius = features[a.seed].size + a.mean.x();
    groups.push_back(group);
  }
}

// Groups of parallel fits, and single directions that others are perpendicular
// to.
void AddDirections(const std::vector<Direction>& directions,
                   const std::vector<LineOrArc>& features,
                   FitStructure& structure) {
  structure.perpendicular = FindPerpendicular(directions);
  std::vector<bool> used(directions.size());
  for (std::size_t d = 0; d < directions.size(); ++d) {
    used[d] = directions[d].agreement.members.size() > 1;
  }
  for (const PerpendicularGroups& p : structure.perpendicular) {
    used[p.first] = used[p.second] = true;
  }
  std::vector<std::size_t> group_of(directions.size());
  for (std::size_t d = 0; d < directions.size(); ++d) {
    if (!used[d]) continue;
    group_of[d] = structure.groups.size();
    structure.groups.push_back(
        GroupOf(GroupKind::kParallel, directions[d].agreement, features));
    structure.groups.back().direction = directions[d].along;
  }
  for (PerpendicularGroups& p : structure.perpendicular) {
    p.first = group_of[p.first];
    p.second = group_of[p.second];
  }
}

}  // namespace

std::string_view KindName(GroupKind kind) {
  constexpr std::array<std::string_view, 5> kNames = {
      "parallel", "collinear", "concentric", "equal_radius", "coplanar"};
  return kNames[static_cast<std::size_t>(kind)];
}

FitStructure FindStructure(const FittedCurves& fitted) {
  const std::vector<LineOrArc> features = LinesAndArcs(fitted);
  const double extent = ExtentOf(features);
  FitStructure structure;
  const std::vector<Direction> directions = FindDirections(features);
  AddDirections(directions, features, structure);
  for (const GroupKind kind : {GroupKind::kCollinear, GroupKind::kConcentric}) {
    for (const Direction& direction : directions) {
      Indices members;
      for (const std::size_t i : direction.agreement.members) {
        const bool is_arc = kind == GroupKind::kConcentric;
        if (features[i].is_arc() == is_arc) members.push_back(i);
      }
      AddAxes(direction, members, kind, extent, features, structure.groups);
    }
  }
  Indices arcs;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features[i].is_arc()) arcs.push_back(i);
  }
  AddRadii(arcs, extent, features, structure.groups);
  AddPlanes(features, fitted, extent, structure.groups);
  return structure;
}

}  // namespace curvix
