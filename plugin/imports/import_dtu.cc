// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/importers.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "plugin/imports/npy.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// A projection matrix and the image that it belongs to.
struct DtuView {
  std::string source;  // "world_mat_3", "pos_004.txt"
  Matrix34d projection;
  std::string image;
};

using Projections = std::map<int, Matrix34d>;  // by the number in the name

Status BrokenDtu(const std::string& what) {
  return Status::DataLoss(what + "; download it again.");
}

// The number in `name` between `prefix` and `suffix`; nullopt: another name.
std::optional<int> NumberIn(std::string_view name,
                            std::string_view prefix,
                            std::string_view suffix) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
  if (name.size() < prefix.size() + suffix.size()) return std::nullopt;
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  if (name.find_first_not_of("0123456789") != name.npos) return std::nullopt;
  return ParseNumber<int>(name);
}

// The first run of digits: 7 in "rect_007_3_r5000.png".
std::optional<int> FirstNumber(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t begin = name.find_first_of(kDigits);
  if (begin == name.npos) return std::nullopt;
  name.remove_prefix(begin);
  return ParseNumber<int>(name.substr(0, name.find_first_not_of(kDigits)));
}

Result<Projections> ReadNpzProjections(const fs::path& file, bool normalize) {
  const Result<std::map<std::string, Eigen::Matrix4d>> matrices =
      ReadNpz(file, [&](const std::string& name) {
        return NumberIn(name, "world_mat_", "") ||
               (normalize && NumberIn(name, "scale_mat_", ""));
      });
  if (!matrices.ok()) return matrices.status();
  Projections projections;
  for (const auto& [name, matrix] : *matrices) {
    const std::optional<int> number = NumberIn(name, "world_mat_", "");
    if (!number) continue;
    Eigen::Matrix4d world = matrix;
    if (normalize) {
      const std::string scale_name = "scale_mat_" + std::to_string(*number);
      const auto scale = matrices->find(scale_name);
      if (scale == matrices->end()) {
        return BrokenDtu("There is no " + scale_name + " of " + file.string());
      }
      world *= scale->second;
    }
    projections[*number] = world.topRows<3>();
  }
  if (projections.empty()) {
    return BrokenDtu(file.string() + " has no world_mat_0");
  }
  return projections;
}

Result<Matrix34d> ReadPos(const fs::path& file) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(file));
  WordReader words(WithoutByteOrderMark(text));
  Matrix34d projection;
  for (int i = 0; i < 12; ++i) {
    projection(i / 4, i % 4) = words.Number<double>();
  }
  if (words.failed()) {
    return BrokenDtu(file.string() + " does not hold 3 x 4 numbers");
  }
  if (words.AtEnd()) return projection;
  return BrokenDtu(file.string() + " holds more than 3 x 4 numbers");
}

Result<Projections> ReadPosFolder(const fs::path& folder) {
  Projections projections;
  for (const fs::path& file : EntriesOf(folder)) {
    const auto number = NumberIn(file.filename().string(), "pos_", ".txt");
    if (!number) continue;
    CURVIX_ASSIGN_OR_RETURN(projections[*number], ReadPos(file));
  }
  return projections;
}

// The images by the first number in their names.
Result<std::map<int, std::string>> NumberedImages(
    const std::vector<std::string>& names, const fs::path& folder) {
  std::map<int, std::string> numbered;
  for (const std::string& name : names) {
    const std::optional<int> number = FirstNumber(name);
    if (!number) continue;
    const auto [other, is_new] = numbered.emplace(*number, name);
    if (!is_new) {
      return Status::InvalidArgument(
          folder.string() + " holds several images number " +
          std::to_string(*number) + " (" + other->second + ", " + name +
          "); choose with --image_filter, say --image_filter max.");
    }
  }
  return numbered;
}

// Whether the first numbers in the names are the numbers of the cameras.
bool HaveSameNumbers(const Projections& projections,
                     const std::vector<std::string>& names) {
  std::set<std::optional<int>> of_names, of_cameras;
  for (const std::string& name : names) of_names.insert(FirstNumber(name));
  for (const auto& [number, _] : projections) of_cameras.insert(number);
  return of_names.size() == names.size() && of_names == of_cameras;
}

std::vector<DtuView> PairInOrder(const Projections& projections,
                                 const std::vector<std::string>& names) {
  std::vector<DtuView> views;
  for (const auto& [number, projection] : projections) {
    views.push_back({"world_mat_" + std::to_string(number),
                     projection,
                     names[views.size()]});
  }
  return views;
}

