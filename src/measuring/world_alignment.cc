// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/world_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/text_fields.h"
#include "geometry/directions.h"
#include "measuring/known_directions.h"

namespace curvix {
namespace {

constexpr int kNumSteps = 20;
constexpr double kLargeCoordinate = 10000;
constexpr double kOffsetStep = 100;
constexpr double kLargestScale = 1e24;
// Positions are on a line if their extent across it is a smaller share of that
// along it.
constexpr double kOnALine = 1e-3;
// A variance that says nothing of an angle, radians.
constexpr double kUnknownHeading = 1e4;

using Vector7d = Eigen::Matrix<double, 7, 1>;

// A step by (s, w, t) of WorldAlignment::covariance.
Similarity3 Moved(const Similarity3& from, const Vector7d& step) {
  Similarity3 to = from;
  to.scale *= std::exp(step(0));
  to.rotation = (RotationBy(step.segment<3>(1)) * from.rotation).normalized();
  to.translation += step.tail<3>();
  return to;
}

// Equations in (s, w, t), each divided by its standard deviation, summed up.
struct Equations {
  Matrix7d normal = Matrix7d::Zero();
  Vector7d right = Vector7d::Zero();
  double sum_of_squares = 0;
  int count = 0;

  template <typename Rows, typename Values>
  void Add(const Rows& rows, const Values& residuals) {
    normal += rows.transpose() * rows;
    right += rows.transpose() * residuals;
    sum_of_squares += residuals.squaredNorm();
    count += static_cast<int>(residuals.size());
  }
};

// Whether these are three points or more that are not on a line.
bool SpanAPlane(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 3) return false;
  const Eigen::Matrix3Xd centered = points.colwise() - points.rowwise().mean();
  const Eigen::Matrix3d scatter = centered * centered.transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
  return values(1) > kOnALine * kOnALine * values(2);
}

// Coordinates and their variances are to stay within floating-point numbers,
// also in files of 32 bits.
Status CheckScale(double scale) {
  if (scale >= 1 / kLargestScale && scale <= kLargestScale) return {};
  const std::string scale_is =
      std::isfinite(scale)
          ? "makes the scale " + NumberText(scale) + ", beyond what files hold"
          : "does not fix the scale";
  return Status::InvalidArgument(
      "What is given " + scale_is +
      ": look for a wrong distance, standard deviation, marker size, point or "
      "position");
}

class Estimator {
 public:
  explicit Estimator(const AlignmentInput& input) : input_(input) {}

  Result<AlignmentResult> Run() {
    CURVIX_RETURN_IF_ERROR(Start());
    Equations equations;
    WorldAlignment& a = result_.alignment;
    for (int step = 0; step <= kNumSteps; ++step) {
      if (step > 0) {
        a.world_from_model =
            Moved(a.world_from_model, a.covariance * equations.right);
      }
      EstimatePositionSigma();
      equations = Linearise();
      a.covariance = Covariance(equations.normal);
    }
    // The heading of the axes counts for nothing where positions tell it.
    const int num_free =
        equations.count - has_heading_ -
        (a.has_scale + 3 * a.has_rotation + 3 * a.has_translation);
    if (num_free > 0) {
      const double mean_square = equations.sum_of_squares / num_free;
      result_.misfit = std::sqrt(mean_square);
      // Without positions, the axes are exactly those given.
      const int num_affected = input_.positions.empty() ? 1 : 7;
      a.covariance.topLeftCorner(num_affected, num_affected) *=
          std::max(1.0, mean_square);
    }
    const Status scale = CheckScale(a.world_from_model.scale);
    if (!scale.ok()) return scale;
    if (!a.covariance.allFinite() ||
        !a.world_from_model.translation.allFinite()) {
      return Status::InvalidArgument(
          "What is given does not fix scale and axes");
    }
    result_.has_heading = has_heading_ || result_.has_rotation_of_positions;
    for (const KnownPosition& p : input_.positions) {
      result_.position_residuals.push_back(a.world_from_model * p.model -
                                           World(p));
    }
    return std::move(result_);
  }

