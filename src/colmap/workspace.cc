// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/workspace.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "base/count_text.h"
#include "base/file_io.h"
#include "colmap/files.h"
#include "colmap/inconsistent_points.h"
#include "colmap/project_file.h"
#include "colmap/scale_to_images.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

bool IsModel(const fs::path& folder) { return FindColmapFormat(folder).ok(); }

// Absolute, without ".", ".." and trailing slashes. Links are kept: results
// belong beside the link that the user made.
fs::path Normalized(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

bool IsNumber(const std::string& name) {
  return !name.empty() && name.size() <= 9 &&
         name.find_first_not_of("0123456789") == std::string::npos;
}

// The sub-folders of `folder` that are named by numbers, in numerical order.
std::vector<fs::path> NumberedFolders(const fs::path& folder) {
  std::vector<fs::path> folders = EntriesOf(folder);
  std::erase_if(folders, [](const fs::path& path) {
    return !IsNumber(path.filename().string()) || !IsFolder(path);
  });
  std::ranges::stable_sort(folders, {}, [](const fs::path& path) {
    return std::stoi(path.filename().string());
  });
  return folders;
}

// " Tried: a, b."
std::string Tried(const std::vector<fs::path>& places) {
  std::string text = " Tried: ";
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += (i > 0 ? ", " : "") + places[i].string();
  }
  return text + ".";
}

Status MayNotBeRead(const fs::path& folder, const std::string& flag) {
  return Status::NotFound(folder.string() +
                          " may not be read (Permission denied); change its "
                          "permissions, or name another folder with " +
                          flag + ".");
}

// The folder beside whose sparse/ the model lies: what holds sparse/<k> or
// sparse; empty if the model lies in neither.
fs::path RootOfModel(const fs::path& model) {
  if (model.filename() == "sparse") return model.parent_path();
  const fs::path parent = model.parent_path();
  if (IsNumber(model.filename().string()) && parent.filename() == "sparse") {
    return parent.parent_path();
  }
  return {};
}

// Normalised paths from which images and results are found.
struct ModelPlace {
  fs::path workspace;
  fs::path model;
  fs::path root;  // RootOfModel
  bool inside;    // the model lies in the workspace, or is it

  ModelPlace(const fs::path& workspace_path, const fs::path& model_path)
      : workspace(Normalized(workspace_path)),
        model(Normalized(model_path)),
        root(RootOfModel(model)),
        inside(IsInside(model, workspace)) {}
};

