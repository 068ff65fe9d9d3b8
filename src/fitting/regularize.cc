// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "fitting/structure.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/infinity.h"
#include "fitting/end_covariance.h"
#include "fitting/primitive.h"
#include "fitting/regularize_costs.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Weights of relations are kHard / sigma, against 1 / sigma of the
// observations: relations are met to a millionth of what a fit moves.
constexpr double kHard = 1e3;
constexpr double kMaxAdjustmentSigmas = 3;
// In the first rounds, only fits that move at least this share of the farthest
// move leave their groups.
constexpr int kMaxCarefulRounds = 8;
constexpr double kShareOfWorst = 0.5;

// The inverse of the root of a covariance, for weights; 0 if it has none.
Eigen::MatrixXd Whitening(Eigen::MatrixXd covariance) {
  const Eigen::Index size = covariance.rows();
  covariance.diagonal().array() *= 1 + 1e-9;
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  if (llt.info() != Eigen::Success) return Eigen::MatrixXd::Zero(size, size);
  return llt.matrixL().solve(Eigen::MatrixXd::Identity(size, size));
}

// Where primitives go on smoothly, their node is hardly known along them. It is
// not to slide far: at most so many times as far as it may move across.
Matrix3d WithoutSliding(const Matrix3d& covariance) {
  constexpr double kMaxRatio = 10;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(covariance);
  const Vector3d capped = eigen.eigenvalues().cwiseMin(kMaxRatio * kMaxRatio *
                                                       eigen.eigenvalues()(0));
  return eigen.eigenvectors() * capped.asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <typename Cost, int kResiduals, int... kSizes>
ceres::CostFunction* Auto(Cost cost) {
  return new ceres::AutoDiffCostFunction<Cost, kResiduals, kSizes...>(
      new Cost(std::move(cost)));
}

struct Arc {
  Vector6 values;
  Chart normal;
  Matrix6 covariance;
};

Arc ArcOf(const CurveFit& fit) {
  const Chart normal(NormalOf(fit));
  Arc arc{Vector6::Zero(), normal, Matrix6::Zero()};
  arc.values.head<3>() = fit.center;
  arc.values(5) = fit.major.norm();
  Eigen::Matrix<double, 6, 7> local = Eigen::Matrix<double, 6, 7>::Zero();
  local.topLeftCorner<3, 3>().setIdentity();
  local.block<2, 3>(3, 3) = normal.across.transpose();
  local(5, 6) = 1;
  arc.covariance = local * fit.arc_covariance * local.transpose();
  return arc;
}

// What a group shares, as it moves.
struct Shared {
  std::array<double, 2> turn = {0, 0};
  std::array<double, 2> offset = {0, 0};
  double radius = 0;
};

class Adjustment {
 public:
  explicit Adjustment(const FittedCurves& fitted)
      : fitted_(fitted), shared_(fitted.structure.groups.size()) {
    for (const CurveNode& node : fitted.nodes) {
      points_.push_back({node.position, WithoutSliding(node.covariance)});
    }
    for (std::size_t c = 0; c < fitted.curves.size(); ++c) {
      for (std::size_t f = 0; f < fitted.curves[c].fits.size(); ++f) {
        AddFit({c, f}, fitted.curves[c].fits[f]);
      }
    }
    before_ = points_;
    arcs_before_ = arcs_;
    for (std::size_t g = 0; g < shared_.size(); ++g) {
      shared_[g].radius = fitted.structure.groups[g].radius;
    }
  }

  void Solve() {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      Stay(points_[k].covariance, points_[k].position);
    }
    for (auto& [index, arc] : arcs_) {
      Stay(arc.covariance, arc.values);
      const CurveFit& fit = FitOf(index);
      for (const int node : {fit.start_node, fit.end_node}) {
        if (node < 0) continue;
        Add(Auto<NodeOnArcCost, 2, 3, 6>({arc.normal, kHard / fit.sigma}),
            points_[static_cast<std::size_t>(node)].position.data(),
            arc.values.data());
      }
    }
    const FitStructure& structure = fitted_.structure;
    for (std::size_t g = 0; g < structure.groups.size(); ++g) {
      for (const FitIndex& index : structure.groups[g].fits) {
        AddMember(structure.groups[g], index, shared_[g]);
      }
    }
    for (const PerpendicularGroups& p : structure.perpendicular) {
      const FitGroup& first = structure.groups[p.first];
      const FitGroup& second = structure.groups[p.second];
      Add(Auto<PerpendicularCost, 1, 2, 2>(
              {Chart(first.direction),
               Chart(second.direction),
               kHard / std::min(first.sigma, second.sigma)}),
          shared_[p.first].turn.data(),
          shared_[p.second].turn.data());
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.num_threads = 1;
    options.function_tolerance = 1e-12;
    // Relative to coordinates, which are large in a survey.
    options.parameter_tolerance = 0;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
  }

  // How far each fit, or what it ends in, has moved, in standard deviations.
  std::map<FitIndex, double> Moves() const {
    const auto sigmas = [](const auto& covariance, const auto& move) {
      const double norm = (Whitening(covariance) * move).norm();
      return std::isnan(norm) ? kInfinity : norm;
    };
    std::vector<double> of_points;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vector3d move = points_[k].position - before_[k].position;
      of_points.push_back(sigmas(points_[k].covariance, move));
    }
    std::map<FitIndex, double> moves;
    for (const auto& [end, point] : end_points_) {
      double& move = moves[end.first];
      move = std::max(move, of_points[point]);
    }
    for (const auto& [index, arc] : arcs_) {
      const Vector6 move = arc.values - arcs_before_.at(index).values;
      moves[index] = std::max(moves[index], sigmas(arc.covariance, move));
    }
    return moves;
  }

  void WriteTo(FittedCurves& fitted) const {
    for (std::size_t n = 0; n < fitted.nodes.size(); ++n) {
      fitted.nodes[n].position = points_[n].position;
    }
    for (const auto& [end, point] : end_points_) {
      const auto& [index, at_end] = end;
      CurveFit& fit = fitted.curves[index.curve_idx].fits[index.fit_idx];
      (at_end ? fit.end : fit.start) = points_[point].position;
    }
    for (const auto& [index, arc] : arcs_) {
      WriteArc(arc, fitted.curves[index.curve_idx].fits[index.fit_idx]);
    }
    for (std::size_t g = 0; g < shared_.size(); ++g) {
      WriteGroup(shared_[g], fitted.structure.groups[g]);
    }
  }

 private:
  const CurveFit& FitOf(const FitIndex& index) const {
    return fitted_.curves[index.curve_idx].fits[index.fit_idx];
  }

  template <typename... Blocks>
  void Add(ceres::CostFunction* cost, Blocks... blocks) {
    problem_.AddResidualBlock(cost, nullptr, blocks...);
  }

  // Holds `values` where they are, as firmly as they are known.
  template <typename Values>
  void Stay(const Eigen::MatrixXd& covariance, Values& values) {
    Add(new ceres::NormalPrior(Whitening(covariance), values), values.data());
  }

  // The nodes of a fit, and its free ends if it is a line, are points.
  void AddFit(const FitIndex& index, const CurveFit& fit) {
    if (fit.kind == FitKind::kArc) arcs_.emplace(index, ArcOf(fit));
    for (const bool at_end : {false, true}) {
      const int node = at_end ? fit.end_node : fit.start_node;
      if (node >= 0) {
        end_points_[{index, at_end}] = static_cast<std::size_t>(node);
      } else if (fit.kind == FitKind::kLine) {
        end_points_[{index, at_end}] = points_.size();
        points_.push_back(
            at_end ? UncertainPoint{fit.end, WithoutSliding(fit.end_covariance)}
                   : UncertainPoint{fit.start,
                                    WithoutSliding(fit.start_covariance)});
      }
    }
  }

  double* EndOf(const FitIndex& index, bool at_end) {
    return points_[end_points_.at({index, at_end})].position.data();
  }

  void AddMember(const FitGroup& group, const FitIndex& index, Shared& shared) {
    const CurveFit& fit = FitOf(index);
    const bool is_arc = fit.kind == FitKind::kArc;
    const Chart direction(group.direction);
    const double weight = kHard / fit.sigma;
    double* arc = is_arc ? arcs_.at(index).values.data() : nullptr;
    std::vector<double*> positions = {arc};
    if (!is_arc) positions = {EndOf(index, false), EndOf(index, true)};
    const double turn_weight =
        weight * (is_arc ? fit.major.norm() : (fit.end - fit.start).norm());
    if (group.kind == GroupKind::kEqualRadius) {
      Add(Auto<RadiusCost, 1, 6, 1>({weight}), arc, &shared.radius);
      return;
    }
    const bool is_plane = group.kind == GroupKind::kCoplanar;
    const bool is_parallel = group.kind == GroupKind::kParallel;
    for (double* position : positions) {
      if (is_plane) {
        AddPlace<OnPlaneCost, 1, 1>(group, weight, is_arc, position, shared);
      } else if (!is_parallel) {
        AddPlace<OnAxisCost, 2, 2>(group, weight, is_arc, position, shared);
      }
    }
    if (is_arc) {
      Add(Auto<ArcAlongCost, 2, 6, 2>(
              {arcs_.at(index).normal, direction, turn_weight}),
          arc,
          shared.turn.data());
    } else if (is_parallel) {
      Add(Auto<LineAlongCost, 2, 3, 3, 2>({direction, weight}),
          positions[0],
          positions[1],
          shared.turn.data());
    }
  }

  // The position of a point or an arc is on the plane or axis of its group.
  template <typename Cost, int kResiduals, int kOffsets>
  void AddPlace(const FitGroup& group,
                double weight,
                bool is_arc,
                double* position,
                Shared& shared) {
    const Cost cost{Chart(group.direction), group.point, weight};
    Add(is_arc ? Auto<Cost, kResiduals, 6, 2, kOffsets>(cost)
               : Auto<Cost, kResiduals, 3, 2, kOffsets>(cost),
        position,
        shared.turn.data(),
        shared.offset.data());
  }

  static void WriteArc(const Arc& arc, CurveFit& fit) {
    const Vector3d normal = arc.normal.At(arc.values.data() + 3).normalized();
    Conic conic;
    conic.center = arc.values.head<3>();
    conic.a = conic.b = arc.values(5);
    const Eigen::Quaterniond turn = ShortestRotation(arc.normal.base, normal);
    const Vector3d x = (turn * fit.major).normalized();
    conic.frame << x, normal.cross(x), normal;
    // Free ends go to their feet.
    if (fit.start_node < 0) {
      fit.start = conic.At(NearestParameter(conic, fit.start));
    }
    if (fit.end_node < 0) fit.end = conic.At(NearestParameter(conic, fit.end));
    if (fit.closed) fit.end = fit.start;
    SetConic(conic, fit);
  }

  static void WriteGroup(const Shared& shared, FitGroup& group) {
    const Chart direction(group.direction);
    const Vector3d moved = direction.At(shared.turn.data());
    if (group.kind == GroupKind::kEqualRadius) {
      group.radius = shared.radius;
      return;
    }
    if (group.kind == GroupKind::kCoplanar) {
      group.point += shared.offset[0] / moved.squaredNorm() * moved;
    } else if (group.kind != GroupKind::kParallel) {
      group.point += direction.across *
                     Eigen::Vector2d(shared.offset[0], shared.offset[1]);
    }
    group.direction = moved.normalized();
  }

  const FittedCurves& fitted_;
  std::vector<UncertainPoint> points_, before_;
  std::map<FitIndex, Arc> arcs_, arcs_before_;
  std::map<std::pair<FitIndex, bool>, std::size_t> end_points_;
  std::vector<Shared> shared_;
  ceres::Problem problem_;
};

