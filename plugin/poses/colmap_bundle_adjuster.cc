// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/colmap_bundle_adjuster.h"

#include <stdlib.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>

#include "base/cancelled.h"
#include "base/file_io.h"
#include "base/median.h"
#include "colmap/colmap_model.h"
#include "colmap/inconsistent_points.h"
#include "geometry/similarity.h"
#include "measuring/moved_curves.h"
#include "plugin/base/text.h"
#include "plugin/poses/adjustable_scene.h"
#include "plugin/poses/child_process.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Help is only printed.
constexpr double kHelpTimeoutS = 20;
// A step that lowers the cost by less, relative to it, is the last, as in
// Ceres. COLMAP's default is 0, which takes up to 100 steps.
constexpr char kFunctionTolerance[] = "0.000001";

// Where glog keeps a log of each run of COLMAP, in place of /tmp.
std::vector<std::string> LogsInto(const fs::path& folder) {
  return {"GLOG_log_dir=" + folder.string()};
}

constexpr char kHowToInstall[] =
    "install it ('apt install colmap' on Debian and Ubuntu, else "
    "https://colmap.github.io), or name it with --colmap_path";

// A folder of one's own for temporary files, which goes with its object.
class ScratchFolder {
 public:
  static Result<fs::path> Make() {
    std::error_code error;
    const fs::path given = fs::temp_directory_path(error);
    if (error) {
      return Status::InvalidArgument(
          "TMPDIR is not a folder; let it name one with room, or use "
          "--refiner none");
    }
    // COLMAP runs in it, so not relative to where this program runs.
    const fs::path parent = fs::absolute(given, error);
    std::string name = (parent / "colmap_curvix-XXXXXX").string();
    if (!error && mkdtemp(name.data()) != nullptr) return fs::path(name);
    return Status::InvalidArgument(
        "cannot make a temporary folder in " + parent.string() +
        "; let TMPDIR name one with room, or use --refiner none");
  }
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// COLMAP squares the errors: observations that are this many times the median
// off, of all views or of their own if that is larger, would pull at the poses.
constexpr double kOutlier = 5;

// By view, for `scene` with fitted points.
std::vector<double> LargestErrors(const Scene& scene) {
  std::vector<double> all;
  std::vector<std::vector<double>> by_view(scene.views.size());
  for (const ScenePoint& point : scene.points) {
    const std::vector<double> errors = ReprojectionErrors(scene, point);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      all.push_back(errors[i]);
      by_view[static_cast<std::size_t>(point.view_idxs[i])].push_back(
          errors[i]);
    }
  }
  const double median = MedianOrNan(std::move(all));
  std::vector<double> largest;
  for (std::vector<double>& errors : by_view) {
    largest.push_back(kOutlier *
                      std::max(median, MedianOr(median, std::move(errors))));
  }
  return largest;
}

// The points of `scene` fitted to its poses, without outliers; those that two
// views no longer see have no observation.
std::vector<ScenePoint> WithoutOutliers(Scene scene) {
  FitPoints(&scene);
  const std::vector<double> largest = LargestErrors(scene);
  for (ScenePoint& point : scene.points) {
    const std::vector<double> errors = ReprojectionErrors(scene, point);
    KeepObservations(
        [&](std::size_t i) {
          const auto view_idx = static_cast<std::size_t>(point.view_idxs[i]);
          return errors[i] <= largest[view_idx];
        },
        &point);
    if (point.pixels.size() < 2) {
      KeepObservations([](std::size_t) { return false; }, &point);
    }
  }
  return std::move(scene.points);
}

// `scene` moved so that its cameras are about the origin. Far from it, as in a
// world of map coordinates, COLMAP ends too early: Ceres compares steps with
// the size of the unknowns.
Scene AboutOrigin(Scene scene) {
  Similarity3 move;
  for (int i = 0; i < 3; ++i) {
    std::vector<double> coordinates;
    for (const View& view : scene.views) {
      coordinates.push_back(view.cam_from_world.Inverse().translation[i]);
    }
    move.translation[i] = -MedianOr(0, std::move(coordinates));
  }
  return MoveScene(move, std::move(scene));
}

// What is written for COLMAP: ids are indices + 1 and names are ids, whatever
// those of the user's model are.
ColmapModel ModelForColmap(Scene scene) {
  scene.points = WithoutOutliers(scene);
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    scene.views[i].image_id = static_cast<std::uint32_t>(i + 1);
    scene.views[i].name = std::to_string(i + 1);
  }
  ColmapModel model = ModelOfScene(scene);
  std::erase_if(model.points, [](const auto& p) { return p.track.empty(); });
  return model;
}

