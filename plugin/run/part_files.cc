// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/part_files.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/cancelled.h"
#include "base/file_io.h"
#include "base/option_table.h"
#include "base/text_fields.h"
#include "io/stage_file.h"
#include "plugin/base/json.h"
#include "plugin/export/curves_json.h"
#include "plugin/run/file_hashes.h"
#include "plugin/run/part_models.h"
#include "plugin/run/stage_store.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlanName = "plan.json";
constexpr const char* kInputName = "input.json";

std::size_t Idx(int idx) { return static_cast<std::size_t>(idx); }

// "cut 3" or "part 0", for a child of a cut.
std::string NodeName(int node) {
  return node >= 0 ? "cut " + std::to_string(node)
                   : "part " + std::to_string(-1 - node);
}

// nullopt: no such name.
std::optional<int> NodeOf(std::string_view name) {
  const std::string_view kind = TakeWord(name);
  const auto idx = ParseNumber<int>(TakeWord(name));
  if (!idx || *idx < 0 || !name.empty()) return std::nullopt;
  if (kind == "cut") return *idx;
  return kind == "part" ? std::optional(-1 - *idx) : std::nullopt;
}

Json CutJson(const SceneCut& cut) {
  return {{"normal", VectorJson(cut.normal)},
          {"offset", cut.offset},
          {"below", NodeName(cut.below)},
          {"above", NodeName(cut.above)}};
}

double Megapixels(const Camera& camera) {
  return 1e-6 * camera.width * camera.height;
}

Json PartJson(int part_idx, const ScenePart& part, const Scene& scene) {
  double sum = 0;
  double largest = 0;
  std::vector<std::string> names;
  for (const int idx : part.view_idxs) {
    const View& view = scene.views[Idx(idx)];
    const double megapixels = Megapixels(CameraOf(scene, view));
    sum += megapixels;
    largest = std::max(largest, megapixels);
    names.push_back(view.name);
  }
  return {{"part", part_idx},
          {"num_views", part.view_idxs.size()},
          {"num_own_views", part.own_view_idxs.size()},
          {"megapixels", sum},
          {"largest_megapixels", largest},
          {"own_view_idxs", part.own_view_idxs},
          {"view_idxs", part.view_idxs},
          {"views", names}};
}

// Throws nlohmann's exceptions, and std::out_of_range.
ScenePartition PartitionOf(const Json& json) {
  ScenePartition partition;
  partition.overlap = json.at("overlap").get<double>();
  for (const Json& item : json.at("cuts")) {
    SceneCut cut;
    for (int axis = 0; axis < 3; ++axis) {
      cut.normal[axis] = item.at("normal").at(Idx(axis)).get<double>();
    }
    cut.offset = item.at("offset").get<double>();
    cut.below = NodeOf(item.at("below").get<std::string>()).value();
    cut.above = NodeOf(item.at("above").get<std::string>()).value();
    partition.cuts.push_back(cut);
  }
  for (const Json& item : json.at("parts")) {
    partition.parts.push_back(
        {item.at("view_idxs").get<std::vector<int>>(),
         item.at("own_view_idxs").get<std::vector<int>>()});
  }
  return partition;
}

bool IsAscending(const std::vector<int>& idxs, int num_views) {
  return !idxs.empty() && idxs.front() >= 0 && idxs.back() < num_views &&
         std::ranges::adjacent_find(idxs, std::ranges::greater_equal()) ==
             idxs.end();
}

