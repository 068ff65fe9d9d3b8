// SPDX-License-Identifier: BSD-3-Clause
// The primitives and nodes of curves.json.
#pragma once

#include <curvix/fitting.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measuring/world_alignment.h"

namespace curvix {

// A sample and the images that show it, ascending.
struct SeenSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> image_ids;
};

struct CurvesFile {
  FittedCurves fitted;  // as in the file; nodes without their ends
  std::optional<WorldAlignment> alignment;  // of the frame that they are in
  // Of each curve, if they are asked for.
  std::vector<std::vector<SeenSample>> samples;
};

// curves.json in a folder of results. kNotFound: there is
// none; kDataLoss: it is broken, or of a program that wrote less.
Result<CurvesFile> ReadCurvesFile(const std::filesystem::path& folder,
                                  bool with_samples = false);

// "there is no node 7; curves.json has the nodes 0 to 6".
std::string NoSuchNode(std::string_view node, const FittedCurves& fitted);

}  // namespace curvix
