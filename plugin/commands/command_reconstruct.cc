// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <utility>

#include "base/count_text.h"
#include "plugin/commands/commands.h"
#include "plugin/run/run_parts.h"
#include "plugin/run/run_workspace.h"

namespace curvix {
namespace {

// Replaces the options, threads apart: comes before the flags of the table.
Flag PresetFlag(RunSettings* settings) {
  Flag flag = ChoiceFlag("preset",
                         {"default", "paper"},
                         &settings->preset,
                         "values that the options below start from: the best "
                         "known, or the method of the paper throughout");
  flag.set = [settings, choose = flag.set](const std::string& text) -> Status {
    CURVIX_RETURN_IF_ERROR(choose(text));
    const RuntimeOptions runtime = settings->options.runtime;
    settings->options = text == "paper" ? PaperOptions() : Options();
    settings->poses.refiner = text == "paper" ? "none" : "colmap";
    settings->poses.refine_poses_with_curves = text != "paper";
    settings->options.runtime = runtime;
    return Status();
  };
  return flag;
}

constexpr int kNoPart = -1;

// A part without curves is as good as any.
Result<ExitCode> ReconstructPart(const RunSettings& settings, int part_idx) {
  const Status valid = Validate(settings.options);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_ASSIGN_OR_RETURN(const RunRecord record,
                          WithProgress([&](RunProgress& progress) {
                            return RunPart(settings, part_idx, progress);
                          }));
  const ResultSummary& result = record.result;
  std::cout << "\npart " << part_idx << ": "
            << Plural(result.num_curves, "curve");
  if (result.num_curves == 0) std::cout << " (" << result.why_empty << ")";
  std::cout << ", in " << result.output_path.string() << "\n";
  return kExitSuccess;
}

}  // namespace

Result<ExitCode> RunAndSummarize(const RunSettings& settings, const Job& job) {
  const Status valid = Validate(settings.options);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_ASSIGN_OR_RETURN(const RunRecord record, WithProgress(job));
  const bool is_empty = record.result.num_curves == 0;
  (is_empty ? std::cerr : std::cout) << "\n" << SummaryText(record);
  return is_empty ? kExitNoCurves : kExitSuccess;
}

FlagSection PathsSection(RunSettings* settings) {
  return {"Paths",
          {Required(PathFlag("workspace_path",
                             &settings->workspace_path,
                             "folder with sparse/ and images/, or dense/")),
           PathFlag("input_path",
                    &settings->input_path,
                    "folder of the model, or of models 0, 1, ...; default: "
                    "that of sparse/<k> with most images, sparse or "
                    "dense/0/sparse"),
           PathFlag("image_path",
                    &settings->image_path,
                    "folder of the images; default: for align and draw that "
                    "of the run before, else images/ beside the model"),
           PathFlag("output_path",
                    &settings->output_path,
                    "folder of the results; default: curvix/0 beside "
                    "sparse/0"),
           PathFlag("mask_path",
                    &settings->mask_path,
                    "folder of masks as COLMAP's, <image name>.png: edges on "
                    "black do not count")}};
}

FlagSection RuntimeSection(RunSettings* settings) {
  return OptionSections(settings->options).back();
}

std::vector<FlagSection> ReconstructSections(RunSettings* settings) {
  std::vector<FlagSection> sections = {PathsSection(settings),
                                       {"Method", {PresetFlag(settings)}},
                                       PoseRefinementFlags(&settings->poses),
                                       OutputFlags(&settings->output)};
  sections.front().flags.push_back(
      Switch("clean",
             &settings->clean,
             "ignore and delete stages/ in the folder of the results, and "
             "write none"));
  for (FlagSection& section : OptionSections(settings->options)) {
    sections.push_back(std::move(section));
  }
  return sections;
}

Result<ExitCode> RunReconstruct(const Arguments& arguments) {
  int part_idx = kNoPart;
  RunSettings settings;
  std::vector<FlagSection> sections = ReconstructSections(&settings);
  sections.front().flags.push_back(
      RowFlag({.name = "part",
               .field = &part_idx,
               .min = kNoPart,
               .max = 1000000,
               .help = "reconstruct this part of a scene that 'partition' has "
                       "divided, with the poses as they are; -1: no parts"}));
  const std::optional<ExitCode> code =
      ParseCommand("reconstruct", arguments, std::move(sections));
  if (code) return *code;
  if (part_idx != kNoPart) {
    return ReconstructPart(settings, part_idx);
  }
  return RunAndSummarize(
      settings, [&](RunProgress& progress) -> Result<RunRecord> {
        CURVIX_ASSIGN_OR_RETURN(WorkspaceRun run,
                                RunWorkspace(settings, progress));
        return std::move(run.record);
      });
}

Result<ExitCode> RunPartitionCommand(const Arguments& arguments) {
  RunSettings settings;
  int max_views_per_part = 150;
  const std::optional<ExitCode> code = ParseCommand(
      "partition",
      arguments,
      {PathsSection(&settings),
       {"Parts",
        {RowFlag({.name = "max_views_per_part",
                  .field = &max_views_per_part,
                  .min = 3,
                  .max = 1000000,
                  .help = "most images that a part is reconstructed from, "
                          "those around it included"})}}});
  if (code) return *code;
  CURVIX_ASSIGN_OR_RETURN(
      const ScenePartition partition, WithProgress([&](RunProgress& progress) {
        return RunPartition(settings, max_views_per_part, progress);
      }));
  for (std::size_t i = 0; i < partition.parts.size(); ++i) {
    const ScenePart& part = partition.parts[i];
    std::cout << "part " << i << ": " << Plural(part.view_idxs.size(), "view")
              << ", " << part.own_view_idxs.size() << " of its own\n";
  }
  std::cout << "Next, for each part: colmap_curvix reconstruct --part K, then "
               "colmap_curvix merge, with the same paths and options"
            << std::endl;
  return kExitSuccess;
}

Result<ExitCode> RunMergeCommand(const Arguments& arguments) {
  RunSettings settings;
  std::vector<FlagSection> sections = ReconstructSections(&settings);
  // Merges get the options of their parts, of which those of poses have no use.
  for (FlagSection& section : sections) {
    if (section.title != "Poses") continue;
    for (Flag& flag : section.flags) flag.is_advanced = true;
  }
  const std::optional<ExitCode> code =
      ParseCommand("merge", arguments, std::move(sections));
  if (code) return *code;
  return RunAndSummarize(settings, [&](RunProgress& progress) {
    return RunMerge(settings, progress);
  });
}

}  // namespace curvix
