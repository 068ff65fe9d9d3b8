// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/known_structures.h"

#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/text_fields.h"
#include "measuring/moved_curves.h"
#include "plugin/align/alignment_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status BadDistance(const std::string& text, const std::string& why) {
  return {StatusCode::kInvalidArgument,
          "--distance " + text + ": " + why +
              "; it takes two nodes or points and their distance, as in "
              "--distance 12 31 1.250 or --distance 0,0,0 1,0.5,0 1.250"};
}

Eigen::Vector3d VectorOf(const Json& json) {
  return {json.at(0).get<double>(),
          json.at(1).get<double>(),
          json.at(2).get<double>()};
}

Eigen::Matrix3d MatrixOf(const Json& json) {
  const auto at = [&](std::size_t i) { return json.at(i).get<double>(); };
  Eigen::Matrix3d m;
  m << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
  return m;
}

// All of curves.json but the samples, which are most of it.
Json ReadWithoutSamples(std::ifstream& file) {
  return Json::parse(
      file,
      [](int, Json::parse_event_t event, Json& parsed) {
        return event != Json::parse_event_t::key || parsed != "samples";
      },
      false);
}

Result<KnownStructures> Structures(const Json& json) {
  KnownStructures result;
  if (json.contains("alignment")) {
    Json alignment = json["alignment"];
    alignment["format"] = "curvix alignment";
    alignment["version"] = 1;
    const Result<WorldAlignment> frame = AlignmentFromJson(alignment);
    if (!frame.ok()) return frame.status();
    result.model_from_world = frame->world_from_model.Inverse();
  }
  const Similarity3& frame = result.model_from_world;
  const auto covariance = [&](const Json& matrix) {
    return MoveCovariance(frame, MatrixOf(matrix));
  };
  for (const Json& node : json.at("nodes")) {
    result.nodes.push_back({frame * VectorOf(node.at("position")),
                            covariance(node.at("covariance"))});
  }
  for (const Json& curve : json.at("curves")) {
    for (const Json& fit : curve.at("fits")) {
      if (fit.at("kind") != "line") continue;
      result.lines.push_back({frame * VectorOf(fit.at("start")),
                              frame * VectorOf(fit.at("end")),
                              covariance(fit.at("start_covariance")),
                              covariance(fit.at("end_covariance"))});
    }
  }
  return result;
}

KnownPoint UsualPoint(const KnownStructures& structures) {
  std::vector<double> variances;
  for (const KnownPoint& node : structures.nodes) {
    variances.push_back(node.covariance.trace() / 3);
  }
  KnownPoint point;
  point.covariance =
      MedianOr(0, std::move(variances)) * Eigen::Matrix3d::Identity();
  return point;
}

Result<KnownPoint> FindPoint(std::string_view word,
                             const KnownStructures& structures,
                             const std::string& text) {
  if (word.find(',') != std::string_view::npos) {
    const Result<Eigen::Vector3d> position = ParseVector("the point", word);
    if (!position.ok()) return BadDistance(text, position.status().message());
    KnownPoint point = UsualPoint(structures);
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
  const std::size_t count = structures.nodes.size();
  if (*id < count) return structures.nodes[*id];
  return BadDistance(text,
                     "there is no node " + std::to_string(*id) +
                         (count == 0 ? "; curves.json has none"
                                     : "; curves.json has the nodes 0 to " +
                                           std::to_string(count - 1)));
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
  const Result<KnownPoint> a = FindPoint(first, structures, text);
  if (!a.ok()) return a.status();
  const Result<KnownPoint> b = FindPoint(second, structures, text);
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
  const fs::path path = folder / "curves.json";
  std::ifstream file(path);
  if (!file) {
    return Status(StatusCode::kNotFound,
                  "there is no " + path.string() +
                      ", which has the nodes and lines; run 'colmap_curvix "
                      "reconstruct' first, with json among its "
                      "--output_formats");
  }
  const Json json = ReadWithoutSamples(file);
  const std::string advice = "; run 'colmap_curvix reconstruct' again";
  try {
    if (!json.is_discarded()) {
      Result<KnownStructures> result = Structures(json);
      if (result.ok()) return result;
      return Status(
          StatusCode::kDataLoss,
          path.string() + " is broken: " + result.status().message() + advice);
    }
  } catch (const nlohmann::json::exception& error) {
    return Status(StatusCode::kDataLoss,
                  path.string() + " lacks something: " + error.what() + advice);
  }
  return Status(StatusCode::kDataLoss, path.string() + " is not JSON" + advice);
}

Result<std::vector<KnownDistance>> ParseDistances(
    const std::string& text, const KnownStructures& structures) {
  std::vector<KnownDistance> distances;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    Result<KnownDistance> distance =
        ParseDistance(text.substr(begin, end - begin), structures);
    if (!distance.ok()) return distance.status();
    distances.push_back(*std::move(distance));
    begin = end + 1;
  }
  return distances;
}

Result<Eigen::Vector3d> ParseVector(const std::string& what,
                                    std::string_view text) {
  Eigen::Vector3d vector;
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::optional<double> value =
        ParseNumber<double>(rest.substr(0, end));
    const bool is_last = end == rest.size();
    if (!value || !std::isfinite(*value) || is_last != (i == 2)) {
      return Status(StatusCode::kInvalidArgument,
                    what + " \"" + std::string(text) +
                        "\" is not three numbers with commas between");
    }
    vector(i) = *value;
    rest.remove_prefix(is_last ? end : end + 1);
  }
  return vector;
}

}  // namespace curvix
