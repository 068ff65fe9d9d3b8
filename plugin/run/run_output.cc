// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_output.h"

#include <curvix/curve_io.h>
#include <cstdint>
#include <string>
#include <utility>

#include "base/file_io.h"
#include "measuring/moved_curves.h"
#include "plugin/export/write_results.h"
#include "plugin/run/run_stages.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

FittedCurves Fit(const Scene& scene,
                 const CurveSource& curves,
                 RunRecord& record) {
  const Stopwatch stopwatch;
  const Options& options = record.settings.options;
  FittedCurves fitted = FitCurves(
      curves, scene, options.curve_fitting, options.runtime.num_threads);
  record.stages.push_back(stopwatch.Read("fit_curves"));
  record.stages.back().counts = CountFits(fitted);
  return fitted;
}

// In the world, if it is known.
Result<std::vector<std::string>> WriteInFrame(const CurveRecord& curves,
                                              const fs::path& folder,
                                              const RunRecord& record) {
  const OutputSettings& output = record.settings.output;
  const int num_threads = record.settings.options.runtime.num_threads;
  if (!record.alignment) {
    return WriteResults(curves, output, num_threads, folder);
  }
  const Similarity3& world_from_model = record.alignment->world_from_model;
  const Scene moved_scene = MoveScene(world_from_model, curves.scene);
  const MovedCurves moved_curves(curves.curves, world_from_model);
  const FittedCurves moved = MoveFits(world_from_model, curves.fitted);
  return WriteResults({moved_scene, moved_curves, moved, &*record.alignment},
                      output,
                      num_threads,
                      folder);
}

Status WriteCurveFiles(const CurveRecord& curves,
                       bool is_repeatable,
                       const fs::path& folder,
                       RunRecord& record) {
  Result<std::vector<std::string>> written =
      WriteInFrame(curves, folder, record);
  if (!written.ok()) return written.status();
  std::vector<std::string>& files = record.result.files;
  files.insert(files.end(), written->begin(), written->end());
  if (!is_repeatable) return {};
  files.push_back("project.ini");
  return WriteFileAtomically(folder / "project.ini",
                             ProjectFile(record.settings));
}

}  // namespace

Result<FittedCurves> WriteFindings(const Scene& scene,
                                   const Findings& findings,
                                   const fs::path& folder,
                                   RunRecord& record) {
  ResultSummary& result = record.result;
  findings.curves.ForEach(
      [&](std::size_t, const Curve& curve) { Count(curve, result); });
  if (record.alignment) {
    result.total_length *= record.alignment->world_from_model.scale;
  }
  result.num_edges_3d = findings.num_edges_3d;
  result.why_empty = findings.why_empty;
  FittedCurves fitted;
  if (result.num_curves > 0) fitted = Fit(scene, findings.curves, record);
  Status status = findings.curves.status();
  const Stopwatch stopwatch;
  if (status.ok() && result.num_curves > 0) {
    status = WriteCurveFiles({scene, findings.curves, fitted},
                             findings.is_repeatable,
                             folder,
                             record);
  }
  if (status.ok() && result.num_edges_3d > 0) {
    result.files.push_back("edges.ply");
    status = findings.write_edges(folder / "edges.ply");
  }
  if (!status.ok()) return status;
  record.stages.push_back(stopwatch.Read("write_files"));
  return fitted;
}

Status WriteReport(const Stopwatch& since_start,
                   const fs::path& folder,
                   RunProgress& progress,
                   RunRecord& record) {
  record.result.files.push_back("report.json");
  record.total = since_start.Read("total");
  progress.Finish();
  return WriteFileAtomically(folder / "report.json", ReportJson(record));
}

}  // namespace curvix