// Whether every cut and part is reached once from the first cut, and views
// exist.
bool IsSound(const ScenePartition& partition, int num_views) {
  const auto num_cuts = static_cast<int>(partition.cuts.size());
  const auto num_parts = static_cast<int>(partition.parts.size());
  std::multiset<int> nodes = {num_cuts > 0 ? 0 : -1};
  for (int i = 0; i < num_cuts; ++i) {
    const SceneCut& cut = partition.cuts[Idx(i)];
    // Children come after their cut, so there is no circle.
    if ((cut.below >= 0 && cut.below <= i) ||
        (cut.above >= 0 && cut.above <= i)) {
      return false;
    }
    nodes.insert({cut.below, cut.above});
  }
  std::multiset<int> expected;
  for (int i = -num_parts; i < num_cuts; ++i) expected.insert(i);
  return nodes == expected && partition.overlap >= 0 &&
         std::ranges::all_of(
             partition.parts, [num_views](const ScenePart& part) {
               return IsAscending(part.view_idxs, num_views) &&
                      IsAscending(part.own_view_idxs, num_views);
             });
}

// "; these are not there: 1, 3" and the like; "" without parts.
std::string PartsText(const std::string& what, const std::vector<int>& idxs) {
  std::string text;
  for (const int idx : idxs) {
    text += (text.empty() ? what + ": " : ", ") + std::to_string(idx);
  }
  return text;
}

Status BrokenPlan(const fs::path& path) {
  return Status::DataLoss(path.string() +
                          " is broken; run 'colmap_curvix partition' again");
}

Status PartsNotDone(const std::vector<int>& missing,
                    const std::vector<int>& other) {
  return Status::NotFound(
      "Not all parts are done" + PartsText("; these are not there", missing) +
      PartsText("; these are broken, or of other images, masks or options, or "
                "of another version",
                other) +
      "; run 'colmap_curvix reconstruct' with --part and the paths and options "
      "of this command for each of them");
}

}  // namespace

std::string PlanJson(const ScenePartition& partition, const Scene& scene) {
  Json json;
  json["num_views"] = scene.views.size();
  json["num_parts"] = partition.parts.size();
  json["scene_hash"] = SceneKey(scene);
  json["overlap"] = partition.overlap;
  json["cuts"] = Json::array();
  for (const SceneCut& cut : partition.cuts) {
    json["cuts"].push_back(CutJson(cut));
  }
  json["parts"] = Json::array();
  for (std::size_t i = 0; i < partition.parts.size(); ++i) {
    json["parts"].push_back(
        PartJson(static_cast<int>(i), partition.parts[i], scene));
  }
  // COLMAP's names may hold any bytes; JSON holds UTF-8 only.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status WritePlan(const ScenePartition& partition,
                 const Scene& scene,
                 const ColmapModel& model,
                 const fs::path& folder) {
  CURVIX_RETURN_IF_ERROR(
      WriteColmapModel(ModelForMerge(model, scene), folder / "scene"));
  for (std::size_t i = 0; i < partition.parts.size(); ++i) {
    CURVIX_RETURN_IF_ERROR(WriteColmapModel(
        ModelForPart(model, scene, partition.parts[i].view_idxs),
        PartFolder(folder, static_cast<int>(i)) / "sparse"));
  }
  return WriteFileAtomically(folder / kPlanName, PlanJson(partition, scene));
}

Status CheckModelIsThere(const fs::path& folder) {
  std::error_code error;
  for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"}) {
    if (fs::exists(folder / file, error)) continue;
    return Status::NotFound(
        "There is no " + (folder / file).string() +
        "; run 'colmap_curvix partition' again, which brings it back");
  }
  return {};
}

