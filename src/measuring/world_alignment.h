// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Scale and axes. Images determine neither the unit of a model nor where up is;
// known lengths, positions and directions do.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/similarity.h"

namespace curvix {

using Matrix7d = Eigen::Matrix<double, 7, 7>;

// Of "mm", "cm", "m", "in" and "ft"; nullopt: of others.
std::optional<double> MillimetresPer(std::string_view unit);

// From the frame of the model to one of the user's.
struct WorldAlignment {
  Similarity3 world_from_model;
  // Of the logarithm of the scale, of a turn of the world about its axes
  // (radians), and of the translation (world units): of (s, w, t) in
  // exp(s) exp([w]x) scale rotation x + translation + t. 0 where a parameter is
  // not known or exact.
  Matrix7d covariance = Matrix7d::Zero();
  // Which parameters were observed; the others are those of the model.
  bool has_scale = false;
  bool has_rotation = false;
  bool has_translation = false;
  std::string unit;  // "mm", say; "": not named
  std::string crs;   // "EPSG:25832", say; "": none
  // Large coordinates lose digits in 32 bits: this much has been taken off
  // those of the user. Multiples of 100.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  // Standard deviation of the scale, as a share of it.
  double scale_sigma() const { return std::sqrt(covariance(0, 0)); }
};

// Two points of the model and how far they are from each other.
struct KnownDistance {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  // model
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_a = Eigen::Matrix3d::Zero();  // model units^2
  Eigen::Matrix3d covariance_b = Eigen::Matrix3d::Zero();
  double length = 0;  // world units, > 0
  double sigma = 0;   // of the length, >= 0
};

// A factor from the model's unit to the world's.
struct KnownScale {
  double scale = 1;  // > 0
  double sigma = 0;  // of its logarithm, > 0
};

// A point of the model and where it is.
struct KnownPosition {
  std::string name;
  Eigen::Vector3d model = Eigen::Vector3d::Zero();
  Eigen::Vector3d world = Eigen::Vector3d::Zero();
  double sigma = 0;  // of each coordinate, world units; 0: not known
};

// Directions of the world's axes in the model.
struct KnownAxes {
  Eigen::Quaterniond world_from_model = Eigen::Quaterniond::Identity();
  // Of a turn about the world's axes, radians^2, positive definite.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

struct AlignmentInput {
  std::vector<KnownDistance> distances;
  std::vector<KnownScale> scales;
  std::vector<KnownPosition> positions;
  std::optional<KnownAxes> axes;
};

struct AlignmentResult {
  WorldAlignment alignment;
  // Whether the rotation is that of the positions; then axes have no part.
  bool has_rotation_of_positions = false;
  // Whether positions tell the directions of x and y.
  bool has_heading = false;
  // Of each position, the estimated one minus the known one; world units.
  std::vector<Eigen::Vector3d> position_residuals;
  // The standard deviation of the positions if they had none.
  double position_sigma = 0;
  // Root mean square of all residuals, in standard deviations: above 1, what is
  // given contradicts itself. 0: it is no more than what is estimated.
  double misfit = 0;
};

// kInvalidArgument, with a sentence: positions have no sigma and are fewer than
// three, or only some have one.
Status CheckSigmas(const std::vector<KnownPosition>& positions);

// The least squares estimate from all of `input`: the scale from distances,
// scales and two positions or more; the rotation from three positions or more
// that are not on a line, else from axes, whose heading positions on a line
// correct; the translation from positions.
// Unobserved parameters stay as in the model. The covariance is multiplied by
// the square of `misfit` where this is above 1; without positions, that of the
// scale, which nothing else depends on. Positions without a sigma all have the
// same, estimated from their residuals. kInvalidArgument, with a sentence:
// nothing is given, points of a distance coincide, or positions do not fix the
// rotation and no axes are given, the scale is below 1e-24 or above 1e24, or
// CheckSigmas() says so.
Result<AlignmentResult> EstimateAlignment(const AlignmentInput& input);

}  // namespace curvix