// Folders without a model last, the others in the given order where they have
// as many images.
std::vector<fs::path> MostImagesFirst(const std::vector<fs::path>& folders) {
  if (folders.size() < 2) return folders;
  std::vector<std::pair<std::size_t, fs::path>> counted;
  counted.reserve(folders.size());
  for (const fs::path& folder : folders) {
    counted.emplace_back(CountColmapImages(folder), folder);
  }
  std::ranges::stable_sort(
      counted, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<fs::path> ordered;
  ordered.reserve(folders.size());
  for (auto& [count, folder] : counted) ordered.push_back(std::move(folder));
  return ordered;
}

std::vector<fs::path> ModelCandidates(const fs::path& workspace) {
  std::vector<fs::path> places =
      MostImagesFirst(NumberedFolders(workspace / "sparse"));
  if (places.empty()) places.push_back(workspace / "sparse" / "0");
  places.push_back(workspace / "sparse");
  std::vector<fs::path> dense = NumberedFolders(workspace / "dense");
  if (dense.empty()) dense.push_back(workspace / "dense" / "0");
  dense.push_back(workspace / "dense");
  for (const fs::path& folder : dense) places.push_back(folder / "sparse");
  places.push_back(workspace);
  return places;
}

// Of what --input_path names: a model, or a folder of numbered ones.
std::vector<fs::path> NamedCandidates(const fs::path& folder) {
  if (IsModel(folder)) return {folder};
  std::vector<fs::path> places = MostImagesFirst(NumberedFolders(folder));
  places.push_back(folder);
  return places;
}

// Names the numbered siblings of `model` that hold models too; empty: none.
std::string OtherModelsNote(const fs::path& model) {
  std::string names;
  for (const fs::path& other : NumberedFolders(model.parent_path())) {
    if (other == model || !IsModel(other)) continue;
    names += (names.empty() ? "" : ", ") + other.filename().string();
  }
  if (names.empty()) return "";
  return "Using the model " + model.string() + ", which has the most images (" +
         std::to_string(CountColmapImages(model)) +
         "); there are others beside it (" + names +
         "), which --input_path chooses.";
}

// The files of the model must not be links to places elsewhere.
Status CheckModelFiles(const fs::path& workspace, const fs::path& model) {
  for (const char* list : {"cameras", "images", "points3D"}) {
    for (const char* extension : {".bin", ".txt"}) {
      const fs::path file = model / (std::string(list) + extension);
      if (LiesIn(file, {workspace, model})) continue;
      return Status::NotFound(
          file.string() +
          " is a link that leads out of the workspace; copy the "
          "file, or name the model's folder with --input_path if "
          "the link is meant.");
    }
  }
  return {};
}

Status FindModel(const WorkspacePaths& paths, Workspace* found) {
  const bool is_named = !paths.input_path.empty();
  const fs::path& folder = is_named ? paths.input_path : paths.workspace_path;
  const std::vector<fs::path> places =
      is_named ? NamedCandidates(folder) : ModelCandidates(folder);
  const auto place = std::ranges::find_if(places, IsModel);
  if (place == places.end()) {
    for (const fs::path& tried : places) {
      if (!IsForbidden(tried / "cameras.bin")) continue;
      return MayNotBeRead(tried, "--input_path");
    }
    if (is_named) return FindColmapFormat(folder).status();
    return Status::NotFound(
        "No COLMAP model (cameras and images, as .bin or .txt) in " +
        paths.workspace_path.string() + "." + Tried(places) +
        " Name its folder with --input_path.");
  }
  found->model_path = *place;
  if (!is_named) CURVIX_RETURN_IF_ERROR(CheckModelFiles(folder, *place));
  if (*place != folder && IsNumber(place->filename().string())) {
    const std::string note = OtherModelsNote(*place);
    if (!note.empty()) found->notes.push_back(note);
  }
  return {};
}

// The value of image_path in the model's project.ini; empty if there is none.
fs::path ImagePathOfProject(const fs::path& model) {
  const Result<std::string> text = ReadFile(model / "project.ini");
  if (!text.ok()) return {};
  const auto entries = ParseProjectFile(*text);
  if (!entries.ok()) return {};
  const auto entry =
      std::ranges::find(*entries, "image_path", &ProjectEntry::name);
  return entry == entries->end() ? fs::path() : fs::path(entry->value);
}

std::vector<fs::path> ImageCandidates(const ModelPlace& place) {
  std::vector<fs::path> places;
  const auto add = [&](const fs::path& path) {
    if (std::ranges::find(places, path) == places.end()) places.push_back(path);
  };
  const bool below = place.inside && !place.root.empty() &&
                     IsInside(place.root, place.workspace) &&
                     place.root != place.workspace;
  if (!below) add(place.workspace / "images");
  if (!place.root.empty()) add(place.root / "images");
  const fs::path project = ImagePathOfProject(place.model);
  if (!project.empty()) {
    add(fs::absolute(project));
    add(place.workspace / project);
  }
  return places;
}

Status FindImages(const WorkspacePaths& paths, Workspace* found) {
  if (!paths.image_path.empty()) {
    found->image_path = paths.image_path;
    if (IsFolder(paths.image_path)) return {};
    return Status::NotFound("--image_path " + paths.image_path.string() +
                            " is not a folder; name the folder of the images.");
  }
  const std::vector<fs::path> places =
      ImageCandidates(ModelPlace(paths.workspace_path, found->model_path));
  const auto place = std::ranges::find_if(places, IsFolder);
  if (place == places.end()) {
    return Status::NotFound("No folder of images for the model " +
                            found->model_path.string() + "." + Tried(places) +
                            " Name it with --image_path.");
  }
  found->image_path = *place;
  return {};
}

// The folders of the results, if --output_path names no other: first that of
// the model, then the folder curvix/ that it is or is in.
std::array<fs::path, 2> ResultFolders(const WorkspacePaths& paths,
                                      const fs::path& model) {
  const ModelPlace place(paths.workspace_path, model);
  const bool beside =
      !place.root.empty() && (place.inside || paths.input_path.empty());
  const bool is_only = beside ? place.model.filename() == "sparse"
                              : place.model == place.workspace;
  const fs::path curvix = (beside ? place.root : place.workspace) / "curvix";
  return {is_only ? curvix : curvix / place.model.filename(), curvix};
}

// The names of the images that are not in `folder`, sorted.
std::vector<std::string> MissingImages(const ColmapModel& model,
                                       const fs::path& folder) {
  std::vector<std::string> missing;
  for (const ColmapImage& image : model.images) {
    if (!IsFile(ImageFile(folder, image.name))) missing.push_back(image.name);
  }
  std::ranges::sort(missing);
  return missing;
}

// "" if there is none. An image is no mask of itself.
fs::path MaskOf(const Workspace& workspace, const std::string& image_name) {
  const fs::path mask = ImageFile(workspace.mask_path, image_name + ".png");
  if (IsFile(mask)) return mask;
  const fs::path same_name = ImageFile(workspace.mask_path, image_name);
  if (same_name.extension() != ".png" || !IsFile(same_name)) return {};
  std::error_code error;
  const fs::path image = ImageFile(workspace.image_path, image_name);
  return fs::equivalent(same_name, image, error) ? fs::path() : same_name;
}

Status FindMasks(const WorkspacePaths& paths, Workspace* found) {
  if (paths.mask_path.empty()) return {};
  found->mask_path = fs::absolute(paths.mask_path);
  if (IsFolder(paths.mask_path)) return {};
  return Status::NotFound("--mask_path " + paths.mask_path.string() +
                          " is not a folder; name the folder of the masks.");
}

// Images without masks are used whole, which people should know.
void NoteMissingMasks(const Workspace& workspace, WorkspaceScene* result) {
  if (workspace.mask_path.empty()) return;
  std::vector<std::string> names;
  for (const View& view : result->scene.views) {
    if (view.mask_path.empty()) names.push_back(view.name);
  }
  if (names.empty()) return;
  result->notes.push_back(std::to_string(names.size()) + " of " +
                          std::to_string(result->scene.views.size()) +
                          " images " + OneOrMore(names.size(), "has", "have") +
                          " no mask in " + workspace.mask_path.string() +
                          " and " + OneOrMore(names.size(), "is", "are") +
                          " used whole: " + FirstNames(names) + ". That of " +
                          names.front() + " would be called " + names.front() +
                          ".png.");
}

constexpr std::size_t kMinViews = 3;

Status TooFewViews(const Workspace& workspace,
                   std::size_t num_views,
                   const std::vector<std::string>& missing) {
  if (missing.empty()) {
    return Status::InvalidArgument(
        "The model " + workspace.model_path.string() + " has " +
        Plural(num_views, "image") +
        ", and curves need at least three; register more images.");
  }
  if (IsForbidden(ImageFile(workspace.image_path, missing.front()))) {
    return MayNotBeRead(workspace.image_path, "--image_path");
  }
  return Status::NotFound(
      "Only " + std::to_string(num_views) + " of the " +
      Plural(num_views + missing.size(), "image") + " of the model " +
      workspace.model_path.string() +
      OneOrMore(num_views, " is in ", " are in ") +
      workspace.image_path.string() + " (missing: " + FirstNames(missing) +
      "), and curves need at least three. Name the right folder "
      "with --image_path.");
}

}  // namespace

