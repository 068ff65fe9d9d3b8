// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <string>
#include <utility>

#include "colmap/workspace.h"
#include "evaluation/evaluate.h"
#include "plugin/base/file_errors.h"
#include "plugin/commands/commands.h"
#include "plugin/commands/evaluations.h"
#include "plugin/export/alignment_file.h"

namespace curvix {
namespace {

struct EvaluateSettings {
  std::filesystem::path curves_path;
  std::filesystem::path truth_path;
  bool json = false;
  EvaluationOptions options;

  int holdout_every = 0;  // 0: compare with known curves
  RunSettings run;
};

FlagSection TruthSection(EvaluateSettings* settings) {
  EvaluationOptions& options = settings->options;
  return {
      "Against known curves",
      {PathFlag("curves_path",
                &settings->curves_path,
                "curves.txt, curves.obj or curves.ply; default: the first "
                "of them that a run has left in the workspace"),
       PathFlag("truth_path",
                &settings->truth_path,
                "the exact curves: gt.txt of synthesize, say"),
       Switch(
           "json", &settings->json, "print one JSON object instead of a table"),
       RowFlag({.name = "unit_mm",
                .field = &options.unit_mm,
                .min_is_excluded = true,
                .unit = "mm",
                .help = "length of a world unit; thresholds are 5, 10 and "
                        "20 mm"}),
       RowFlag({.name = "step",
                .field = &options.step,
                .min_is_excluded = true,
                .unit = "world units",
                .help = "distance of the samples compared"}),
       RowFlag({.name = "min_num_views",
                .field = &options.min_num_views,
                .help = "true samples count as visible if so many views "
                        "show an edge there"})}};
}

std::vector<FlagSection> Sections(EvaluateSettings* settings) {
  Flag every = RowFlag({.name = "holdout_every",
                        .field = &settings->holdout_every,
                        .min = 2,
                        .help = "reconstruct the workspace without one of N "
                                "views and look there for its curves, or for "
                                "those of --curves_path"});
  every.default_value = "";
  std::vector<FlagSection> sections = {
      TruthSection(settings),
      {"Against images held out, with a workspace", {std::move(every)}}};
  for (FlagSection& section : ReconstructSections(&settings->run)) {
    if (section.title == "Poses" || section.title == "Output") continue;
    for (Flag& flag : section.flags) flag.is_required = false;
    sections.push_back(std::move(section));
  }
  return sections;
}

// The curves with all digits, if they are there; curves.ply has 32-bit floats.
Result<std::filesystem::path> CurvesIn(const std::filesystem::path& folder) {
  for (const char* name : {"curves.txt", "curves.obj", "curves.ply"}) {
    if (std::filesystem::exists(folder / name)) return folder / name;
  }
  return Status::NotFound(
      "There is no curves.txt, curves.obj or curves.ply in " + folder.string() +
      "; run 'colmap_curvix reconstruct' first, with one of them among its "
      "--output_formats.");
}

Result<std::string> EvaluateWithTruth(const EvaluateSettings& settings) {
  std::filesystem::path curves_path = settings.curves_path;
  if (curves_path.empty()) {
    CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, CatchFileErrors([&] {
                              return FindWorkspace(settings.run);
                            }));
    CURVIX_ASSIGN_OR_RETURN(curves_path, CurvesIn(workspace.output_path));
  }
  if (std::filesystem::exists(curves_path.parent_path() / kAlignmentName)) {
    std::cerr << "The curves are in the frame of " << kAlignmentName
              << " beside them; so must be the known ones." << std::endl;
  }
  return EvaluateFiles(
      curves_path, settings.truth_path, settings.options, settings.json);
}

Result<std::string> EvaluateWorkspace(const EvaluateSettings& settings) {
  return WithProgress([&](RunProgress& progress) {
    return RunHoldout(settings.run,
                      settings.curves_path,
                      settings.holdout_every,
                      settings.json,
                      progress);
  });
}

}  // namespace

Result<ExitCode> RunEvaluate(const Arguments& arguments) {
  EvaluateSettings settings;
  const std::optional<ExitCode> code =
      ParseCommand("evaluate", arguments, Sections(&settings));
  if (code) return *code;
  const bool has_truth = !settings.truth_path.empty();
  const bool holds_out = settings.holdout_every > 0;
  const bool has_workspace = !settings.run.workspace_path.empty();
  const bool has_curves = has_workspace || !settings.curves_path.empty();
  if (has_truth == holds_out || !(has_truth ? has_curves : has_workspace)) {
    return Fail(Status::InvalidArgument(
                    "Give either --curves_path and --truth_path, or "
                    "--workspace_path with --truth_path or --holdout_every"),
                kExitCommandLine);
  }
  const Status valid = holds_out ? Validate(settings.run.options) : Status();
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_ASSIGN_OR_RETURN(
      const std::string text,
      holds_out ? EvaluateWorkspace(settings) : EvaluateWithTruth(settings));
  std::cout << text;
  return kExitSuccess;
}

}  // namespace curvix