// What COLMAP made of `scene`.
Result<BundleAdjustment> AdjustmentIn(const fs::path& folder,
                                      const Scene& scene,
                                      const std::string& version) {
  if (!FindColmapFormat(folder).ok())
    return Status::ExternalTool("it wrote no model");
  const Result<ColmapModel> model = ReadColmapModel(folder);
  if (!model.ok()) {
    // The folder is gone when this is read.
    std::string reason = model.status().message();
    const std::string path = folder.string() + "/";
    for (std::size_t at; (at = reason.find(path)) != std::string::npos;) {
      reason.erase(at, path.size());
    }
    return Status::ExternalTool("it wrote a model that cannot be read: " +
                                reason);
  }
  BundleAdjustment adjustment;
  adjustment.program_version = version;
  bool same = model->images.size() == scene.views.size() &&
              model->cameras.size() == scene.cameras.size();
  for (std::size_t i = 0; same && i < scene.views.size(); ++i) {
    const ColmapImage& image = model->images[i];
    const int camera_id = scene.views[i].camera_idx + 1;
    same = image.image_id == i + 1 && image.name == std::to_string(i + 1) &&
           static_cast<int>(image.camera_id) == camera_id;
    adjustment.cam_from_world.push_back(image.cam_from_world);
  }
  for (std::size_t i = 0; same && i < scene.cameras.size(); ++i) {
    const ColmapCamera& item = model->cameras[i];
    const Camera& camera = scene.cameras[i];
    same = item.camera_id == i + 1 && item.camera.model == camera.model &&
           item.camera.width == camera.width &&
           item.camera.height == camera.height;
  }
  if (!same) {
    return Status::ExternalTool(
        "its model has other images or cameras than it got");
  }
  for (const ScenePoint& point : scene.points) {
    adjustment.positions.push_back(point.position);
  }
  for (const ColmapPoint3D& point : model->points) {
    if (point.point3D_id == 0 || point.point3D_id > scene.points.size()) {
      continue;
    }
    adjustment.positions[point.point3D_id - 1] = point.position;
  }
  return adjustment;
}

// At most its first `num_bytes`.
std::string BeginningOf(const fs::path& path, std::size_t num_bytes) {
  std::ifstream file(path, std::ios::binary);
  return ReadUpTo(file, num_bytes);
}

// The newest camera model of `scene`, if the log says that COLMAP does not know
// one; else empty. Models are numbered in the order in which COLMAP got them.
std::string UnknownModel(const Scene& scene, const fs::path& log_path) {
  constexpr std::size_t kMaxLogBytes = 100000;
  const std::string log = BeginningOf(log_path, kMaxLogBytes);
  CameraModel newest = CameraModel::kSimplePinhole;
  for (const Camera& camera : scene.cameras) {
    newest = std::max(newest, camera.model);
  }
  for (const char* const words :
       {"ExistsCameraModelWithId", "Camera model does not exist"}) {
    if (log.find(words) != log.npos) return std::string(ModelName(newest));
  }
  return {};
}

// Fails unless COLMAP came to its own end, successfully.
Status CheckEnd(const ChildEnd& end, double timeout_s) {
  switch (end.kind) {
    case ChildEnd::Kind::kStopped:
      return CancelledStatus();
    case ChildEnd::Kind::kTimedOut:
      return Status::ExternalTool("it was not done after " +
                                  DurationText(timeout_s) +
                                  " (--refiner_timeout_s)");
    case ChildEnd::Kind::kKilled:
      return Status::ExternalTool("it was ended by signal " +
                                  std::to_string(end.code));
    case ChildEnd::Kind::kExited:
      break;
  }
  if (end.code == 0) return {};
  return Status::ExternalTool("it ended with exit code " +
                              std::to_string(end.code));
}

// What COLMAP prints when it is called with `arguments`, which ask for help.
// Temporary files go to `folder`.
Result<std::string> ColmapHelp(const std::vector<std::string>& arguments,
                               const ColmapRun& run,
                               const fs::path& folder,
                               const KeepGoing& keep_going) {
  const fs::path text_path = folder / "help.txt";
  const double timeout_s = std::min(run.timeout_s, kHelpTimeoutS);
  CURVIX_ASSIGN_OR_RETURN(const ChildEnd end,
                          RunChildProcess({run.program,
                                           arguments,
                                           folder,
                                           text_path,
                                           timeout_s,
                                           keep_going,
                                           LogsInto(folder)}));
  if (end.kind == ChildEnd::Kind::kStopped) return CancelledStatus();
  if (end.kind == ChildEnd::Kind::kTimedOut) {
    return Status::ExternalTool("its help was not done after " +
                                DurationText(timeout_s));
  }
  constexpr std::size_t kMaxHelpBytes = 100000;
  return BeginningOf(text_path, kMaxHelpBytes);
}

