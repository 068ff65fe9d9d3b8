// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/file_io.h"
#include "plugin/align/align_workspace.h"
#include "plugin/align/marker_detector.h"
#include "plugin/base/file_errors.h"
#include "plugin/base/progress.h"
#include "plugin/commands/commands.h"
#include "plugin/export/alignment_file.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// "--distance 3 7 1.25 --distance 4 9 2" as one flag with one value, "3 7
// 1.25;4 9 2": the words that follow it up to the next flag.
Arguments WithDistancesJoined(const Arguments& arguments) {
  constexpr char kWithValue[] = "--distance=";
  Arguments joined;
  std::string distances;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& flag = arguments[i];
    if (flag != "--distance" && !flag.starts_with(kWithValue)) {
      joined.push_back(flag);
      continue;
    }
    std::string words =
        flag.substr(std::min(flag.size(), std::size(kWithValue) - 1));
    while (i + 1 < arguments.size() && !arguments[i + 1].starts_with("--")) {
      words += (words.empty() ? "" : " ") + arguments[++i];
    }
    if (words.empty()) words = "\"\"";
    distances += (distances.empty() ? "" : ";") + words;
  }
  if (!distances.empty()) joined.push_back(kWithValue + distances);
  return joined;
}

Flag MarkersFlag(AlignSettings* settings) {
  Flag flag = ChoiceFlag("markers",
                         MarkerDictionaries(),
                         &settings->markers,
                         "dictionary of the square markers in the images");
  if (!flag.range.empty()) return flag;
  flag.set = [](const std::string&) {
    return Status::InvalidArgument(
        "This program was built without OpenCV's aruco module, so that it "
        "finds no markers");
  };
  return flag;
}

std::vector<FlagSection> Sections(AlignSettings* s, bool* write_results) {
  std::vector<FlagSection> sections = {PathsSection(&s->run)};
  sections.push_back(
      {"Known",
       {TextFlag(
            "distance",
            &s->distances,
            "two nodes (by number) or points (x,y,z, in the present "
            "coordinates of curves.json) and how far apart they are: A B "
            "1.250, or A B 1.250 0.001 with a standard deviation; may be given "
            "several times"),
        MarkersFlag(s),
        RowFlag({.name = "marker_size",
                 .field = &s->marker_size,
                 .help = "side of their black squares"}),
        PathFlag("positions",
                 &s->positions_path,
                 "file with lines 'image_name x y z' or 'image_name x y z "
                 "sigma': where cameras are"),
        TextFlag(
            "epsg", &s->epsg, "EPSG number of the positions; sets --unit m"),
        ChoiceFlag("axes",
                   {"none", "auto"},
                   &s->axes,
                   "auto: z up and two horizontals along most lines"),
        TextFlag("up",
                 &s->up,
                 "x,y,z: where up is, roughly, in the present coordinates of "
                 "curves.json; default: up in the images")}});
  sections.push_back(
      {"Output",
       {ChoiceFlag("unit",
                   {"none", "mm", "cm", "m", "in", "ft"},
                   &s->unit,
                   "what lengths, sizes and positions are in"),
        RowFlag({.name = "write_results",
                 .field = write_results,
                 .help = "write the results again, in the new frame"})}});
  sections.push_back(RuntimeSection(&s->run));
  return sections;
}

// The run that wrote the results, once more, by the command that project.ini
// names and with the paths that are given: it goes on from its stages.
ExitCode WriteResultsAgain(const AlignSettings& settings,
                           const Workspace& workspace) {
  const fs::path& folder = workspace.output_path;
  if (!settings.run_follows) {
    std::cout << (fs::exists(folder / "report.json")
                      ? "Repeat the 'colmap_curvix import' that wrote the "
                        "results: it uses it.\n"
                      : "The next run of 'colmap_curvix reconstruct' uses "
                        "it.\n");
    return kExitSuccess;
  }
  Arguments again;
  for (const auto& [name, path] :
       {std::pair("--project_path", folder / "project.ini"),
        {"--workspace_path", settings.run.workspace_path},
        {"--input_path", settings.run.input_path},
        {"--image_path", workspace.image_path},
        {"--mask_path", settings.run.mask_path},
        {"--output_path", folder}}) {
    if (!path.empty()) again.insert(again.end(), {name, path.string()});
  }
  const int num_threads = settings.run.options.runtime.num_threads;
  if (num_threads != RuntimeOptions().num_threads) {
    again.insert(again.end(), {"--num_threads", std::to_string(num_threads)});
  }
  return RunProgram(again);
}

// Brings the older alignment back, if any, unless the new one is kept: one that
// the results do not have would mislead.
struct AlignmentGuard {
  fs::path path;
  std::optional<std::string> older;
  bool is_kept = false;

  ~AlignmentGuard() {
    if (is_kept) return;
    std::error_code error;
    if (older) {
      if (!WriteFileAtomically(path, *older).ok()) {
        error = std::make_error_code(std::errc::io_error);
      }
    } else {
      fs::remove(path, error);
    }
    std::cerr << path.string()
              << (error ? " is not that of the results; remove it.\n"
                        : " is as it was before.\n");
  }
};

}  // namespace

Result<ExitCode> RunAlign(const Arguments& arguments) {
  AlignSettings settings;
  bool write_results = true;
  const std::optional<ExitCode> code =
      ParseCommand("align",
                   WithDistancesJoined(arguments),
                   Sections(&settings, &write_results));
  if (code) return *code;
  const Status valid = Check(settings);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, CatchFileErrors([&] {
                            return FindInputOfResults(settings.run);
                          }));
  const fs::path path = workspace.output_path / kAlignmentName;
  std::optional<std::string> older;
  std::error_code error;
  if (fs::exists(path, error)) {
    CURVIX_ASSIGN_OR_RETURN(older, ReadFile(path));
  }
  settings.run_follows =
      write_results && fs::exists(workspace.output_path / "project.ini", error);
  CURVIX_ASSIGN_OR_RETURN(const std::string text,
                          WithProgress([&](RunProgress& progress) {
                            return AlignWorkspace(settings, progress);
                          }));
  std::cout << text << std::flush;
  if (!write_results) return kExitSuccess;
  AlignmentGuard guard{path, std::move(older)};
  const ExitCode written = WriteResultsAgain(settings, workspace);
  guard.is_kept = written == kExitSuccess;
  return written;
}

}  // namespace curvix
