// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/known_structures.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/text_fields.h"
#include "measuring/moved_curves.h"
#include "plugin/align/curves_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status BadDistance(const std::string& text, const std::string& why) {
  return {StatusCode::kInvalidArgument,
          "--distance " + text + ": " + why +
              "; it takes two nodes or points and their distance, as in "
              "--distance 12 31 1.250 or --distance 0,0,0 1,0.5,0 1.250"};
}

CurveNode UsualPoint(const KnownStructures& structures) {
  std::vector<double> variances;
  for (const CurveNode& node : structures.fitted.nodes) {
    variances.push_back(node.covariance.trace() / 3);
  }
  CurveNode point;
  point.covariance =
      MedianOr(0, std::move(variances)) * Eigen::Matrix3d::Identity();
  return point;
}

Result<CurveNode> FindPoint(std::string_view word,
                            const KnownStructures& structures,
                            const std::string& text) {
  if (word.find(',') != std::string_view::npos) {
    const Result<Eigen::Vector3d> position = ParseVector("the point", word);
    if (!position.ok()) return BadDistance(text, position.status().message());
    CurveNode point = UsualPoint(structures);
    point.position = structures.model_from_world * *position;
    return point;
  }
  const std::optional<std::size_t> id = ParseNumber<std::size_t>(word);
  if (!id) {
    return BadDistance(text,
                       "\"" + std::string(word) +
                           "\" is no number of a "
                           "node and no point x,y,z");
  }
  const std::vector<CurveNode>& nodes = structures.fitted.nodes;
  if (*id < nodes.size()) return nodes[*id];
  return BadDistance(text, NoSuchNode(word, structures.fitted));
}

Result<KnownDistance> ParseDistance(const std::string& text,
                                    const KnownStructures& structures) {
  std::string_view rest = text;
  const std::string_view first = TakeWord(rest);
  const std::string_view second = TakeWord(rest);
  const std::string_view length = TakeWord(rest);
  const std::string_view sigma = TakeWord(rest);
  if (length.empty() || !TakeWord(rest).empty()) {
    return BadDistance(text,
                       "it is not three words, or four with a "
                       "standard deviation");
  }
  const Result<CurveNode> a = FindPoint(first, structures, text);
  if (!a.ok()) return a.status();
  const Result<CurveNode> b = FindPoint(second, structures, text);
  if (!b.ok()) return b.status();
  const std::optional<double> value = ParseNumber<double>(length);
  const std::optional<double> error =
      sigma.empty() ? 0 : ParseNumber<double>(sigma);
  if (!value || !(*value > 0) || !std::isfinite(*value)) {
    return BadDistance(text, "the distance is not a number above 0");
  }
  if (!error || !(*error >= 0) || !std::isfinite(*error)) {
    return BadDistance(text, "the standard deviation is not a number from 0");
  }
  return KnownDistance{
      a->position, b->position, a->covariance, b->covariance, *value, *error};
}

}  // namespace

Result<KnownStructures> ReadStructures(const fs::path& folder) {
  Result<CurvesFile> file = ReadCurvesFile(folder);
  if (!file.ok()) return file.status();
  KnownStructures result;
  if (file->alignment) {
    result.model_from_world = file->alignment->world_from_model.Inverse();
  }
  result.fitted = MoveFits(result.model_from_world, std::move(file->fitted));
  return result;
}

Result<std::vector<KnownDistance>> ParseDistances(
    const std::string& text, const KnownStructures& structures) {
  std::vector<KnownDistance> distances;
  for (const std::string_view part : SplitAt(text, ';')) {
    Result<KnownDistance> distance =
        ParseDistance(std::string(part), structures);
    if (!distance.ok()) return distance.status();
    distances.push_back(*std::move(distance));
  }
  return distances;
}

Result<Eigen::Vector3d> ParseVector(const std::string& what,
                                    std::string_view text) {
  const std::vector<double> numbers = ParseNumbers(text, 3);
  if (!numbers.empty()) {
    const Eigen::Vector3d vector = Eigen::Vector3d::Map(numbers.data());
    if (vector.allFinite()) return vector;
  }
  return Status(StatusCode::kInvalidArgument,
                what + " \"" + std::string(text) +
                    "\" is not three numbers with commas between");
}

}  // namespace curvix