 private:
  Status Start() {
    WorldAlignment& a = result_.alignment;
    Similarity3& start = a.world_from_model;
    if (input_.axes) {
      start.rotation = input_.axes->world_from_model;
      a.has_rotation = true;
    }
    for (const KnownDistance& d : input_.distances) {
      if (!((d.a - d.b).norm() > 0)) {
        return Status::InvalidArgument(
            "The two points of a distance are the same point");
      }
    }
    if (!input_.scales.empty()) {
      start.scale = input_.scales.front().scale;
      a.has_scale = true;
    } else if (!input_.distances.empty()) {
      const KnownDistance& d = input_.distances.front();
      start.scale = d.length / (d.a - d.b).norm();
      a.has_scale = true;
    }
    if (input_.positions.empty()) {
      if (a.has_scale || a.has_rotation) return {};
      return Status::InvalidArgument("Nothing is given to align to");
    }
    CURVIX_RETURN_IF_ERROR(CheckSigmas(input_.positions));
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const KnownPosition& p : input_.positions) mean += p.world;
    mean /= static_cast<double>(input_.positions.size());
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(mean[axis]) <= kLargeCoordinate) continue;
      a.offset[axis] = kOffsetStep * std::round(mean[axis] / kOffsetStep);
    }
    return StartAtPositions();
  }

  Status StartAtPositions() {
    const auto n = static_cast<Eigen::Index>(input_.positions.size());
    Eigen::Matrix3Xd model(3, n), world(3, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& p = input_.positions[static_cast<std::size_t>(i)];
      model.col(i) = p.model;
      world.col(i) = World(p);
    }
    WorldAlignment& a = result_.alignment;
    Similarity3& start = a.world_from_model;
    if (SpanAPlane(model)) {
      start = AlignPoints(model, world);
      a.has_rotation = a.has_scale = true;
      result_.has_rotation_of_positions = true;
    } else if (!a.has_rotation) {
      return Status::InvalidArgument(
          "The positions do not fix the axes: give three or more that are not "
          "on a line, or --axes auto as well");
    } else if (n > 1) {
      const double from = (model.colwise() - model.rowwise().mean()).norm();
      const double to = (world.colwise() - world.rowwise().mean()).norm();
      if (!(from > 0 && to > 0)) {
        return Status::InvalidArgument(
            "All positions are at one place, which gives no scale");
      }
      if (!a.has_scale) start.scale = to / from;
      a.has_scale = true;
      TurnToPositions(model, world);
    }
    if (!(start.scale > 0) || !std::isfinite(start.scale)) {
      return Status::InvalidArgument(
          "The positions coincide, which gives no scale");
    }
    a.has_translation = true;
    start.translation = world.rowwise().mean() -
                        start.scale * (start.rotation * model.rowwise().mean());
    return {};
  }

  // Positions on a line that is not upright know the heading, which the lines
  // of a scene do not; these tell the tilt.
  void TurnToPositions(const Eigen::Matrix3Xd& model,
                       const Eigen::Matrix3Xd& world) {
    Similarity3& start = result_.alignment.world_from_model;
    Eigen::Index furthest = 0;
    (world.colwise() - world.col(0)).colwise().norm().maxCoeff(&furthest);
    const Eigen::Vector3d to = world.col(furthest) - world.col(0);
    const Eigen::Vector3d from =
        start.rotation * (model.col(furthest) - model.col(0));
    constexpr double kMinLevelShare = 0.1;
    if (to.head<2>().norm() < kMinLevelShare * to.norm() ||
        from.head<2>().norm() < kMinLevelShare * from.norm()) {
      return;
    }
    heading_ = Eigen::AngleAxisd(
        std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x()),
        Eigen::Vector3d::UnitZ());
    has_heading_ = true;
    start.rotation = heading_ * start.rotation;
  }

  // Of the axes: how far they are turned, and the root of its information.
  std::pair<Eigen::Vector3d, Eigen::Matrix3d> TurnOfAxes() const {
    const Similarity3& now = result_.alignment.world_from_model;
    const Eigen::AngleAxisd turn(heading_ * input_.axes->world_from_model *
                                 now.rotation.conjugate());
    Eigen::Matrix3d covariance = input_.axes->covariance;
    if (has_heading_) {
      const Eigen::Matrix3d turned = heading_.toRotationMatrix();
      covariance = turned * covariance * turned.transpose();
      covariance(2, 2) += kUnknownHeading;
    }
    return {turn.angle() * turn.axis(), covariance.inverse().llt().matrixU()};
  }

  Eigen::Vector3d World(const KnownPosition& p) const {
    return p.world - result_.alignment.offset;
  }

  Equations Linearise() const {
    const Similarity3& now = result_.alignment.world_from_model;
    Equations equations;
    const auto add_scale = [&](double misfit, double sigma) {
      Eigen::Matrix<double, 1, 7> row = Eigen::Matrix<double, 1, 7>::Zero();
      row(0) = 1 / sigma;
      equations.Add(row, Eigen::Matrix<double, 1, 1>(misfit / sigma));
    };
    for (const KnownDistance& d : input_.distances) {
      const auto [misfit, sigma] = Misfit(d);
      add_scale(misfit, sigma);
    }
    for (const KnownScale& s : input_.scales) {
      add_scale(std::log(s.scale / now.scale), s.sigma);
    }
    if (input_.axes && !result_.has_rotation_of_positions) {
      const auto [turn, weight] = TurnOfAxes();
      Eigen::Matrix<double, 3, 7> rows = Eigen::Matrix<double, 3, 7>::Zero();
      rows.block<3, 3>(0, 1) = weight;
      equations.Add(rows, Eigen::Vector3d(weight * turn));
    }
    for (const KnownPosition& p : input_.positions) {
      const double sigma = SigmaOf(p);
      const Eigen::Vector3d turned = now.scale * (now.rotation * p.model);
      Eigen::Matrix<double, 3, 7> rows;
      rows << turned, -CrossMatrix(turned), Eigen::Matrix3d::Identity();
      equations.Add(Eigen::Matrix<double, 3, 7>(rows / sigma),
                    Eigen::Vector3d((World(p) - now * p.model) / sigma));
    }
    return equations;
  }

  // log(known / measured), and its standard deviation.
  std::pair<double, double> Misfit(const KnownDistance& d) const {
    const Eigen::Vector3d between = d.b - d.a;
    const double distance = between.norm();
    const double sigma = DistanceSigma(between, d.covariance_a, d.covariance_b);
    const double share = std::hypot(sigma / distance, d.sigma / d.length);
    const double scale = result_.alignment.world_from_model.scale;
    return {std::log(d.length / (scale * distance)), std::max(share, 1e-12)};
  }

  bool KnowSigmas() const { return input_.positions.front().sigma > 0; }

  double SigmaOf(const KnownPosition& p) const {
    return KnowSigmas() ? p.sigma : result_.position_sigma;
  }

  // The inverse for the parameters that are observed, else 0.
  Matrix7d Covariance(const Matrix7d& normal) const {
    const WorldAlignment& a = result_.alignment;
    Vector7d known = Vector7d::Zero();
    known(0) = a.has_scale;
    known.segment<3>(1).setConstant(a.has_rotation);
    known.tail<3>().setConstant(a.has_translation);
    // Units differ: each parameter in its own standard deviations.
    Vector7d size = normal.diagonal().cwiseSqrt();
    for (int i = 0; i < 7; ++i) size(i) = known(i) > 0 ? 1 / size(i) : 0;
    Matrix7d scaled = size.asDiagonal() * normal * size.asDiagonal();
    for (int i = 0; i < 7; ++i) scaled(i, i) += known(i) > 0 ? 0 : 1;
    return size.asDiagonal() * scaled.ldlt().solve(Matrix7d::Identity()) *
           size.asDiagonal();
  }

  void EstimatePositionSigma() {
    if (input_.positions.empty() || KnowSigmas()) return;
    double squares = 0;
    for (const KnownPosition& p : input_.positions) {
      squares += (World(p) - result_.alignment.world_from_model * p.model)
                     .squaredNorm();
    }
    const auto free = static_cast<double>(3 * input_.positions.size() - 7);
    // Not 0, where they agree to the last digit.
    const double least =
        1e-9 * (1 + result_.alignment.world_from_model.translation.norm());
    result_.position_sigma = std::max(std::sqrt(squares / free), least);
  }

  const AlignmentInput& input_;
  AlignmentResult result_;
  // By which positions turn the axes of lines, about z.
  Eigen::Quaterniond heading_ = Eigen::Quaterniond::Identity();
  bool has_heading_ = false;
};

}  // namespace

std::optional<double> MillimetresPer(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits = {
      {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}}};
  for (const auto& [name, millimetres] : kUnits) {
    if (name == unit) return millimetres;
  }
  return std::nullopt;
}

// A common sigma is estimated from the residuals of three positions or more.
// Beside others with a sigma, those without could be fitted exactly.
Status CheckSigmas(const std::vector<KnownPosition>& positions) {
  constexpr std::ptrdiff_t kFewest = 3;
  const auto num_known = std::ranges::count_if(
      positions, [](const KnownPosition& p) { return p.sigma > 0; });
  if (num_known == std::ssize(positions)) return {};
  if (num_known > 0) {
    return Status::InvalidArgument(
        "Some positions have a standard deviation and others have none: give "
        "it for all or for none");
  }
  if (std::ssize(positions) >= kFewest) return {};
  return Status::InvalidArgument(
      "The uncertainty of fewer than three positions cannot be estimated: give "
      "a standard deviation after each, \"name x y z sigma\" in a file");
}

Result<AlignmentResult> EstimateAlignment(const AlignmentInput& input) {
  return Estimator(input).Run();
}

}  // namespace curvix