// Without these fits, and without groups that say nothing any more. False:
// there was nothing to drop.
bool Drop(const std::set<FitIndex>& fits, FitStructure& structure) {
  bool any = false;
  for (FitGroup& group : structure.groups) {
    any |= std::erase_if(group.fits, [&](const FitIndex& i) {
             return fits.count(i) > 0;
           }) > 0;
  }
  std::erase_if(structure.perpendicular, [&](const PerpendicularGroups& p) {
    return structure.groups[p.first].fits.empty() ||
           structure.groups[p.second].fits.empty();
  });
  std::vector<bool> used(structure.groups.size());
  for (const PerpendicularGroups& p : structure.perpendicular) {
    used[p.first] = used[p.second] = true;
  }
  std::vector<FitGroup> kept;
  std::vector<std::size_t> place(structure.groups.size());
  for (std::size_t g = 0; g < structure.groups.size(); ++g) {
    place[g] = kept.size();
    if (used[g] || structure.groups[g].fits.size() > 1) {
      kept.push_back(std::move(structure.groups[g]));
    }
  }
  for (PerpendicularGroups& p : structure.perpendicular) {
    p.first = place[p.first];
    p.second = place[p.second];
  }
  structure.groups = std::move(kept);
  return any;
}

// Drops these fits; if none is in a group, those that they meet in nodes, and
// so on. False: there was nothing to drop.
bool DropOrNext(std::set<FitIndex> fits, FittedCurves& fitted) {
  while (!Drop(fits, fitted.structure)) {
    std::set<FitIndex> next = fits;
    for (const FitIndex& index : fits) {
      const CurveFit& fit = fitted.curves[index.curve_idx].fits[index.fit_idx];
      for (const int node : {fit.start_node, fit.end_node}) {
        if (node < 0) continue;
        const auto n = static_cast<std::size_t>(node);
        for (const CurveNode::End& end : fitted.nodes[n].ends) {
          next.insert({end.curve_idx, end.fit_idx});
        }
      }
    }
    if (next.size() == fits.size()) return false;
    fits = std::move(next);
  }
  return true;
}

}  // namespace

void Regularize(FittedCurves& fitted) {
  for (int round = 0; !fitted.structure.groups.empty(); ++round) {
    Adjustment adjustment(fitted);
    adjustment.Solve();
    const std::map<FitIndex, double> moves = adjustment.Moves();
    double worst = 0;
    for (const auto& [index, move] : moves) worst = std::max(worst, move);
    if (worst <= kMaxAdjustmentSigmas) {
      adjustment.WriteTo(fitted);
      return;
    }
    const double share = round < kMaxCarefulRounds ? kShareOfWorst : 0;
    const double limit = std::max(kMaxAdjustmentSigmas, share * worst);
    std::set<FitIndex> far;
    for (const auto& [index, move] : moves) {
      if (move >= limit) far.insert(index);
    }
    if (!DropOrNext(std::move(far), fitted)) fitted.structure = {};
  }
}

}  // namespace curvix
