// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "plugin/commands/evaluate_holdout.h"

#include <curvix/curve_io.h>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "colmap/workspace.h"
#include "plugin/run/text.h"

namespace curvix {
namespace {

std::string Cell(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%9.1f", value);
  return text.data();
}

void PrintRow(std::string name,
              const ShareAboveChance& share,
              std::ostream& out) {
  name.resize(40, ' ');
  out << name << Cell(100 * share.share) << Cell(100 * share.chance)
      << Cell(100 * share.Lift()) << '\n';
}

void PrintTable(const HoldoutResult& result, std::ostream& out) {
  const ImageAgreement& agreement = result.agreement;
  std::string head = "in the images held out, %";
  head.resize(40, ' ');
  out << result.num_held_out << " views held out, "
      << GroupDigits(result.curves.num_curves) << " curves of total length "
      << result.curves.total_length << "\n\n"
      << head << "    share   chance     lift\n";
  PrintRow("curves on a contour (precision)", agreement.precision, out);
  PrintRow(
      "the same where they should be seen", agreement.expected_precision, out);
  PrintRow("strong contours with a curve", agreement.strong_contours, out);
  PrintRow("long lines with a curve", agreement.long_lines, out);
  out << "median length of a curve: "
      << Cell(agreement.median_piece_px).substr(2)
      << " px\n\nChance: the same after moving by 12 pixels across. Lift: what "
         "is above chance, of\nwhat can be. Hidden curves count as being on no "
         "contour.\n";
}

void PrintJson(const HoldoutResult& result, std::ostream& out) {
  const ImageAgreement& agreement = result.agreement;
  nlohmann::ordered_json json;
  json["held_out"] = result.num_held_out;
  json["curves"] = result.curves.num_curves;
  json["length"] = result.curves.total_length;
  json["piece_px"] = agreement.median_piece_px;
  const auto add = [&json](const std::string& name,
                           const ShareAboveChance& share) {
    json[name] = 100 * share.share;
    json[name + "_chance"] = 100 * share.chance;
    json[name + "_lift"] = 100 * share.Lift();
  };
  add("precision", agreement.precision);
  add("expected_precision", agreement.expected_precision);
  add("strong", agreement.strong_contours);
  add("lines", agreement.long_lines);
  out << json.dump() << '\n';
}

Result<CurveSet> ReconstructOthers(const Scene& scene,
                                   const Options& options,
                                   int every,
                                   RunProgress& progress) {
  const Result<std::vector<EdgeMap>> edge_maps =
      DetectEdges(scene, options, progress.Callback());
  if (!edge_maps.ok()) return edge_maps.status();
  Result<Holdout> holdout = ReconstructWithHoldout(
      scene, *edge_maps, options, every, progress.Callback());
  if (!holdout.ok()) return holdout.status();
  return std::move(holdout->reconstruction.curves);
}

}  // namespace

void PrintHoldout(const HoldoutResult& result,
                  EvaluationFormat format,
                  std::ostream& out) {
  if (format == EvaluationFormat::kJson) return PrintJson(result, out);
  PrintTable(result, out);
}

Status RunHoldout(const RunSettings& settings,
                  const std::filesystem::path& curves_path,
                  int every,
                  EvaluationFormat format,
                  RunProgress& progress,
                  std::ostream& out) {
  const Result<Workspace> workspace = FindWorkspace({settings.workspace_path,
                                                     settings.input_path,
                                                     settings.image_path,
                                                     settings.output_path,
                                                     settings.mask_path});
  if (!workspace.ok()) return workspace.status();
  const Result<WorkspaceScene> input = LoadWorkspaceScene(*workspace);
  if (!input.ok()) return input.status();
  const Scene& scene = input->scene;
  const Result<std::vector<int>> view_idxs =
      ViewsHeldOut(scene.views.size(), every);
  if (!view_idxs.ok()) return view_idxs.status();
  for (const std::string& note : input->notes) progress.Note(note);
  const Result<CurveSet> curves =
      curves_path.empty()
          ? ReconstructOthers(scene, settings.options, every, progress)
          : ReadCurves(curves_path, scene);
  if (!curves.ok()) return curves.status();
  const Result<ImageAgreement> agreement = CompareWithImages(
      curves->curves, scene, *view_idxs, settings.options.runtime.num_threads);
  if (!agreement.ok()) return agreement.status();
  progress.Finish();
  PrintHoldout({static_cast<int>(view_idxs->size()),
                SummarizeCurves(*curves),
                *agreement},
               format,
               out);
  return {};
}

}  // namespace curvix
