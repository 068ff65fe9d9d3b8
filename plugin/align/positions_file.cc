// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/positions_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/file_io.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

std::optional<KnownPosition> ParsePosition(std::string_view line) {
  KnownPosition position;
  position.name = TakeWord(line);
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = ParseNumber<double>(TakeWord(line));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    position.world(i) = *value;
  }
  const std::string_view sigma = TakeWord(line);
  if (!sigma.empty()) {
    const std::optional<double> value = ParseNumber<double>(sigma);
    if (!value || !(*value > 0) || !std::isfinite(*value)) return std::nullopt;
    position.sigma = *value;
  }
  if (!TakeWord(line).empty()) return std::nullopt;
  return position;
}

std::map<std::string, Eigen::Vector3d> Centers(const Scene& scene) {
  std::map<std::string, Eigen::Vector3d> centers;
  for (const View& view : scene.views) {
    centers[view.name] = view.cam_from_world.Inverse().translation;
  }
  return centers;
}

}  // namespace

Result<CameraPositions> ReadPositions(const std::filesystem::path& path,
                                      const Scene& scene) {
  Result<std::string> file = ReadFile(path);
  if (!file.ok()) return file.status();
  std::replace_if(
      file->begin(),
      file->end(),
      [](char c) { return c == ',' || c == ';'; },
      ' ');
  const auto broken = [&](int number, const std::string& why) {
    return Status(
        StatusCode::kDataLoss,
        "line " + std::to_string(number) + " of " + path.string() + " " + why);
  };
  const std::map<std::string, Eigen::Vector3d> centers = Centers(scene);
  CameraPositions result;
  std::set<std::string> names;
  std::string_view rest = *file;
  for (int number = 1; !rest.empty(); ++number) {
    std::string_view line = TakeLine(rest);
    line = line.substr(0, line.find('#'));
    std::string_view words = line;
    if (TakeWord(words).empty()) continue;
    std::optional<KnownPosition> position = ParsePosition(line);
    if (!position) {
      return broken(number,
                    "is not \"name x y z\", or with a standard deviation "
                    "above 0 \"name x y z sigma\"");
    }
    if (!names.insert(position->name).second) {
      return broken(number, "names " + position->name + " once more");
    }
    const auto center = centers.find(position->name);
    if (center == centers.end()) {
      result.notes.push_back("no image of the model is called " +
                             position->name);
      continue;
    }
    position->model = center->second;
    result.positions.push_back(*std::move(position));
  }
  if (result.positions.empty()) {
    return Status(StatusCode::kDataLoss,
                  path.string() + " names no image of the model, as " +
                      (scene.views.empty() ? "" : scene.views.front().name) +
                      " is one");
  }
  return result;
}

}  // namespace curvix
