// SPDX-License-Identifier: BSD-3-Clause
// What a run did: report.json for programs, a summary for people, and the
// project file that repeats it.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "colmap/workspace.h"
#include "measuring/world_alignment.h"
#include "plugin/export/write_results.h"
#include "plugin/poses/curve_poses.h"
#include "plugin/poses/pose_refinement.h"

namespace curvix {

// "0.1.0".
std::string_view ProgramVersion();

// The line of a project file with the command that it repeats.
inline constexpr const char* kCommandName = "command";

// What the user asked for. Empty paths: found under the workspace.
struct RunSettings : WorkspacePaths {
  std::string command;  // "": reconstruct
  std::string preset = "default";
  PoseRefinementSettings poses;
  OutputSettings output;
  Options options;
  bool clean = false;  // neither use nor keep the results of stages
};

struct InputSummary {
  std::filesystem::path model_path;
  std::vector<std::string> camera_models;  // one per camera
  std::int64_t num_views = 0;
  std::int64_t num_points = 0;
  std::vector<std::string> missing_images;  // names of the views skipped
  std::vector<std::string> notes;           // sentences, as the run prints them
};

struct ResultSummary {
  std::filesystem::path output_path;
  std::int64_t num_edges_2d = 0;
  std::int64_t num_edges_3d = 0;
  double edge_sigma_px = 0;  // EdgeSketch::edge_sigma_px; 0: not known
  std::int64_t num_curves = 0;
  std::int64_t num_closed = 0;
  std::int64_t num_samples = 0;
  double total_length = 0;         // world units
  std::vector<std::string> files;  // names in output_path
  std::string why_empty;           // "" when there are curves
};

struct RunRecord {
  RunSettings settings;
  std::optional<WorldAlignment> alignment;  // of the files of the curves
  InputSummary input;
  PoseRefinementRecord poses;
  std::optional<CurvePoseRecord> curve_poses;  // if asked for
  std::vector<StageReport> stages;             // in the order in which they ran
  // The names of those whose results an earlier run had left.
  std::vector<std::string> resumed_stages;
  ResultSummary result;
  StageReport total;  // of the whole run
};

// The files and folders that the run before wrote into `folder`, by its
// report.json. None if there is no such report.
std::vector<std::filesystem::path> FilesOfEarlierRun(
    const std::filesystem::path& folder);

// The folder of the images of that run, by the same report: where it was from
// the workspace, which may have moved, else where it was. "": there is none.
std::filesystem::path ImagesOfEarlierRun(
    const std::filesystem::path& folder,
    const std::filesystem::path& workspace_path);

// Counts a curve in `result`, and adds its length.
void Count(const Curve& curve, ResultSummary& result);

// All curves, in the order of their ids; the rest is left for the caller.
ResultSummary SummarizeCurves(const CurveSet& curves);

// report.json, described in docs/output_format.md. Everything that differs
// between two runs of the same job (times, memory, threads) is under "run".
std::string ReportJson(const RunRecord& record);

// project.ini: every option as used; `--project_path` reads it back.
std::string ProjectFile(const RunSettings& settings);

// The closing words of a run. With curves: what was found, where it is and
// what opens it. Without: why, and what each stage counted.
std::string SummaryText(const RunRecord& record);

}  // namespace curvix
