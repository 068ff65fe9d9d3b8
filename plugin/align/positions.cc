// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/positions.h"

#ifdef CURVIX_HAS_GDAL
#include <cpl_conv.h>
#include <ogr_srs_api.h>
#endif
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "plugin/base/text.h"

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

Result<CameraPositions> ReadPositions(const std::filesystem::path& path,
                                      const Scene& scene) {
  CURVIX_ASSIGN_OR_RETURN(std::string file, ReadFile(path));
  LineReader reader(file);
  const auto broken = [&](const std::string& why) {
    return Status::DataLoss(path.string() + ", line " +
                            std::to_string(reader.line_number()) + " " + why);
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
