// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/align_workspace.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/count_text.h"
#include "base/file_io.h"
#include "base/text_fields.h"
#include "measuring/world_alignment.h"
#include "plugin/align/find_markers.h"
#include "plugin/align/known_structures.h"
#include "plugin/align/positions.h"
#include "plugin/base/text.h"
#include "plugin/export/alignment_file.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Two axes that no more directions share may be those of a detail.
constexpr int kFewDirections = 3;
constexpr double kLargeScaleSigma = 0.1;

// One position is suspect if the others, without it, are off by less than this
// share of what all are.
constexpr double kOthersShareOff = 1 / 3.0;
constexpr std::size_t kFewPositions = 5;

std::string Text(double value) { return ShortText(value, 6); }

std::string WithSigma(double value, double sigma) {
  return Text(value) + " +- " + SigmaText(sigma);
}

MeanDirections DirectionsOf(const Scene& scene) {
  return {MeanUp(scene.views), MeanViewDirection(scene.views)};
}

Status CheckUp(const std::string& text) {
  const Result<Eigen::Vector3d> up = ParseVector("--up", text);
  if (!up.ok() || up->norm() > 0) return up.status();
  return Status::InvalidArgument("--up has no direction");
}

class Aligner {
 public:
  Aligner(const AlignSettings& settings, RunProgress& progress)
      : settings_(settings), progress_(progress) {}

  Result<std::string> Run();
  // On the input.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Status ReadScene();
  void WarnOfCoordinates();
  Status TakeDistances();
  Status TakeMarkers();
  Status TakePositions();
  Status TakeAxes();
  Status Write(const AlignmentResult& result);
  void DescribeScale(const AlignmentResult& result);
  void DescribePositions(const AlignmentResult& result);
  void WarnOfMisfit(double misfit);
  void Say(const std::string& line) { text_ += line + "\n"; }

  const AlignSettings& settings_;
  RunProgress& progress_;
  Workspace workspace_;
  Scene scene_;
  std::vector<std::string> notes_;
  KnownStructures structures_;
  AlignmentInput input_;
  std::vector<FoundMarker> markers_;
  Json sources_ = Json::object();
  std::string text_;
};

Status Aligner::ReadScene() {
  CURVIX_ASSIGN_OR_RETURN(workspace_, FindInputOfResults(settings_.run));
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene input, ReadRefinedScene(workspace_));
  scene_ = std::move(input.scene);
  notes_ = std::move(input.notes);
  if (settings_.distances.empty() && settings_.axes == "none") return {};
  CURVIX_ASSIGN_OR_RETURN(structures_, ReadStructures(workspace_.output_path));
  if (structures_.is_aligned) WarnOfCoordinates();
  return {};
}

// Nodes are the same whatever the frame; coordinates read from the model are
// others in the results that are there now.
void Aligner::WarnOfCoordinates() {
  std::string options = HavePoints(settings_.distances) ? "--distance" : "";
  if (!settings_.up.empty()) options += options.empty() ? "--up" : " and --up";
  if (options.empty()) return;
  const std::string path = (workspace_.output_path / kAlignmentName).string();
  progress_.Note(
      "WARNING: The results are aligned already: coordinates after " + options +
      " are taken to be those of the aligned results. If they are "
      "the model's, remove " +
      path + ", repeat the run that wrote the results, then align again.");
}

Status Aligner::TakeDistances() {
  if (settings_.distances.empty()) return {};
  CURVIX_ASSIGN_OR_RETURN(input_.distances,
                          ParseDistances(settings_.distances, structures_));
  return {};
}

Status Aligner::TakeMarkers() {
  if (settings_.markers.empty()) return {};
  progress_.Update("find_markers", 0, 0);
  CURVIX_ASSIGN_OR_RETURN(FoundMarkers found,
                          FindMarkers(scene_,
                                      settings_.markers,
                                      settings_.marker_size,
                                      settings_.run.options.runtime));
  progress_.Finish(Plural(found.markers.size(), "marker"));
  for (const std::string& note : found.notes) progress_.Note(note);
  for (const FoundMarker& marker : found.markers) {
    // Their mean divides each variance by their number, which must not lower
    // what they have in common.
    KnownScale scale = marker.scale;
    const auto num_others = static_cast<double>(found.markers.size() - 1);
    scale.sigma =
        std::hypot(scale.sigma, marker.common_sigma * std::sqrt(num_others));
    input_.scales.push_back(scale);
  }
  sources_["corner_sigma_px"] = found.corner_sigma_px;
  markers_ = std::move(found.markers);
  return {};
}

Status Aligner::TakePositions() {
  if (settings_.positions_path.empty()) return {};
  CURVIX_ASSIGN_OR_RETURN(CameraPositions read,
                          ReadPositions(settings_.positions_path, scene_));
  for (const std::string& note : read.notes) progress_.Note(note);
  const Status sigmas = CheckSigmas(read.positions);
  if (!sigmas.ok()) {
    return {sigmas.code(),
            settings_.positions_path.string() + ": " + sigmas.message()};
  }
  input_.positions = std::move(read.positions);
  return {};
}

