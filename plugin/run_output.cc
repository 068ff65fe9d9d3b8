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
                       const CurveSource& curves,
                       const fs::path& folder,
                       RunRecord& record) {
  const Stopwatch stopwatch;
  const int num_threads = record.settings.options.runtime.num_threads;
  const FittedCurves fitted = FitCurves(
      curves, scene, record.settings.options.curve_fitting, num_threads);
  if (!curves.status().ok()) return curves.status();
  record.stages.push_back(stopwatch.Read("fit_curves"));
  record.stages.back().counts = CountFits(fitted);
  Result<std::vector<std::string>> written = WriteResults(
      {scene, curves, fitted}, record.settings.output, num_threads, folder);
  if (!written.ok()) return written.status();
  std::vector<std::string>& files = record.result.files;
  files.insert(files.end(), written->begin(), written->end());
  files.push_back("project.ini");
  return WriteFileAtomically(folder / "project.ini",
                             ProjectFile(record.settings));
}

}  // namespace

Status WriteFindings(const Scene& scene,
                     const Findings& findings,
                     const fs::path& folder,
                     RunRecord& record) {
  const Stopwatch stopwatch;
  ResultSummary& result = record.result;
  findings.curves.ForEach(
      [&](std::size_t, const Curve& curve) { Count(curve, result); });
  result.num_edges_3d = findings.num_edges_3d;
  result.why_empty = findings.why_empty;
  Status status = findings.curves.status();
  if (status.ok() && result.num_curves > 0) {
    status = WriteCurveFiles(scene, findings.curves, folder, record);
  }
  if (status.ok() && result.num_edges_3d > 0) {
    result.files.push_back("edges.ply");
    status = findings.write_edges(folder / "edges.ply");
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
