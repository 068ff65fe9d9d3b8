// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/check_positions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plugin/base/text.h"

namespace curvix {
namespace {

// Positions whose coordinates are off by more than this share of the distance
// of cameras from their middle (standard deviation, and root mean square) are
// not those of the cameras. 3 m of GPS around a house are 0.15 of it, mirrored
// positions all around 0.8, whatever their number.
constexpr double kLargeShareOff = 0.3;

// Nor if they fit so much better in a mirror. Where all are in a plane, they
// fit a mirror as well, and cameras that are upside down tell.
constexpr double kMirroredShareOff = 0.5;
constexpr double kExactShareOff = 1e-4;  // of their extent: they fit
constexpr double kUpsideDownCosine = 0.5;

// Of the positions from their middle, model units; root mean square.
double ExtentOf(const std::vector<KnownPosition>& positions) {
  const auto n = static_cast<double>(positions.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const KnownPosition& p : positions) mean += p.model / n;
  double squares = 0;
  for (const KnownPosition& p : positions) {
    squares += (p.model - mean).squaredNorm();
  }
  return std::sqrt(squares / n);
}

Status CheckAxes(const AlignmentInput& input,
                 const AlignmentResult& result,
                 const Eigen::Vector3d& up_of_cameras,
                 bool z_is_up) {
  if (!result.has_rotation_of_positions) return {};
  AlignmentInput mirrored;
  mirrored.positions = input.positions;
  for (KnownPosition& p : mirrored.positions) {
    std::swap(p.world.x(), p.world.y());
  }
  const Result<AlignmentResult> other = EstimateAlignment(mirrored);
  const double least = kExactShareOff *
                       result.alignment.world_from_model.scale *
                       ExtentOf(input.positions);
  if (other.ok() && RmsOf(result) > least &&
      RmsOf(*other) < kMirroredShareOff * RmsOf(result)) {
    return Status::InvalidArgument(
        "The positions fit the cameras only as in a mirror: they are " +
        SigmaText(RmsOf(result)) +
        " off (root mean square), and with x and y "
        "swapped " +
        SigmaText(RmsOf(*other)) + ". Give x (east) before y (north)");
  }
  if (!z_is_up || !AreUpsideDown(result, up_of_cameras)) return {};
  return Status::InvalidArgument(
      "By the positions the cameras are upside down. Give x (east) before y "
      "(north), and heights, not depths");
}

}  // namespace

double RmsOf(const AlignmentResult& result) {
  double squares = 0;
  for (const Eigen::Vector3d& left : result.position_residuals) {
    squares += left.squaredNorm();
  }
  return std::sqrt(squares /
                   static_cast<double>(result.position_residuals.size()));
}

std::size_t WorstOf(const AlignmentResult& result) {
  const auto& left = result.position_residuals;
  const auto worst = std::ranges::max_element(left, {}, &Eigen::Vector3d::norm);
  return static_cast<std::size_t>(worst - left.begin());
}

bool AreUpsideDown(const AlignmentResult& result,
                   const Eigen::Vector3d& up_of_cameras) {
  const Eigen::Vector3d up =
      result.alignment.world_from_model.rotation * up_of_cameras;
  return result.has_rotation_of_positions && up.z() < -kUpsideDownCosine;
}

Status CheckPositions(const AlignmentInput& input,
                      const AlignmentResult& result,
                      const Eigen::Vector3d& up_of_cameras,
                      bool z_is_up) {
  if (input.positions.empty()) return {};
  Status axes = CheckAxes(input, result, up_of_cameras, z_is_up);
  if (!axes.ok()) return axes;
  const double extent =
      result.alignment.world_from_model.scale * ExtentOf(input.positions);
  // Positions may be as far off as their standard deviations say.
  const double off = result.misfit > kLargeMisfit ? RmsOf(result) / std::sqrt(3)
                                                  : result.position_sigma;
  if (!(extent > 0) || !(off > kLargeShareOff * extent)) return {};
  const std::size_t worst = WorstOf(result);
  return Status::InvalidArgument(
      "The positions do not fit the cameras: each coordinate is " +
      SigmaText(off) + " off (standard deviation), and the cameras are " +
      SigmaText(extent) + " from their middle. " + input.positions[worst].name +
      " fits worst, by " + SigmaText(result.position_residuals[worst].norm()) +
      ". Look for a wrong number, degrees or a mirrored axis; if positions are "
      "that uncertain, give a standard deviation after each");
}

}  // namespace curvix