Status Aligner::TakeAxes() {
  if (settings_.axes == "none") return {};
  Eigen::Vector3d up = MeanUp(scene_.views);
  if (!settings_.up.empty()) {
    up = structures_.model_from_world.rotation *
         *ParseVector("--up", settings_.up);
  }
  CURVIX_ASSIGN_OR_RETURN(
      const MainAxes axes,
      FindMainAxes(structures_.fitted, up, MeanViewDirection(scene_.views)));
  input_.axes = axes.axes;
  const char* const names[3] = {"y to z", "z to x", "x to y"};
  Json& json = sources_["axes"];
  std::string counts, angles;
  for (std::size_t i = 0; i < 3; ++i) {
    counts += (i > 0 ? ", " : "") + std::to_string(axes.num_directions[i]);
    if (std::isnan(axes.angle_deg[i])) continue;
    angles += (angles.empty() ? "" : ", ") + std::string(names[i]) + " " +
              WithSigma(axes.angle_deg[i], axes.angle_sigma_deg[i]);
  }
  json["num_directions"] = axes.num_directions;
  json["angle_deg"] = axes.angle_deg;
  json["angle_sigma_deg"] = axes.angle_sigma_deg;
  Say("Axes shared by " + counts +
      " lines, axes of arcs and rows of circles (x, y, z)");
  const auto& num = axes.num_directions;
  const int num_others = std::accumulate(num.begin(), num.end(), 0) -
                         *std::ranges::max_element(num);
  if (num_others <= kFewDirections) {
    Say("  Only " + Plural(num_others, "direction") +
        " along the other two axes: look whether they are right.");
  }
  if (!angles.empty()) Say("  angles, fitted one by one, deg: " + angles);
  return {};
}

void Aligner::DescribeScale(const AlignmentResult& result) {
  const double scale = result.alignment.world_from_model.scale;
  Say("Scale " + Text(scale) + ", to " +
      SigmaText(100 * result.alignment.scale_sigma()) + " %");
  if (result.alignment.scale_sigma() > kLargeScaleSigma) {
    progress_.Note(
        "WARNING: The scale is hardly known. Look for a wrong coordinate or "
        "standard deviation, or measure between places further apart.");
  }
  for (std::size_t i = 0; i < input_.distances.size(); ++i) {
    const KnownDistance& d = input_.distances[i];
    const double now = scale * (d.a - d.b).norm();
    Say("  distance of " + Text(d.length) + " is now " + Text(now));
    sources_["distances"].push_back(
        {{"length", d.length}, {"sigma", d.sigma}, {"after", now}});
  }
  for (const FoundMarker& marker : markers_) {
    const double now = scale * marker.side;
    Say("  marker " + std::to_string(marker.id) + " in " +
        Plural(marker.num_views, "image") + " has a side of " +
        WithSigma(now, now * marker.scale.sigma));
    sources_["markers"].push_back({{"id", marker.id},
                                   {"num_views", marker.num_views},
                                   {"side", settings_.marker_size},
                                   {"after", now},
                                   {"after_sigma", now * marker.scale.sigma}});
  }
}

void Aligner::DescribePositions(const AlignmentResult& result) {
  for (std::size_t i = 0; i < input_.positions.size(); ++i) {
    const Eigen::Vector3d& left = result.position_residuals[i];
    sources_["positions"].push_back(
        {{"name", input_.positions[i].name},
         {"residual", {left.x(), left.y(), left.z()}}});
  }
  const std::size_t worst = WorstOf(result);
  const std::string& name = input_.positions[worst].name;
  Say(Plural(input_.positions.size(), "position") + ", " +
      SigmaText(RmsOf(result)) + " off (root mean square), " + name +
      " most: " + SigmaText(result.position_residuals[worst].norm()));
  if (AreUpsideDown(result, DirectionsOf(scene_))) {
    Say("  By the positions the cameras are upside down: are x and y swapped, "
        "or is z a depth?");
  }
  if (input_.positions.size() < kFewPositions) return;
  AlignmentInput others = input_;
  others.positions.erase(others.positions.begin() +
                         static_cast<std::ptrdiff_t>(worst));
  const Result<AlignmentResult> without = EstimateAlignment(others);
  if (without.ok() && RmsOf(*without) < kOthersShareOff * RmsOf(result)) {
    Say("  Without " + name + " the others are " + SigmaText(RmsOf(*without)) +
        " off: check its position.");
  }
}

void Aligner::WarnOfMisfit(double misfit) {
  const bool may_mix_units =
      !input_.positions.empty() &&
      !(input_.distances.empty() && input_.scales.empty());
  progress_.Note(
      "WARNING: What is given contradicts itself: its errors are " +
      SigmaText(misfit) +
      " times what they should be (root mean square). Look for a wrong number, "
      "a wrong node" +
      (may_mix_units ? ", lengths in another unit than positions" : "") +
      " or a moved marker.");
}

