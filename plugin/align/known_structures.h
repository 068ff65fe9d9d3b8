// SPDX-License-Identifier: BSD-3-Clause
// The nodes and lines of curves.json, in the frame of the model.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/similarity.h"
#include "measuring/main_axes.h"
#include "measuring/world_alignment.h"

namespace curvix {

struct KnownStructures {
  FittedCurves fitted;  // in the model's frame
  // Of the frame in which curves.json is; the identity without an alignment.
  Similarity3 model_from_world;
  bool is_aligned = false;
};

// kNotFound: there is no curves.json in `folder`; kDataLoss: it is broken, or
// of a program that wrote no covariances.
Result<KnownStructures> ReadStructures(const std::filesystem::path& folder);

// "A B LENGTH [SIGMA]" with ";" between several: A and B are nodes by their
// number, or points "x,y,z" in the coordinates of curves.json, which get the
// median uncertainty of the nodes. kInvalidArgument: a sentence that says what
// is wrong with which.
Result<std::vector<KnownDistance>> ParseDistances(
    const std::string& text, const KnownStructures& structures);

// kInvalidArgument as of ParseDistances, but for nodes that are not there and
// for one point that is written in two ways.
Status CheckDistances(const std::string& text);

// Whether any is between points x,y,z.
bool HavePoints(std::string_view distances);

// "x,y,z" to three finite numbers. kInvalidArgument: `what` is no such.
Result<Eigen::Vector3d> ParseVector(const std::string& what,
                                    std::string_view text);

}  // namespace curvix
