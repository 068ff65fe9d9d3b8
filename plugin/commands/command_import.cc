// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
#include <string>

#include "base/count_text.h"
#include "base/text_fields.h"
#include "colmap/workspace.h"
#include "plugin/base/progress.h"
#include "plugin/base/text.h"
#include "plugin/commands/commands.h"
#include "plugin/imports/importers.h"
#include "plugin/imports/new_workspace.h"
#include "plugin/imports/read_lines.h"
#include "plugin/run/run_workspace.h"

namespace curvix {
namespace {

struct Format {
  const char* name;
  Result<ImportedScene> (*import)(const ImportOptions& options);
};
constexpr std::array kFormats = {Format{"middlebury", ImportMiddlebury},
                                 Format{"dtu", ImportDtu},
                                 Format{"nerf", ImportNerf},
                                 Format{"colmap_images", ImportColmapImages}};

// Lines of other programs, in the world of a workspace.
struct LineFormat {
  const char* name;
  Result<std::vector<ImportedLine>> (*read)(const std::filesystem::path& path);
};
constexpr std::array kLineFormats = {LineFormat{"line3dpp", ReadLine3dppLines},
                                     LineFormat{"limap", ReadLimapLines}};

struct ImportSettings {
  RunSettings run;  // the workspace, and the results of lines
  std::string format;
  CopyPolicy copy_policy = CopyPolicy::kCopy;
  std::string first_pixel = "auto";
  ImportOptions options;
};

FlagSection DataSetFlags(ImportSettings* settings) {
  std::vector<std::string> formats;
  for (const Format& format : kFormats) formats.emplace_back(format.name);
  for (const LineFormat& format : kLineFormats) {
    formats.emplace_back(format.name);
  }
  return {"Data set",
          {Required(ChoiceFlag("format",
                               formats,
                               &settings->format,
                               "what --input_path is; docs/import.md explains "
                               "each")),
           Required(PathFlag("input_path",
                             &settings->options.input_path,
                             "the cameras, a file or its folder: *_par.txt, "
                             "cameras*.npz or pos_*.txt, transforms.json, a "
                             "COLMAP model; or the lines")),
           PathFlag("image_path",
                    &settings->options.image_path,
                    "the folder of the images; looked for around the "
                    "cameras if not given"),
           ChoiceFlag("first_pixel",
                      {"auto", "0", "0.5", "1"},
                      &settings->first_pixel,
                      "the coordinate of the centre of the first pixel in the "
                      "data set; auto: the convention of the format"),
           TextFlag("image_filter",
                    &settings->options.image_filter,
                    "dtu: only images whose names hold this text"),
           Switch("normalize",
                  &settings->options.normalize,
                  "dtu: the unit sphere of scale_mat instead of "
                  "millimetres")}};
}

FlagSection WorkspaceFlags(ImportSettings* settings) {
  return {"Workspace",
          {Required(PathFlag("workspace_path",
                             &settings->run.workspace_path,
                             "folder to write: images/ and sparse/0/; nothing "
                             "is overwritten; line3dpp, limap: the workspace "
                             "that the lines were made of, which stays")),
           EnumFlag("copy_policy",
                    {"copy", "soft-link", "hard-link"},
                    &settings->copy_policy,
                    "how images get there; those that are in images/ "
                    "already stay")}};
}

FlagSection ResultFlags(ImportSettings* settings) {
  FlagSection section = OutputFlags(&settings->run.output);
  section.title = "Results of line3dpp and limap";
  section.flags.insert(section.flags.begin(),
                       PathFlag("output_path",
                                &settings->run.output_path,
                                "folder of the results; default: line3dpp/ or "
                                "limap/ in the workspace"));
  return section;
}

Status CheckInput(const ImportSettings& settings) {
  std::error_code error;
  if (std::filesystem::exists(settings.options.input_path, error)) return {};
  return Status::NotFound(
      "--input_path " + settings.options.input_path.string() +
      " does not exist; name the cameras of the data set, or the lines");
}

bool IsOfLines(const std::string& format) {
  return std::ranges::find(kLineFormats, format, &LineFormat::name) !=
         kLineFormats.end();
}

// Options that the format does not know.
Status CheckOptions(const ImportSettings& settings) {
  const ImportOptions& options = settings.options;
  const std::string& format = settings.format;
  if (format == "colmap_images" && options.image_path.empty()) {
    return Status::InvalidArgument(
        "The option '--image_path' is required with --format colmap_images");
  }
  struct Row {
    bool is_given;
    bool is_known;
    const char* name;
  };
  for (const Row& row :
       {Row{options.normalize, format == "dtu", "--normalize"},
        Row{!options.image_filter.empty(), format == "dtu", "--image_filter"},
        Row{settings.first_pixel != "auto",
            format != "colmap_images" && !IsOfLines(format),
            "--first_pixel"},
        Row{settings.copy_policy != CopyPolicy::kCopy,
            !IsOfLines(format),
            "--copy_policy"},
        Row{!settings.run.output_path.empty(),
            IsOfLines(format),
            "--output_path"}}) {
    if (!row.is_given || row.is_known) continue;
    return Status::InvalidArgument(std::string(row.name) +
                                   " is not for --format " + format);
  }
  return {};
}

// Results would take the place of the lines.
Status CheckOutput(const ImportSettings& settings,
                   const std::filesystem::path& output_path) {
  std::error_code error;
  const auto output = std::filesystem::weakly_canonical(output_path, error);
  const auto input =
      std::filesystem::weakly_canonical(settings.options.input_path, error);
  const bool is_file = std::filesystem::is_regular_file(input, error);
  if (input != output && !(is_file && input.parent_path() == output)) return {};
  return Status::InvalidArgument(
      "The results would be written among the lines in " + output.string() +
      "; choose another folder with --output_path");
}

Result<ExitCode> ImportLines(const ImportSettings& settings,
                             const LineFormat& format) {
  RunSettings run = settings.run;
  run.image_path = settings.options.image_path;
  if (run.output_path.empty()) {
    run.output_path = run.workspace_path / format.name;
    CURVIX_RETURN_IF_ERROR(CheckNoLink(run.output_path));
  }
  CURVIX_RETURN_IF_ERROR(CheckOutput(settings, run.output_path));
  run.poses.refiner = "none";
  return RunAndSummarize(run, [&](RunProgress& progress) {
    return RunLines(
        run,
        [&] { return format.read(settings.options.input_path); },
        progress);
  });
}

Result<ExitCode> ImportDataSet(const ImportSettings& settings,
                               const Format& format) {
  CURVIX_RETURN_IF_ERROR(CheckUnused(settings.run.workspace_path / "sparse"));
  ImportOptions options = settings.options;
  if (settings.first_pixel != "auto") {
    options.first_pixel = ParseNumber<double>(settings.first_pixel);
  }
  CURVIX_ASSIGN_OR_RETURN(const ImportedScene scene, format.import(options));
  CURVIX_RETURN_IF_ERROR(WriteNewWorkspace(scene.model,
                                           scene.image_files,
                                           settings.copy_policy,
                                           settings.run.workspace_path,
                                           [] { return !IsInterrupted(); }));
  for (const std::string& note : scene.notes) std::cerr << note << std::endl;
  const std::string path = settings.run.workspace_path.string();
  std::cout << "Wrote " << Plural(std::ssize(scene.model.images), "image")
            << ", " << Plural(std::ssize(scene.model.cameras), "camera")
            << " and " << Plural(std::ssize(scene.model.points), "point")
            << " to " << path << "\nTry: colmap_curvix --workspace_path "
            << ShellWord(path) << std::endl;
  return kExitSuccess;
}

}  // namespace

Result<ExitCode> RunImport(const Arguments& arguments) {
  ImportSettings settings;
  const std::optional<ExitCode> code = ParseCommand("import",
                                                    arguments,
                                                    {DataSetFlags(&settings),
                                                     WorkspaceFlags(&settings),
                                                     ResultFlags(&settings)});
  if (code) return *code;
  const Status valid = CheckOptions(settings);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_RETURN_IF_ERROR(CheckInput(settings));
  for (const LineFormat& format : kLineFormats) {
    if (settings.format == format.name) return ImportLines(settings, format);
  }
  return ImportDataSet(
      settings, *std::ranges::find(kFormats, settings.format, &Format::name));
}

}  // namespace curvix
