// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/known_structures.h"

#include <cmath>
#include <utility>

#include "base/median.h"
#include "base/text_fields.h"
#include "measuring/moved_curves.h"
#include "plugin/align/curves_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status BadDistance(const std::string& text, const std::string& why) {
  return Status::InvalidArgument(
      "--distance " + text + ": " + why +
      "; it takes two nodes or points and their distance, as in --distance 12 "
      "31 1.250 or --distance 0,0,0 1,0.5,0 1.250");
}

// As uncertain as most nodes; without any, as samples of most fits.
CurveNode UsualPoint(const KnownStructures& structures) {
  std::vector<double> variances;
  for (const CurveNode& node : structures.fitted.nodes) {
    variances.push_back(node.covariance.trace() / 3);
  }
  if (variances.empty()) {
    for (const FittedCurve& curve : structures.fitted.curves) {
      for (const CurveFit& fit : curve.fits) {
        variances.push_back(fit.sigma * fit.sigma);
      }
    }
  }
  CurveNode point;
  point.covariance =
      MedianOr(0, std::move(variances)) * Eigen::Matrix3d::Identity();
  return point;
}

// The point that "12" or "0,0,0" names. Without `structures` only its syntax is
// checked.
Result<CurveNode> ReadPoint(std::string_view word,
                            const std::string& text,
                            const KnownStructures* structures) {
  if (word.find(',') != std::string_view::npos) {
    const Result<Eigen::Vector3d> position = ParseVector("the point", word);
    if (!position.ok()) return BadDistance(text, position.status().message());
    if (structures == nullptr) return CurveNode();
    CurveNode point = UsualPoint(*structures);
    point.position = structures->model_from_world * *position;
    return point;
  }
  const auto node = ParseNumber<std::size_t>(word);
  if (!node) {
    return BadDistance(text,
                       "\"" + std::string(word) +
                           "\" is no number of a node and no point x,y,z");
  }
  if (structures == nullptr) return CurveNode();
  const std::vector<CurveNode>& nodes = structures->fitted.nodes;
  if (*node < nodes.size()) return nodes[*node];
  return BadDistance(text, NoSuchNode(word, structures->fitted));
}

Result<KnownDistance> ReadDistance(const std::string& text,
                                   const KnownStructures* structures) {
  std::string_view rest = text;
  const std::string_view first = TakeWord(rest);
  const std::string_view second = TakeWord(rest);
  const std::string_view length_word = TakeWord(rest);
  const std::string_view sigma_word = TakeWord(rest);
  if (length_word.empty() || !TakeWord(rest).empty()) {
    return BadDistance(text,
                       "it is not three words, or four with a standard "
                       "deviation");
  }
  CURVIX_ASSIGN_OR_RETURN(const CurveNode a,
                          ReadPoint(first, text, structures));
  CURVIX_ASSIGN_OR_RETURN(const CurveNode b,
                          ReadPoint(second, text, structures));
  if (first == second || (structures != nullptr && a.position == b.position)) {
    return BadDistance(text, "its two points are the same");
  }
  const double length = ParseNumber<double>(length_word).value_or(0);
  if (!(length > 0) || !std::isfinite(length)) {
    return BadDistance(text, "the distance is not a number above 0");
  }
  const double sigma =
      sigma_word.empty() ? 0 : ParseNumber<double>(sigma_word).value_or(-1);
  if (!(sigma >= 0) || !std::isfinite(sigma)) {
    return BadDistance(text, "the standard deviation is not a number from 0");
  }
  return KnownDistance{
      a.position, b.position, a.covariance, b.covariance, length, sigma};
}

Result<std::vector<KnownDistance>> ReadDistances(
    const std::string& text, const KnownStructures* structures) {
  std::vector<KnownDistance> distances;
  for (const std::string_view part : SplitAt(text, ';')) {
    CURVIX_ASSIGN_OR_RETURN(const KnownDistance distance,
                            ReadDistance(std::string(part), structures));
    distances.push_back(distance);
  }
  return distances;
}

}  // namespace

Result<KnownStructures> ReadStructures(const fs::path& folder) {
  CURVIX_ASSIGN_OR_RETURN(CurvesFile file, ReadCurvesFile(folder));
  KnownStructures result;
  if (file.alignment) {
    result.model_from_world = file.alignment->world_from_model.Inverse();
    result.is_aligned = true;
  }
  result.fitted = MoveFits(result.model_from_world, std::move(file.fitted));
  return result;
}

Status CheckDistances(const std::string& text) {
  return ReadDistances(text, nullptr).status();
}

bool HavePoints(std::string_view distances) {
  return distances.find(',') != std::string_view::npos;
}

Result<std::vector<KnownDistance>> ParseDistances(
    const std::string& text, const KnownStructures& structures) {
  return ReadDistances(text, &structures);
}

Result<Eigen::Vector3d> ParseVector(const std::string& what,
                                    std::string_view text) {
  const std::vector<double> numbers = ParseNumbers(text, 3);
  if (!numbers.empty()) {
    const Eigen::Vector3d vector = Eigen::Vector3d::Map(numbers.data());
    if (vector.allFinite()) return vector;
  }
  return Status::InvalidArgument(what + " \"" + std::string(text) +
                                 "\" is not three numbers with commas between");
}

}  // namespace curvix