Result<Workspace> FindModelAndResults(const WorkspacePaths& paths) {
  if (paths.workspace_path.empty()) {
    return Status::InvalidArgument(
        "The option --workspace_path is required but missing.");
  }
  if (!IsFolder(paths.workspace_path)) {
    return Status::NotFound(
        "--workspace_path " + paths.workspace_path.string() +
        " is not a folder; name the folder that holds sparse/ and "
        "images/.");
  }
  Workspace found;
  CURVIX_RETURN_IF_ERROR(FindModel(paths, &found));
  found.output_path = paths.output_path.empty()
                          ? ResultFolders(paths, found.model_path).front()
                          : paths.output_path;
  return found;
}

Result<Workspace> FindWorkspace(const WorkspacePaths& paths) {
  CURVIX_ASSIGN_OR_RETURN(Workspace found, FindModelAndResults(paths));
  CURVIX_RETURN_IF_ERROR(FindImages(paths, &found));
  CURVIX_RETURN_IF_ERROR(FindMasks(paths, &found));
  return found;
}

Status CheckNoLink(const fs::path& output_path) {
  std::error_code error;
  if (!fs::is_symlink(output_path, error)) return {};
  return Status::InvalidArgument(
      output_path.string() +
      " is a link, and the results would go where it leads; name that "
      "folder with --output_path if it is meant.");
}

Status CheckOutputLinks(const WorkspacePaths& paths, const Workspace& found) {
  if (!paths.output_path.empty()) return {};
  for (const fs::path& folder : ResultFolders(paths, found.model_path)) {
    CURVIX_RETURN_IF_ERROR(CheckNoLink(folder));
  }
  return {};
}

Result<WorkspaceScene> LoadWorkspaceScene(const Workspace& workspace) {
  WorkspaceScene result;
  CURVIX_ASSIGN_OR_RETURN(result.model, ReadColmapModel(workspace.model_path));
  const std::string scaled = ScaleToImages(workspace.image_path, &result.model);
  result.is_scaled = !scaled.empty();
  if (result.is_scaled) result.notes.push_back(scaled);
  result.missing_images = MissingImages(result.model, workspace.image_path);
  result.scene = MakeScene(workspace, result.model, result.missing_images);
  if (result.scene.views.size() < kMinViews) {
    return TooFewViews(
        workspace, result.scene.views.size(), result.missing_images);
  }
  if (!result.missing_images.empty()) {
    const std::string are =
        OneOrMore(result.missing_images.size(), "is", "are");
    result.notes.push_back(
        std::to_string(result.missing_images.size()) + " of " +
        Plural(result.model.images.size(), "image") + " " + are + " not in " +
        workspace.image_path.string() + " and " + are +
        " skipped: " + FirstNames(result.missing_images) + ".");
  }
  NoteMissingMasks(workspace, &result);
  const std::string removed =
      RemoveInconsistentPoints(workspace.model_path, &result.scene);
  if (!removed.empty()) result.notes.push_back(removed);
  return result;
}

Scene MakeScene(const Workspace& workspace,
                const ColmapModel& model,
                const std::vector<std::string>& left_out) {
  Scene scene = SceneFromColmapModel(model, workspace.image_path, left_out);
  if (workspace.mask_path.empty()) return scene;
  for (View& view : scene.views) {
    view.mask_path = MaskOf(workspace, view.name);
  }
  return scene;
}

}  // namespace curvix
