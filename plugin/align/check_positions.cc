// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/check_positions.h"

#include <algorithm>
#include <cmath>
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

// x and y are swapped if positions fit so much better then. Fewer positions may
// do so by chance. Positions in a plane fit as well either way, but swapped
// ones turn the cameras upside down.
constexpr double kSwappedShareOff = 0.3;
constexpr std::size_t kFewestToTellSwapped = 5;
constexpr double kExactShareOff = 1e-4;  // of their extent: they fit

// Least cosine of the mean up with down; of the mean view direction with up.
constexpr double kUpsideDownCosine = 0.5;
constexpr double kToTheSkyCosine = 0.8;

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

bool HaveSigmas(const AlignmentInput& input) {
  return input.positions.front().sigma > 0;
}

Status CheckSwapped(const AlignmentInput& input,
                    const AlignmentResult& result) {
  if (!result.has_rotation_of_positions ||
      input.positions.size() < kFewestToTellSwapped) {
    return {};
  }
  AlignmentInput given, swapped;
  given.positions = swapped.positions = input.positions;
  for (KnownPosition& p : swapped.positions) {
    std::swap(p.world.x(), p.world.y());
  }
  const Result<AlignmentResult> of_given = EstimateAlignment(given);
  const Result<AlignmentResult> of_swapped = EstimateAlignment(swapped);
  if (!of_given.ok() || !of_swapped.ok()) return {};
  const double rms = RmsOf(*of_given);
  const double least = kExactShareOff *
                       of_given->alignment.world_from_model.scale *
                       ExtentOf(input.positions);
  const bool may_be_off = HaveSigmas(input) && of_given->misfit <= kLargeMisfit;
  if (may_be_off || rms < least ||
      RmsOf(*of_swapped) >= kSwappedShareOff * rms) {
    return {};
  }
  return Status::InvalidArgument(
      "The positions fit the cameras better with x and y swapped: they are " +
      SigmaText(rms) + " off (root mean square), swapped " +
      SigmaText(RmsOf(*of_swapped)) + ". Give x (east) before y (north)");
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
                   const MeanDirections& cameras) {
  if (!result.has_rotation_of_positions) return false;
  const Eigen::Quaterniond& rotation =
      result.alignment.world_from_model.rotation;
  return (rotation * cameras.up).z() < -kUpsideDownCosine ||
         (rotation * cameras.forward).z() > kToTheSkyCosine;
}

Status CheckPositions(const AlignmentInput& input,
                      const AlignmentResult& result,
                      const MeanDirections& cameras,
                      bool z_is_up) {
  if (input.positions.empty()) return {};
  CURVIX_RETURN_IF_ERROR(CheckSwapped(input, result));
  if (z_is_up && AreUpsideDown(result, cameras)) {
    return Status::InvalidArgument(
        "By the positions the cameras are upside down. Give x (east) before y "
        "(north), and heights, not depths");
  }
  const double extent =
      result.alignment.world_from_model.scale * ExtentOf(input.positions);
  double off = result.position_sigma;
  if (HaveSigmas(input) && result.misfit > kLargeMisfit) {
    off = RmsOf(result) / std::sqrt(3);
  }
  if (!(extent > 0) || !(off > kLargeShareOff * extent)) return {};
  const std::size_t worst = WorstOf(result);
  return Status::InvalidArgument(
      "The positions do not fit the cameras: each coordinate is " +
      SigmaText(off) + " off (standard deviation), and the cameras are " +
      SigmaText(extent) + " from their middle. " + input.positions[worst].name +
      " fits worst, by " + SigmaText(result.position_residuals[worst].norm()) +
      ". Look for a wrong number, a wrong distance or unit, degrees or a "
      "mirrored axis; if positions are that uncertain, give a standard "
      "deviation after each");
}

}  // namespace curvix
