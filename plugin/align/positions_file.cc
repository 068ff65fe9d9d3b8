// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/positions_file.h"

#ifdef CURVIX_HAS_GDAL
#include <cpl_conv.h>
#include <ogr_srs_api.h>
#endif
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"
#include "colmap/files.h"

namespace curvix {
namespace {

constexpr std::string_view kSeparators = " \t\r\v\f,;";

// Without separators at the end.
std::string_view WithoutEnd(std::string_view text) {
  return text.substr(0, text.find_last_not_of(kSeparators) + 1);
}

// The name without quotes around it.
std::string NameOf(std::string_view text) {
  text = WithoutEnd(text);
  if (text.size() > 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

// What a line can mean: four numbers at its end may have a sigma among them, or
// the first one ends the name.
std::vector<KnownPosition> ReadingsOf(std::string_view line) {
  std::vector<double> numbers;          // from the right
  std::vector<std::string_view> names;  // what is before each of them
  while (numbers.size() < 4) {
    line = WithoutEnd(line);
    const std::size_t begin = line.find_last_of(kSeparators) + 1;
    const auto number = ParseNumber<double>(line.substr(begin));
    if (begin == 0 || !number || !std::isfinite(*number)) break;
    line = line.substr(0, begin);
    numbers.push_back(*number);
    names.push_back(line);
  }
  std::vector<KnownPosition> readings;
  for (std::size_t n = numbers.size(); n >= 3; --n) {
    KnownPosition position;
    position.name = NameOf(names[n - 1]);
    position.world = {numbers[n - 1], numbers[n - 2], numbers[n - 3]};
    if (n == 4) position.sigma = numbers[0];
    const bool is_sound = n == 3 || position.sigma > 0;
    if (is_sound && !position.name.empty()) readings.push_back(position);
  }
  return readings;
}

using Centers = std::map<std::string, Eigen::Vector3d>;

// The reading whose name is in the model, else the first one. Names may hold
// "#", which else begins a comment.
std::optional<KnownPosition> ParsePosition(std::string_view line,
                                           const Centers& centers) {
  std::optional<KnownPosition> first;
  for (std::size_t end = line.find('#');; end = line.find('#', end + 1)) {
    for (KnownPosition& position : ReadingsOf(line.substr(0, end))) {
      if (centers.contains(position.name)) return position;
      if (!first) first = std::move(position);
    }
    if (end == std::string_view::npos) break;
  }
  // A name of the model and too many numbers.
  const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
  if (centers.contains(std::string(word))) return std::nullopt;
  return first;
}

Centers CentersOf(const Scene& scene) {
  Centers centers;
  for (const View& view : scene.views) {
    centers[view.name] = view.cam_from_world.Inverse().translation;
  }
  return centers;
}

// What is wrong with it; "": nothing.
#ifdef CURVIX_HAS_GDAL
constexpr double kSameUnit = 1e-9;  // m

std::string WhyNotInMetres(int code) {
  const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  std::string why;
  if (OSRImportFromEPSG(system, code) != OGRERR_NONE) {
    why = "which GDAL does not know: " + std::string(CPLGetLastErrorMsg());
  } else if (OSRIsGeographic(system) != 0) {
    why = "whose coordinates are degrees";
  } else if (OSRIsProjected(system) == 0) {
    why = "whose axes are not east and north";
  } else {
    char* unit = nullptr;
    const double metres = OSRGetLinearUnits(system, &unit);
    if (std::abs(metres - 1) > kSameUnit) {
      why = "whose coordinates are in the unit " + std::string(unit);
    }
  }
  CPLPopErrorHandler();
  OSRDestroySpatialReference(system);
  return why;
}
#else
std::string WhyNotInMetres(int) { return ""; }
#endif

}  // namespace

Result<CameraPositions> ReadPositions(const std::filesystem::path& path,
                                      const Scene& scene) {
  CURVIX_ASSIGN_OR_RETURN(std::string file, ReadFile(path));
  LineReader reader(file);
  const auto broken = [&](const std::string& why) {
    return Status::DataLoss("line " + std::to_string(reader.line_number()) +
                            " of " + path.string() + " " + why);
  };
  const Centers centers = CentersOf(scene);
  CameraPositions result;
  std::set<std::string> names;
  std::vector<std::string> unknown;
  while (const auto line = reader.NextFilled()) {
    std::optional<KnownPosition> position = ParsePosition(*line, centers);
    if (!position) {
      return broken(
          "is not \"name x y z\", or with a standard deviation above 0 \"name "
          "x y z sigma\"");
    }
    if (!names.insert(position->name).second) {
      return broken("names " + position->name + " once more");
    }
    const auto center = centers.find(position->name);
    if (center == centers.end()) {
      unknown.push_back(position->name + " (line " +
                        std::to_string(reader.line_number()) + ")");
      continue;
    }
    position->model = center->second;
    result.positions.push_back(*std::move(position));
  }
  if (result.positions.empty()) {
    return Status::DataLoss(
        path.string() + " names no image of the model, as " +
        (scene.views.empty() ? "" : scene.views.front().name) + " is one");
  }
  if (!unknown.empty()) {
    result.notes.push_back(
        path.string() +
        " names what is no image of the model: " + FirstNames(unknown));
  }
  return result;
}

Status CheckEpsg(const std::string& code) {
  const std::optional<int> number = ParseNumber<int>(code);
  const std::string why = number && *number >= 1024 && *number <= 32767
                              ? WhyNotInMetres(*number)
                              : "which is no code of EPSG";
  if (why.empty()) return {};
  return Status::InvalidArgument(
      "--epsg is " + code + ", " + why +
      "; it takes the number of a system with metres, as 25832, into which "
      "gdaltransform converts positions");
}

}  // namespace curvix