// Pairs by number; a note names how many of either have no partner.
Result<std::vector<DtuView>> PairByNumber(const Projections& projections,
                                          const std::vector<std::string>& names,
                                          const fs::path& folder,
                                          std::vector<std::string>* notes) {
  CURVIX_ASSIGN_OR_RETURN(const auto numbered, NumberedImages(names, folder));
  std::vector<DtuView> views;
  for (const auto& [number, projection] : projections) {
    const auto image = numbered.find(number);
    if (image == numbered.end()) continue;
    views.push_back(
        {"camera " + std::to_string(number), projection, image->second});
  }
  const std::string counts =
      OneOrMore(names.size(), "There is ", "There are ") +
      Plural(names.size(), "image") + " in " + folder.string() + " and " +
      Plural(projections.size(), "camera");
  if (views.empty()) {
    return Status::NotFound(counts +
                            ", but no number of a camera is in the name of an "
                            "image; name their folder with --image_path.");
  }
  if (views.size() < std::max(names.size(), projections.size())) {
    notes->push_back(counts + "; " + std::to_string(views.size()) +
                     OneOrMore(views.size(), " has", " have") +
                     " the same number and " +
                     OneOrMore(views.size(), "is", "are") + " taken.");
  }
  return views;
}

// The mean calibration, if all are the same to within 0.02 px.
std::optional<Eigen::Matrix3d> SharedCalibration(
    const std::vector<CalibratedImage>& images) {
  constexpr double kSamePx = 0.02;
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const CalibratedImage& image : images) mean += image.pose.calibration;
  mean /= static_cast<double>(images.size());
  const bool same = std::ranges::all_of(images, [&](const auto& image) {
    return ((image.pose.calibration - mean).array().abs() < kSamePx).all();
  });
  return same ? std::optional(mean) : std::nullopt;
}

Result<std::vector<CalibratedImage>> Decompose(
    const std::vector<DtuView>& views) {
  std::vector<CalibratedImage> images;
  for (const DtuView& view : views) {
    const auto pose = DecomposeProjection(view.projection);
    if (!pose) return BrokenDtu(view.source + " is no projection matrix");
    images.push_back({view.image, *pose, view.source});
  }
  const std::optional<Eigen::Matrix3d> shared = SharedCalibration(images);
  for (std::size_t i = 0; shared && i < images.size(); ++i) {
    images[i].pose = {*shared, PoseOfProjection(views[i].projection, *shared)};
  }
  return images;
}

// The folder of the images: the first that holds any.
Result<fs::path> FindFolder(const ImportOptions& options,
                            const fs::path& base) {
  for (const fs::path& place : {base / "image", base / "images"}) {
    if (!options.image_path.empty()) break;
    if (!ImageNames(place, options.image_filter).empty()) return place;
  }
  return FindImageFolder(options.image_path, {base}, "");
}

}  // namespace

Result<ImportedScene> ImportDtu(const ImportOptions& options) {
  fs::path source = options.input_path;
  Projections projections;
  if (IsFolder(source)) {
    CURVIX_ASSIGN_OR_RETURN(projections, ReadPosFolder(source));
  }
  const bool is_npz = projections.empty();
  if (!is_npz && options.normalize) {
    return Status::InvalidArgument(
        "--normalize needs scale_mat of an archive cameras*.npz; " +
        source.string() + " has positions");
  }
  if (is_npz) {
    if (IsFolder(source)) {
      CURVIX_ASSIGN_OR_RETURN(source, OnlyFile(source, "cameras", ".npz"));
    }
    CURVIX_ASSIGN_OR_RETURN(projections,
                            ReadNpzProjections(source, options.normalize));
  }
  const fs::path base = is_npz ? source.parent_path() : source;
  CURVIX_ASSIGN_OR_RETURN(const fs::path folder, FindFolder(options, base));
  const auto names = ImageNames(folder, options.image_filter);
  std::vector<std::string> notes;
  CURVIX_ASSIGN_OR_RETURN(
      std::vector<DtuView> pairs,
      is_npz && names.size() == projections.size() &&
              !HaveSameNumbers(projections, names)
          ? PairInOrder(projections, names)
          : PairByNumber(projections, names, folder, &notes));
  CURVIX_ASSIGN_OR_RETURN(const auto images, Decompose(pairs));
  Result<ImportedScene> scene =
      SceneOfImages(images, folder, options.first_pixel.value_or(0), source);
  if (scene.ok()) scene->notes = std::move(notes);
  return scene;
}

}  // namespace curvix