Status WriteInputOfPlan(const InputOfPlan& input, const fs::path& folder) {
  const Json json = {{"model_hash", input.model_hash},
                     {"missing_images", input.missing_images},
                     {"notes", input.notes}};
  return WriteFileAtomically(
      folder / kInputName,
      json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<InputOfPlan> ReadInputOfPlan(const fs::path& folder) {
  const fs::path path = folder / kInputName;
  const Result<std::string> text = ReadFile(path);
  if (!text.ok()) {
    return Status::NotFound("There is no " + path.string() +
                            "; run 'colmap_curvix partition' again");
  }
  InputOfPlan input;
  try {
    const Json json = Json::parse(*text);
    json.at("model_hash").get_to(input.model_hash);
    json.at("missing_images").get_to(input.missing_images);
    json.at("notes").get_to(input.notes);
  } catch (const Json::exception&) {
    return BrokenPlan(path);
  }
  return input;
}

Result<PartPlan> ReadPlan(const fs::path& folder) {
  Result<std::string> text = ReadFile(folder / kPlanName);
  if (!text.ok()) {
    return Status::NotFound("There is no plan " +
                            (folder / kPlanName).string() +
                            "; run 'colmap_curvix partition' first");
  }
  PartPlan plan;
  bool is_sound = false;
  try {
    const Json json = Json::parse(*text);
    plan.partition = PartitionOf(json);
    const int num_views = json.at("num_views").get<int>();
    plan.num_views = Idx(num_views);
    is_sound = IsSound(plan.partition, num_views);
  } catch (const std::exception&) {
    is_sound = false;
  }
  if (!is_sound) return BrokenPlan(folder / kPlanName);
  plan.text = *std::move(text);
  return plan;
}

std::uint64_t PartKey(const PartPlan& plan,
                      int part_idx,
                      const Options& options,
                      const std::vector<std::uint64_t>& image_hashes) {
  std::string text = plan.text + std::to_string(part_idx);
  text += ' ';
  text += ProgramVersion();
  text += ' ';
  text += std::to_string(HashOf(image_hashes));
  Options copy = options;
  for (const OptionRow& row : OptionTable(copy)) {
    if (row.section.empty() || row.section == "CurveFitting") continue;
    text += "\n" + FullName(row) + "=" + ValueText(row);
  }
  return HashBytes(text);
}

fs::path PartFolder(const fs::path& folder, int part_idx) {
  return folder / std::to_string(part_idx);
}

Result<PartFiles> PartFiles::Open(
    const PartPlan& plan,
    const Options& options,
    const std::vector<std::uint64_t>& image_hashes,
    const fs::path& folder,
    RunProgress& progress) {
  PartFiles parts(progress);
  std::vector<int> missing;
  std::vector<int> other;
  const int num_parts = static_cast<int>(plan.partition.parts.size());
  for (int i = 0; i < num_parts; ++i) {
    if (progress.IsCancelled()) return CancelledStatus();
    const fs::path part = PartFolder(folder, i);
    if (!fs::exists(part / kPartResultName) ||
        !fs::exists(part / kPartEdgesName)) {
      missing.push_back(i);
      continue;
    }
    std::vector<std::uint64_t> hashes;
    for (const int idx : plan.partition.parts[Idx(i)].view_idxs) {
      hashes.push_back(image_hashes[Idx(idx)]);
    }
    Result<PartFile> file = PartFile::Open(part / kPartResultName,
                                           PartKey(plan, i, options, hashes));
    if (!file.ok()) {
      other.push_back(i);
      continue;
    }
    file->Close();
    parts.files_.push_back(std::move(file).value());
  }
  if (!missing.empty() || !other.empty()) return PartsNotDone(missing, other);
  return parts;
}

std::int64_t PartFiles::num_edges_2d() const {
  std::int64_t sum = 0;
  for (const PartFile& file : files_) sum += file.num_own_edges_2d();
  return sum;
}

std::int64_t PartFiles::num_edges_3d() const {
  std::int64_t sum = 0;
  for (const PartFile& file : files_) sum += file.num_core_edges_3d();
  return sum;
}

std::size_t PartFiles::NumCurves(int part_idx) const {
  return files_[Idx(part_idx)].num_curves();
}

Result<TracedCurve> PartFiles::Read(int part_idx, std::size_t curve_idx) {
  if (progress_.IsCancelled()) return CancelledStatus();
  if (Idx(part_idx) != open_) files_[open_].Close();
  open_ = Idx(part_idx);
  return files_[open_].Read(curve_idx);
}

}  // namespace curvix
