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
  return Status::InvalidArgument(
      "--distance " + text + ": " + why +
      "; it takes two nodes or points and their distance, as in --distance 12 "
      "31 1.250 or --distance 0,0,0 1,0.5,0 1.250");
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

// "12" or "0,0,0".
struct GivenPoint {
  std::string word;
  std::optional<std::size_t> node;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct GivenDistance {
  std::string text;
  GivenPoint a, b;
  double length = 0;
  double sigma = 0;
};

Result<GivenPoint> ReadPoint(std::string_view word, const std::string& text) {
  GivenPoint point;
  point.word = word;
  if (word.find(',') != std::string_view::npos) {
    const Result<Eigen::Vector3d> position = ParseVector("the point", word);
    if (!position.ok()) return BadDistance(text, position.status().message());
    point.position = *position;
    return point;
  }
  point.node = ParseNumber<std::size_t>(word);
  if (point.node) return point;
  return BadDistance(
      text, "\"" + point.word + "\" is no number of a node and no point x,y,z");
}

Result<GivenDistance> ReadDistance(std::string_view text) {
  GivenDistance given;
  given.text = text;
  std::string_view rest = text;
  const std::string_view first = TakeWord(rest);
  const std::string_view second = TakeWord(rest);
  const std::string_view length = TakeWord(rest);
  const std::string_view sigma = TakeWord(rest);
  if (length.empty() || !TakeWord(rest).empty()) {
    return BadDistance(given.text,
                       "it is not three words, or four with a standard "
                       "deviation");
  }
  Result<GivenPoint> a = ReadPoint(first, given.text);
  if (!a.ok()) return a.status();
  Result<GivenPoint> b = ReadPoint(second, given.text);
  if (!b.ok()) return b.status();
  given.a = *std::move(a);
  given.b = *std::move(b);
  given.length = ParseNumber<double>(length).value_or(0);
  given.sigma = sigma.empty() ? 0 : ParseNumber<double>(sigma).value_or(-1);
  if (!(given.length > 0) || !std::isfinite(given.length)) {
    return BadDistance(given.text, "the distance is not a number above 0");
  }
  if (!(given.sigma >= 0) || !std::isfinite(given.sigma)) {
    return BadDistance(given.text,
                       "the standard deviation is not a number from 0");
  }
  return given;
}

Result<CurveNode> FindPoint(const GivenPoint& given,
                            const KnownStructures& structures,
                            const std::string& text) {
  if (!given.node) {
    CurveNode point = UsualPoint(structures);
    point.position = structures.model_from_world * given.position;
    return point;
  }
  const std::vector<CurveNode>& nodes = structures.fitted.nodes;
  if (*given.node < nodes.size()) return nodes[*given.node];
  return BadDistance(text, NoSuchNode(given.word, structures.fitted));
}

Result<KnownDistance> ParseDistance(std::string_view text,
                                    const KnownStructures& structures) {
  const Result<GivenDistance> given = ReadDistance(text);
  if (!given.ok()) return given.status();
  const Result<CurveNode> a = FindPoint(given->a, structures, given->text);
  if (!a.ok()) return a.status();
  const Result<CurveNode> b = FindPoint(given->b, structures, given->text);
  if (!b.ok()) return b.status();
  return KnownDistance{a->position,
                       b->position,
                       a->covariance,
                       b->covariance,
                       given->length,
                       given->sigma};
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

Status CheckDistances(const std::string& text) {
  for (const std::string_view part : SplitAt(text, ';')) {
    Status status = ReadDistance(part).status();
    if (!status.ok()) return status;
  }
  return {};
}

Result<std::vector<KnownDistance>> ParseDistances(
    const std::string& text, const KnownStructures& structures) {
  std::vector<KnownDistance> distances;
  for (const std::string_view part : SplitAt(text, ';')) {
    Result<KnownDistance> distance = ParseDistance(part, structures);
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
  return Status::InvalidArgument(what + " \"" + std::string(text) +
                                 "\" is not three numbers with commas between");
}

}  // namespace curvix
