// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "plugin/evaluate_holdout.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "plugin/text.h"
#include "plugin/workspace.h"

namespace curvix {
namespace {

void PrintRow(const char* name,
              const char* format,
              double all,
              double expected,
              std::ostream& out) {
  std::string row(name);
  row.resize(32, ' ');
  for (const double value : {all, expected}) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), format, value);
    std::string cell(text.data());
    if (cell.size() < 12) cell.insert(0, 12 - cell.size(), ' ');
    row += cell;
  }
  out << row << '\n';
}

void PrintTable(const Holdout& holdout, std::ostream& out) {
  const HoldoutAgreement& all = holdout.all;
  const HoldoutAgreement& expected = holdout.expected;
  const ResultSummary curves = SummarizeCurves(holdout.reconstruction.curves);
  out << holdout.num_held_out << " views held out, "
      << GroupDigits(curves.num_curves) << " curves of total length "
      << curves.total_length << " from the others\n\n"
      << "in the views held out              anywhere    expected\n";
  PrintRow(
      "on an edge, %", "%.1f", 100 * all.support, 100 * expected.support, out);
  PrintRow("the same by chance, %",
           "%.1f",
           100 * all.chance,
           100 * expected.chance,
           out);
  PrintRow("median distance from it, px",
           "%.3f",
           all.median_distance_px,
           expected.median_distance_px,
           out);
  PrintRow("projections of samples",
           "%.0f",
           static_cast<double>(all.num_projections),
           static_cast<double>(expected.num_projections),
           out);
  out << "\nExpected: those that the two views in most like direction see.\n";
}

void PrintJson(const Holdout& holdout, std::ostream& out) {
  const ResultSummary curves = SummarizeCurves(holdout.reconstruction.curves);
  nlohmann::ordered_json json;
  json["held_out"] = holdout.num_held_out;
  const auto add = [&json](const std::string& prefix,
                           const HoldoutAgreement& agreement) {
    json[prefix + "support"] = agreement.support;
    json[prefix + "chance"] = agreement.chance;
    json[prefix + "median_px"] = agreement.median_distance_px;
    json[prefix + "projections"] = agreement.num_projections;
  };
  add("", holdout.all);
  add("expected_", holdout.expected);
  json["curves"] = curves.num_curves;
  json["length"] = curves.total_length;
  out << json.dump() << '\n';
}

}  // namespace

void PrintHoldout(const Holdout& holdout,
                  EvaluationFormat format,
                  std::ostream& out) {
  if (format == EvaluationFormat::kJson) return PrintJson(holdout, out);
  PrintTable(holdout, out);
}

Status RunHoldout(const RunSettings& settings,
                  const HoldoutOptions& options,
                  EvaluationFormat format,
                  ProgressPrinter& progress,
                  std::ostream& out) {
  const Result<Workspace> workspace = FindWorkspace({settings.workspace_path,
                                                     settings.input_path,
                                                     settings.image_path,
                                                     settings.output_path,
                                                     settings.mask_path});
  if (!workspace.ok()) return workspace.status();
  const Result<WorkspaceScene> input = LoadWorkspaceScene(*workspace);
  if (!input.ok()) return input.status();
  for (const std::string& note : input->notes) progress.Note(note);
  const Result<std::vector<EdgeMap>> edge_maps =
      DetectEdges(input->scene, settings.options, progress.Callback());
  if (!edge_maps.ok()) return edge_maps.status();
  const Result<Holdout> holdout = EvaluateHoldout(
      input->scene, *edge_maps, settings.options, options, progress.Callback());
  if (!holdout.ok()) return holdout.status();
  progress.Finish();
  PrintHoldout(*holdout, format, out);
  return {};
}

}  // namespace curvix
