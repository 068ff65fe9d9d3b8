// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/command_synthesize.h"

#include <curvix/scene.h>
#include <algorithm>
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "base/cancelled.h"
#include "base/check.h"
#include "base/count_text.h"
#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/colmap_model.h"
#include "plugin/base/image_file.h"
#include "plugin/base/progress.h"
#include "plugin/base/staged_output.h"
#include "plugin/base/text.h"
#include "plugin/commands/commands.h"
#include "plugin/imports/new_workspace.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// With three channels, as photographs have them.
Status WriteImage(const SyntheticImage& image, const fs::path& path) {
  const cv::Mat grey = cv::Mat(image.pixels).reshape(1, image.height);
  cv::Mat bgr;
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  CURVIX_ASSIGN_OR_RETURN(const std::string png, EncodeImage(".png", bgr));
  return WriteFileAtomically(path, png);
}

std::string TruthText(const std::vector<TrueSample>& samples) {
  std::string text;
  for (const TrueSample& sample : samples) {
    for (const Eigen::Vector3d& vector : {sample.position, sample.tangent}) {
      AppendNumbers(vector, ' ', text);
      text += ' ';
    }
    text += std::to_string(sample.curve_id) + ' ' +
            std::to_string(sample.num_views_seen) + ' ' +
            std::to_string(sample.num_views_edge) + ' ' +
            std::to_string(static_cast<int>(sample.kind)) + '\n';
  }
  return text;
}

struct SynthesizeSettings {
  std::filesystem::path workspace_path;
  int seed = 1;
  SyntheticOptions options;
};

// In the order of CameraModel.
std::vector<std::string> CameraModels() {
  std::vector<std::string> names;
  for (int id = 0; const auto model = ModelFromId(id); ++id) {
    names.emplace_back(ModelName(*model));
  }
  return names;
}

std::vector<FlagSection> Sections(SynthesizeSettings* settings) {
  SyntheticOptions& o = settings->options;
  const std::vector<OptionRow> rows = OptionTable(o);
  const auto words = SplitAt(
      "block cylinder cone sphere part facade house table knobs room", ' ');
  const std::vector<std::string> solids(words.begin(), words.end());
  const auto row = [&](const char* name) {
    const auto found = std::ranges::find(rows, name, &OptionRow::name);
    CURVIX_CHECK(found != rows.end(), "no option " << name);
    return RowFlag(*found);
  };
  return {{"Scene",
           {Required(PathFlag("workspace_path",
                              &settings->workspace_path,
                              "folder to write: images/, sparse/0/, gt.txt")),
            EnumFlag("solid", solids, &o.solid, "what is shown"),
            EnumFlag("pattern",
                     {"none", "brick", "wood", "print", "mixed"},
                     &o.pattern,
                     "painted on it; mixed: on each piece what suits it"),
            row("shadows"),
            row("reflections"),
            row("scale"),
            RowFlag({.name = "seed",
                     .field = &settings->seed,
                     .help = "of the noise, the texture and the pose errors"}),
            row("num_threads")}},
          {"Images",
           {row("num_views"),
            row("width"),
            row("height"),
            row("noise"),
            row("texture")}},
          {"Cameras",
           {EnumFlag("camera_model",
                     CameraModels(),
                     &o.camera_model,
                     "COLMAP's name of the camera model"),
            RowFlag({.name = "distortion",
                     .field = &o.distortion,
                     .min = -0.5,
                     .max = 0.9,
                     .help = "first radial coefficient, where the model has "
                             "one"}),
            row("pose_error_px"),
            row("points_per_view")}}};
}

}  // namespace

Result<ExitCode> RunSynthesize(const Arguments& arguments) {
  SynthesizeSettings settings;
  const std::optional<ExitCode> code =
      ParseCommand("synthesize", arguments, Sections(&settings));
  if (code) return *code;
  settings.options.seed = static_cast<std::uint64_t>(settings.seed);
  const Status valid = Validate(settings.options);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_RETURN_IF_ERROR(Synthesize(settings.options,
                                    settings.workspace_path,
                                    [] { return !IsInterrupted(); }));
  const std::string path = settings.workspace_path.string();
  std::cout << "Wrote " << Plural(settings.options.num_views, "image")
            << " and their poses to " << path
            << "\nTry: colmap_curvix --workspace_path " << ShellWord(path)
            << std::endl;
  return kExitSuccess;
}

Status Synthesize(const SyntheticOptions& options,
                  const fs::path& workspace,
                  const std::function<bool()>& keep_going) {
  const std::vector<std::string> names = {"images", "sparse", "gt.txt"};
  for (const std::string& name : names) {
    CURVIX_RETURN_IF_ERROR(CheckUnused(workspace / name));
  }
  CURVIX_ASSIGN_OR_RETURN(const SyntheticScene scene,
                          MakeSyntheticScene(options, keep_going));

  CURVIX_ASSIGN_OR_RETURN(const StagedOutput staged,
                          StagedOutput::Create(workspace, "--workspace_path"));
  const fs::path& folder = staged.folder();
  std::error_code ignored;  // writing the images tells it
  fs::create_directory(folder / "images", ignored);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const fs::path path = folder / "images" / scene.scene.views[i].name;
    CURVIX_RETURN_IF_ERROR(WriteImage(scene.images[i], path));
    if (keep_going && !keep_going()) return CancelledStatus();
  }
  CURVIX_RETURN_IF_ERROR(
      WriteColmapModel(ModelOfScene(scene.scene), folder / "sparse" / "0"));
  CURVIX_RETURN_IF_ERROR(
      WriteFileAtomically(folder / "gt.txt", TruthText(scene.truth)));
  return MoveIntoWorkspace(names, folder, workspace);
}

}  // namespace curvix