// "3.8"; "unknown" if `help` is not COLMAP's.
std::string VersionIn(const std::string& help) {
  static const std::regex kBanner(R"(^COLMAP (\d+\.\d+[^ ]{0,20}))");
  constexpr int kMaxBannerLine = 50;
  std::istringstream text(help);
  std::string line;
  for (int i = 0; i < kMaxBannerLine && std::getline(text, line); ++i) {
    std::smatch match;
    line.resize(std::min<std::size_t>(line.size(), 200));
    if (std::regex_search(line, match, kBanner)) return match[1].str();
  }
  return "unknown";
}

// The name of the option for kFunctionTolerance, which COLMAP 4 renamed; empty
// if the help knows neither name.
std::string FunctionToleranceOption(const std::string& help) {
  for (const char* const name :
       {"--BundleAdjustment.function_tolerance",
        "--BundleAdjustmentCeres.function_tolerance"}) {
    if (help.find(name) != std::string::npos) return name;
  }
  return {};
}

std::vector<std::string> BundleAdjusterArguments(
    const fs::path& input,
    const fs::path& output,
    const std::string& tolerance_option) {
  std::vector<std::string> arguments = {
      "bundle_adjuster",
      "--input_path",
      input.string(),
      "--output_path",
      output.string(),
      "--BundleAdjustment.refine_focal_length",
      "0",
      "--BundleAdjustment.refine_principal_point",
      "0",
      "--BundleAdjustment.refine_extra_params",
      "0"};
  if (!tolerance_option.empty()) {
    arguments.insert(arguments.end(), {tolerance_option, kFunctionTolerance});
  }
  return arguments;
}

}  // namespace

Result<fs::path> FindColmap(const fs::path& given) {
  if (!given.empty()) {
    if (IsProgram(given)) return fs::absolute(given);
    return Status::NotFound("--colmap_path " + given.string() +
                            " is not a program; " + kHowToInstall);
  }
  if (const char* const folder = std::getenv("COLMAP_EXE_PATH")) {
    fs::path program = fs::absolute(fs::path(folder) / "colmap");
    if (IsProgram(program)) return program;
  }
  fs::path program = FindInPath("colmap");
  if (!program.empty()) return program;
  return Status::NotFound(std::string("COLMAP is not installed; ") +
                          kHowToInstall);
}

Result<BundleAdjustment> RefineWithColmap(const Scene& in_world,
                                          const ColmapRun& run,
                                          const KeepGoing& keep_going,
                                          std::string* version) {
  CURVIX_ASSIGN_OR_RETURN(const fs::path made, ScratchFolder::Make());
  const ScratchFolder scratch(made);
  const Scene scene = AboutOrigin(in_world);
  CURVIX_ASSIGN_OR_RETURN(
      const std::string general,
      ColmapHelp({"help"}, run, scratch.path(), keep_going));
  *version = VersionIn(general);
  const Result<std::string> help = ColmapHelp(
      {"bundle_adjuster", "--help"}, run, scratch.path(), keep_going);
  if (!help.ok() && help.status().code() == StatusCode::kCancelled) {
    return help.status();
  }
  const std::string tolerance_option =
      help.ok() ? FunctionToleranceOption(*help) : "";
  const fs::path input = scratch.path() / "input";
  const fs::path output = scratch.path() / "output";
  std::error_code error;
  fs::create_directory(output, error);
  CURVIX_RETURN_IF_ERROR(WriteColmapModel(ModelForColmap(scene), input));
  CURVIX_ASSIGN_OR_RETURN(
      const ChildEnd end,
      RunChildProcess({run.program,
                       BundleAdjusterArguments(input, output, tolerance_option),
                       scratch.path(),
                       run.log_path,
                       run.timeout_s,
                       keep_going,
                       LogsInto(scratch.path())}));
  Status ended = CheckEnd(end, run.timeout_s);
  if (ended.code() == StatusCode::kExternalTool) {
    const std::string model = UnknownModel(scene, run.log_path);
    if (!model.empty()) {
      return Status::ExternalTool("it does not know the camera model " + model +
                                  "; a newer COLMAP may");
    }
  }
  if (!ended.ok()) return ended;
  return AdjustmentIn(output, scene, *version);
}

}  // namespace curvix
