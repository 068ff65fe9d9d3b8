// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_lines.h"

#include <curvix/curves.h>
#include <cstdint>
#include <string>

#include "base/count_text.h"
#include "base/stopwatch.h"
#include "plugin/base/staged_output.h"
#include "plugin/imports/read_lines.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

Result<LineCurves> ReadCurvesOfLines(
    const std::function<Result<std::vector<ImportedLine>>()>& read,
    const Scene& scene,
    ProgressPrinter& progress,
    RunRecord& record) {
  const Stopwatch stopwatch;
  progress.Update("read_lines", 0, 0);
  const Result<std::vector<ImportedLine>> lines = read();
  if (!lines.ok()) return lines.status();
  Result<LineCurves> curves = CurvesOfLines(*lines, scene);
  if (!curves.ok()) return curves;
  record.stages.push_back(stopwatch.Read("read_lines"));
  record.stages.back().counts = {
      {"lines", static_cast<std::int64_t>(lines->size())},
      {"left out", curves->num_left_out}};
  progress.Finish(Plural(lines->size(), "line"));
  if (curves->num_seen < static_cast<int>(lines->size()) / 2) {
    progress.Note("Only " + std::to_string(curves->num_seen) +
                  " of the lines " + OneOrMore(curves->num_seen, "is", "are") +
                  " seen by an image of the model. If they "
                  "were made of another model, name its workspace with "
                  "--workspace_path.");
  }
  if (curves->num_left_out > 0) {
    progress.Note("Left out " + Plural(curves->num_left_out, "line") +
                  " of length 0 or with an end too far away to be known.");
  }
  return curves;
}

}  // namespace

Result<RunRecord> RunLines(
    const RunSettings& settings,
    const std::function<Result<std::vector<ImportedLine>>()>& read,
    ProgressPrinter& progress) {
  const Stopwatch since_start;
  RunRecord record;
  record.settings = settings;
  const Result<Workspace> workspace = FindInput(settings);
  if (!workspace.ok()) return workspace.status();
  const Result<WorkspaceScene> input = ReadInput(*workspace, progress, record);
  if (!input.ok()) return input.status();
  Result<StagedOutput> output = StagedOutput::Create(workspace->output_path);
  if (!output.ok()) return output.status();
  const Result<LineCurves> lines =
      ReadCurvesOfLines(read, input->scene, progress, record);
  if (!lines.ok()) return lines.status();
  const CurvesInMemory curves(lines->curves, &lines->edge_maps);
  Findings findings{curves};
  findings.is_repeatable = false;
  if (curves.size() == 0) findings.why_empty = "all lines were left out";
  Status status =
      WriteFindings(input->scene, findings, output->folder(), record).status();
  if (status.ok()) {
    status = FinishRun(since_start, *output, progress, record);
  }
  if (!status.ok()) return status;
  return record;
}

}  // namespace curvix
