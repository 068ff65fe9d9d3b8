// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run_output.h"

#include <curvix/curve_io.h>
#include <curvix/file_io.h>
#include <curvix/fitting.h>

#include <cstdint>
#include <string>
#include <utility>

#include "plugin/run_counts.h"
#include "plugin/write_results.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status WriteCurveFiles(const Scene& scene,
                       const std::vector<EdgeMap>& edge_maps,
                       const CurveSet& curves,
                       const fs::path& folder,
                       RunRecord& record) {
  const Stopwatch stopwatch;
  const FittedCurves fitted =
      FitCurves(curves,
                scene,
                record.settings.options.curve_fitting,
                record.settings.options.runtime.num_threads);
  record.stages.push_back(stopwatch.Read("fit_curves"));
  record.stages.back().counts = CountFits(fitted);
  Result<std::vector<std::string>> written = WriteResults(
      {scene, edge_maps, curves, fitted}, record.settings.output, folder);
  if (!written.ok()) return written.status();
  std::vector<std::string>& files = record.result.files;
  files.insert(files.end(), written->begin(), written->end());
  files.push_back("project.ini");
  return WriteFileAtomically(folder / "project.ini",
                             ProjectFile(record.settings));
}

}  // namespace

void Summarize(const Reconstruction& reconstruction, ResultSummary& result) {
  ResultSummary found = SummarizeCurves(reconstruction.curves);
  found.output_path = std::move(result.output_path);
  found.files = std::move(result.files);
  found.num_edges_2d = result.num_edges_2d;
  found.num_edges_3d = static_cast<std::int64_t>(reconstruction.edges.size());
  found.why_empty = reconstruction.report.why_empty;
  result = std::move(found);
}

Status WriteReconstruction(const Scene& scene,
                           const std::vector<EdgeMap>& edge_maps,
                           const Reconstruction& reconstruction,
                           const fs::path& folder,
                           RunRecord& record) {
  const Stopwatch stopwatch;
  Summarize(reconstruction, record.result);
  Status status;
  if (!reconstruction.curves.curves.empty()) {
    status = WriteCurveFiles(
        scene, edge_maps, reconstruction.curves, folder, record);
  }
  if (status.ok() && !reconstruction.edges.empty()) {
    record.result.files.push_back("edges.ply");
    status = WriteEdges(folder / "edges.ply", reconstruction.edges);
  }
  if (!status.ok()) return status;
  record.stages.push_back(stopwatch.Read("write_files"));
  return {};
}

Status WriteReport(const Stopwatch& since_start,
                   const fs::path& folder,
                   ProgressPrinter& progress,
                   RunRecord& record) {
  record.result.files.push_back("report.json");
  record.total = since_start.Read("total");
  progress.Finish();
  return WriteFileAtomically(folder / "report.json", ReportJson(record));
}

}  // namespace curvix