Status Aligner::Write(const AlignmentResult& result) {
  Json json = AlignmentJson(result.alignment);
  json["sources"] = sources_;
  json["cameras"] = CentersJson(scene_);
  fs::create_directories(workspace_.output_path);
  return WriteFileAtomically(
      workspace_.output_path / kAlignmentName,
      json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<std::string> Aligner::Run() {
  CURVIX_RETURN_IF_ERROR(ReadScene());
  CURVIX_RETURN_IF_ERROR(TakeDistances());
  CURVIX_RETURN_IF_ERROR(TakeMarkers());
  CURVIX_RETURN_IF_ERROR(TakePositions());
  CURVIX_RETURN_IF_ERROR(TakeAxes());
  CURVIX_ASSIGN_OR_RETURN(AlignmentResult result, EstimateAlignment(input_));
  CURVIX_RETURN_IF_ERROR(CheckPositions(
      input_, result, DirectionsOf(scene_), !settings_.epsg.empty()));
  WorldAlignment& alignment = result.alignment;
  if (settings_.unit != "none" && !alignment.has_scale) {
    return Status::InvalidArgument(
        "--unit needs a scale, which nothing that is given tells: add "
        "--distance, --markers or --positions");
  }
  if (!settings_.epsg.empty() && !alignment.has_scale) {
    return Status::InvalidArgument(
        "--epsg needs a scale, which a single position does not tell: add "
        "--distance, --markers or more positions");
  }
  if (!settings_.epsg.empty() && !result.has_heading) {
    return Status::InvalidArgument(
        "--epsg needs to know where north is, which one position, or positions "
        "above each other, do not tell: add another to the side");
  }
  if (settings_.unit != "none") alignment.unit = settings_.unit;
  if (!settings_.epsg.empty()) {
    alignment.crs = "EPSG:" + settings_.epsg;
    alignment.unit = "m";
  }
  if (input_.axes && result.has_rotation_of_positions) {
    Say("  The positions tell the axes; those of the lines are not used.");
  }
  if (alignment.has_scale) DescribeScale(result);
  if (!input_.positions.empty()) DescribePositions(result);
  if (result.misfit > kLargeMisfit) WarnOfMisfit(result.misfit);
  if (alignment.has_rotation) {
    const Eigen::Vector3d variances =
        alignment.covariance.diagonal().segment<3>(1);
    const double of_up = std::max(variances.x(), variances.y());
    Say("Up known to " + SigmaText(RadToDeg(std::sqrt(of_up))) +
        " deg, x and y about it to " +
        SigmaText(RadToDeg(std::sqrt(variances.z()))) + " deg");
  }
  if (!alignment.offset.isZero(0)) {
    constexpr int kAllDigits = 15;
    Say("Coordinates are those given less " +
        ShortText(alignment.offset.x(), kAllDigits) + " " +
        ShortText(alignment.offset.y(), kAllDigits) + " " +
        ShortText(alignment.offset.z(), kAllDigits));
  }
  CURVIX_RETURN_IF_ERROR(Write(result));
  Say("Written to " + (workspace_.output_path / kAlignmentName).string());
  return std::move(text_);
}

}  // namespace

Status Check(const AlignSettings& s) {
  if (s.distances.empty() && s.markers.empty() && s.positions_path.empty() &&
      s.axes == "none") {
    return Status::InvalidArgument(
        "align needs something that is known: --distance, --markers, "
        "--positions or --axes auto");
  }
  if (!s.markers.empty() && !(s.marker_size > 0)) {
    return Status::InvalidArgument(
        "--markers needs --marker_size, the side of the black square");
  }
  if (s.markers.empty() && s.marker_size > 0) {
    return Status::InvalidArgument(
        "--marker_size needs --markers, the dictionary that they are of");
  }
  if (!s.up.empty() && s.axes == "none") {
    return Status::InvalidArgument("--up needs --axes auto, which it corrects");
  }
  if (!s.epsg.empty() && s.positions_path.empty()) {
    return Status::InvalidArgument(
        "--epsg needs --positions, whose coordinates it names");
  }
  if (!s.epsg.empty() && s.unit != "none" && s.unit != "m") {
    return Status::InvalidArgument(
        "--unit is " + s.unit +
        ", and positions with --epsg are in metres; leave --unit out");
  }
  Status status;
  if (!s.distances.empty()) status = CheckDistances(s.distances);
  if (status.ok() && !s.up.empty()) status = CheckUp(s.up);
  if (status.ok() && !s.epsg.empty()) status = CheckEpsg(s.epsg);
  return status;
}

Result<std::string> AlignWorkspace(const AlignSettings& settings,
                                   RunProgress& progress) {
  Aligner aligner(settings, progress);
  Result<std::string> text = aligner.Run();
  if (!text.ok() || !settings.run_follows) {
    for (const std::string& note : aligner.notes()) progress.Note(note);
  }
  return text;
}

}  // namespace curvix
