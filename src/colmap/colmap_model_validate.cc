// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/scene.h>
#include <algorithm>
#include <set>
#include <string_view>

#include "colmap/colmap_model_format.h"

namespace curvix {
namespace {

// In this file, a sentence says what is wrong; an empty one says nothing is.

std::string Label(const ColmapImage& image) {
  return "image " + std::to_string(image.image_id) + " (" + image.name + ")";
}

std::string WrongCamera(const std::vector<ColmapCamera>& cameras) {
  std::set<std::uint32_t> ids;
  for (const ColmapCamera& item : cameras) {
    const std::string id = std::to_string(item.camera_id);
    if (!ids.insert(item.camera_id).second) {
      return "two cameras have the id " + id + "; export the model again.";
    }
    const Status status = Validate(item.camera);
    if (!status.ok()) {
      return "camera " + id +
             " is not usable; correct it or export the model "
             "again. " +
             status.message();
    }
  }
  return "";
}

std::string WrongImage(const ColmapImage& image) {
  if (LeavesImageFolder(image.name)) {
    return "the name of " + Label(image) +
           " is empty, absolute or contains \"..\"; name images relative to "
           "their folder.";
  }
  if (!image.cam_from_world.rotation.coeffs().allFinite()) {
    return Label(image) +
           " has a rotation that is zero or not finite; remove the image or "
           "export the model again.";
  }
  if (!image.cam_from_world.translation.allFinite()) {
    return Label(image) +
           " has a translation that is not finite; remove the image or export "
           "the model again.";
  }
  return "";
}

std::string WrongImages(const ColmapModel& model) {
  std::set<std::uint32_t> camera_ids;
  for (const ColmapCamera& item : model.cameras) {
    camera_ids.insert(item.camera_id);
  }
  std::set<std::uint32_t> ids;
  std::set<std::string_view> names;
  for (const ColmapImage& image : model.images) {
    std::string wrong = WrongImage(image);
    if (!wrong.empty()) return wrong;
    if (!ids.insert(image.image_id).second) {
      return "two images have the id " + std::to_string(image.image_id) +
             "; export the model again.";
    }
    if (!names.insert(image.name).second) {
      return "two images have the name " + image.name +
             "; export the model again.";
    }
    if (!camera_ids.contains(image.camera_id)) {
      return Label(image) + " was taken by camera " +
             std::to_string(image.camera_id) +
             ", which the model does not have; export the model again.";
    }
  }
  return "";
}

std::string WrongPoint(const std::vector<ColmapPoint3D>& points) {
  std::set<std::uint64_t> ids;
  for (const ColmapPoint3D& point : points) {
    const std::size_t num_before = ids.size();
    ids.insert(ids.end(), point.point3D_id);  // quick if they ascend
    if (ids.size() == num_before) {
      return "two points have the id " + std::to_string(point.point3D_id) +
             "; export the model again.";
    }
    if (!point.position.allFinite()) {
      return "point " + std::to_string(point.point3D_id) +
             " has a position that is not finite; remove it or export the "
             "model again.";
    }
  }
  return "";
}

}  // namespace

bool LeavesImageFolder(std::string_view name) {
  if (name.empty() || name[0] == '/' || name[0] == '\\') return true;
  // "C:\a.jpg"; "c:d.png" is a file, too.
  if (name.find_first_of("/\\") == 2 && name[1] == ':') return true;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/\\"), name.size());
    if (name.substr(0, end) == "..") return true;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return false;
}

std::optional<ColmapFlaw> FindFlaw(const ColmapModel& model) {
  ColmapFlaw flaws[] = {{"cameras", WrongCamera(model.cameras)},
                        {"images", WrongImages(model)},
                        {"points3D", WrongPoint(model.points)}};
  for (ColmapFlaw& flaw : flaws) {
    if (!flaw.sentence.empty()) return std::move(flaw);
  }
  return std::nullopt;
}

Status ValidateColmapModel(const ColmapModel& model) {
  const std::optional<ColmapFlaw> flaw = FindFlaw(model);
  if (!flaw) return {};
  return Status::DataLoss("The model is broken in its " + flaw->list + ": " +
                          flaw->sentence);
}

}  // namespace curvix
