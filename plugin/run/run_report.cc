// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_report.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/option_table.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "plugin/base/json.h"
#include "plugin/base/text.h"
#include "plugin/export/alignment_file.h"
#include "plugin/export/curves_json.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// A row's value with its own type.
Json ValueJson(const OptionRow& row) {
  return std::visit(
      [&](const auto* field) -> Json {
        using Value = std::remove_cv_t<std::remove_pointer_t<decltype(field)>>;
        if constexpr (std::is_arithmetic_v<Value>) {
          return *field;
        } else {
          return ValueText(row);
        }
      },
      row.field);
}

// {"EdgeDetection": {"sigma_px": 1.0, ...}, ...}, without the runtime options.
Json OptionsJson(Options options) {
  Json json = Json::object();
  for (const OptionRow& row : OptionTable(options)) {
    if (!row.section.empty()) json[row.section][row.name] = ValueJson(row);
  }
  return json;
}

Json InputJson(const RunRecord& record) {
  const InputSummary& input = record.input;
  const RunSettings& settings = record.settings;
  Json json;
  json["workspace_path"] = settings.workspace_path.string();
  json["model_path"] = input.model_path.string();
  json["image_path"] = settings.image_path.string();
  if (!settings.mask_path.empty()) {
    json["mask_path"] = settings.mask_path.string();
  }
  json["camera_models"] = input.camera_models;
  json["num_views"] = input.num_views;
  json["num_points"] = input.num_points;
  json["missing_images"] = input.missing_images;
  json["notes"] = input.notes;
  return json;
}

Json ErrorsJson(const ErrorsOfViews& errors) {
  return {{"median_px", errors.median_px}, {"mean_px", errors.mean_px}};
}

Json JudgementJson(const PoseJudgement& judgement) {
  Json json;
  json["num_held_out_points"] = judgement.num_check_points;
  json["num_held_out_observations"] = judgement.num_check_observations;
  json["error_before"] = ErrorsJson(judgement.before);
  json["error_after"] = ErrorsJson(judgement.after);
  json["error_explained_px"] = judgement.explained_px;
  json["median_shift_px"] = judgement.median_shift_px;
  json["max_shift_px"] = judgement.max_shift_px;
  json["max_turn_deg"] = judgement.max_turn_deg;
  json["max_move"] = judgement.max_move;
  return json;
}

Json PosesJson(const PoseRefinementRecord& poses) {
  Json json;
  json["refiner"] = poses.refiner;
  json["accepted"] = poses.accepted;
  json["reason"] = poses.reason;
  json["num_views"] = poses.num_views;
  json["num_points"] = poses.num_points;
  if (poses.refiner == "colmap") {
    json["colmap_path"] = poses.colmap_path;
    json["colmap_version"] = poses.colmap_version;
  }
  if (!poses.judgement) return json;
  json["scale_removed"] = poses.scale_removed;
  json.update(JudgementJson(*poses.judgement));
  json["max_shift_image"] = poses.largest_shift_image;
  return json;
}

Json CameraJson(const Camera& camera) {
  return {{"model", std::string(ModelName(camera.model))},
          {"params", camera.params}};
}

Json CurvePosesJson(const CurvePoseRecord& record) {
  const CurvePoses& poses = record.poses;
  Json json;
  json["accepted"] = poses.accepted;
  json["reason"] = poses.reason;
  json["num_places"] = poses.num_samples;
  json["num_held_out_places"] = poses.num_check_samples;
  json["num_held_out_observations"] = poses.num_check_observations;
  json["num_views_moved"] = poses.num_views_moved;
  json["error_before"] = ErrorsJson(poses.before);
  json["error_after"] = ErrorsJson(poses.after);
  json["median_shift_px"] = poses.median_shift_px;
  json["max_shift_px"] = poses.max_shift_px;
  json["max_shift_image"] = record.largest_shift_image;
  json["significance"] = poses.significance;
  if (poses.num_points > 0) {
    json["num_points"] = poses.num_points;
    json["num_held_out_points"] = poses.num_check_points;
    json["point_error_before"] = ErrorsJson(poses.points_before);
    json["point_error_after"] = ErrorsJson(poses.points_after);
  }
  json["refined_cameras"] = Json::array();
  for (const CameraChange& change : record.cameras) {
    json["refined_cameras"].push_back(
        {{"camera_id", change.camera_id},
         {"from", CameraJson(change.from)},
         {"to", CameraJson(change.to)},
         {"median_shift_px", change.median_shift_px}});
  }
  return json;
}

Json CountsJson(const std::vector<StageReport>& stages) {
  Json json = Json::array();
  for (const StageReport& stage : stages) {
    Json counts = Json::object();
    for (const auto& [name, count] : stage.counts) counts[name] = count;
    json.push_back({{"name", stage.name}, {"counts", counts}});
  }
  return json;
}

Json ResultJson(const ResultSummary& result) {
  Json json;
  json["num_curves"] = result.num_curves;
  json["num_closed_curves"] = result.num_closed;
  json["num_samples"] = result.num_samples;
  json["total_length"] = result.total_length;
  json["num_edges_3d"] = result.num_edges_3d;
  json["num_edges_2d"] = result.num_edges_2d;
  // Merges and imports do not measure it.
  if (result.edge_sigma_px > 0) {
    json["edge_sigma_px"] = Rounded(result.edge_sigma_px, 3);
  }
  json["files"] = result.files;
  json["why_empty"] = result.why_empty;
  return json;
}

// CPU over wall seconds: how many threads were at work, on average.
double Parallelism(const StageReport& stage) {
  return stage.wall_seconds > 0 ? stage.cpu_seconds / stage.wall_seconds : 0;
}

Json CostJson(const StageReport& stage) {
  return {{"name", stage.name},
          {"wall_seconds", Rounded(stage.wall_seconds, 3)},
          {"cpu_seconds", Rounded(stage.cpu_seconds, 3)},
          {"parallelism", Rounded(Parallelism(stage), 3)},
          {"peak_memory_mb", Rounded(stage.peak_memory_mb, 3)}};
}

Json RunJson(const RunRecord& record) {
  Json json = CostJson(record.total);
  json.erase("name");
  json["num_threads"] = record.settings.options.runtime.num_threads;
  json["resumed_stages"] = record.resumed_stages;
  json["stages"] = Json::array();
  for (const StageReport& stage : record.stages) {
    json["stages"].push_back(CostJson(stage));
  }
  return json;
}

// "  detect_edges  24 views, 81 234 edges"
std::string StageLine(const StageReport& stage) {
  constexpr std::size_t kCountsColumn = 18;
  std::string counts;
  for (const auto& [name, count] : stage.counts) {
    counts += counts.empty() ? "" : ", ";
    std::string item = CountText(count, name);
    std::ranges::replace(item, ' ', kNoBreak);
    counts += item;
  }
  std::string line = WrapText(counts, kCountsColumn);
  if (stage.name.size() + 3 > kCountsColumn) {
    return "  " + stage.name + "\n" + line;
  }
  return line.replace(2, stage.name.size(), stage.name);
}

const char* OpenedBy(const std::string& file) {
  for (const OutputFormat& format : OutputFormats()) {
    if (file == format.file) return format.opened_by;
  }
  if (file == kOverlaysFolder) return "images with the curves drawn over them";
  if (file == "edges.ply") return "3D edges before grouping, as points";
  if (file == kModelFolder) return "model as it was used: COLMAP";
  if (file == "bundle_adjuster.log") return "what COLMAP said";
  if (file == "report.json") return "counts, seconds and memory by stage";
  if (file == "project.ini") return "the options: --project_path repeats them";
  return "";
}

// What lengths are in, after a number.
std::string LengthUnit(const std::optional<WorldAlignment>& alignment) {
  if (!alignment || !alignment->has_scale) return " in the units of the model";
  if (alignment->unit.empty()) return " in the units of alignment.json";
  return " " + alignment->unit;
}

std::string FilesText(const ResultSummary& result) {
  std::string text = "Written to " + result.output_path.string() + "\n";
  for (const std::string& file : result.files) {
    std::string line = "  " + file;
    line.resize(std::max<std::size_t>(line.size() + 2, 18), ' ');
    text += line + OpenedBy(file) + "\n";
  }
  return text;
}

std::string EmptyText(const RunRecord& record) {
  std::string text = WrapText("No curves: " + record.result.why_empty, 0) +
                     "\nWhat each stage counted\n";
  for (const StageReport& stage : record.stages) {
    if (!stage.counts.empty()) text += StageLine(stage);
  }
  return text + "\n" + FilesText(record.result);
}

// "" if it is not known.
std::string EdgeSigmaText(const RunRecord& record) {
  const double sigma_px = Rounded(record.result.edge_sigma_px, 3);
  if (!(sigma_px > 0)) return "";
  const double least_px =
      Rounded(record.settings.options.hypotheses.EdgeSigmaPx(), 3);
  return "  2D edges are " +
         std::string(sigma_px > least_px ? "" : "taken to be ") +
         ShortText(sigma_px, 4) + " px off their 3D edges (standard deviation" +
         (sigma_px > least_px ? "" : "; the lower limit") + ")\n";
}

// Of the run before; no object if there is none.
Json ReadReport(const fs::path& folder) {
  const Result<std::string> text = ReadFile(folder / "report.json");
  return text.ok() ? Json::parse(*text, nullptr, false) : Json();
}

// "" if it is not in the report.
fs::path PathIn(const Json& report, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  if (!report.contains(place) || !report.at(place).is_string()) return {};
  return report.at(place).get<std::string>();
}

}  // namespace

std::string_view ProgramVersion() { return CURVIX_VERSION; }

std::vector<fs::path> FilesOfEarlierRun(const fs::path& folder) {
  const Json report = ReadReport(folder);
  const Json::json_pointer pointer("/result/files");
  std::vector<fs::path> files;
  if (!report.is_object() || !report.contains(pointer)) return files;
  for (const Json& file : report.at(pointer)) {
    // Nothing but what runs write.
    if (file.is_string() && *OpenedBy(file) != '\0') {
      files.emplace_back(file.get<std::string>());
    }
  }
  return files;
}

fs::path ImagesOfEarlierRun(const fs::path& folder,
                            const fs::path& workspace_path) {
  const Json report = ReadReport(folder);
  const fs::path recorded = PathIn(report, "/input/image_path");
  const fs::path own = PathIn(report, "/input/workspace_path");
  if (!recorded.is_absolute() || !own.is_absolute()) return {};
  const fs::path normal = recorded.lexically_normal();
  const fs::path from_own = normal.lexically_relative(own.lexically_normal());
  const fs::path moved =
      (fs::absolute(workspace_path) / from_own).lexically_normal();
  // What has not moved keeps its spelling, by which stages know it.
  if (moved / "" != normal / "" && IsFolder(moved)) return moved;
  return IsFolder(recorded) ? recorded : fs::path();
}

void Count(const Curve& curve, ResultSummary& result) {
  ++result.num_curves;
  if (curve.closed) ++result.num_closed;
  result.num_samples += static_cast<std::int64_t>(curve.samples.size());
  result.total_length += Length(curve);
}

ResultSummary SummarizeCurves(const CurveSet& curves) {
  ResultSummary result;
  for (const Curve& curve : curves.curves) Count(curve, result);
  return result;
}

std::string ReportJson(const RunRecord& record) {
  Json json;
  json["program"] = {{"name", "colmap_curvix"},
                     {"version", std::string(ProgramVersion())}};
  json["preset"] = record.settings.preset;
  json["options"] = OptionsJson(record.settings.options);
  json["input"] = InputJson(record);
  json["pose_refinement"] = PosesJson(record.poses);
  if (record.curve_poses) {
    json["pose_refinement_with_curves"] = CurvePosesJson(*record.curve_poses);
  }
  json["stages"] = CountsJson(record.stages);
  if (record.alignment) json["alignment"] = AlignmentJson(*record.alignment);
  json["result"] = ResultJson(record.result);
  json["run"] = RunJson(record);
  // COLMAP's names may hold any bytes; JSON holds UTF-8 only.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ProjectFile(const RunSettings& settings) {
  std::string text = "# colmap_curvix " + std::string(ProgramVersion()) + "\n";
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) text += name + "=" + value + "\n";
  };
  add(kCommandName, settings.command);
  add("workspace_path", settings.workspace_path.string());
  add("input_path", settings.input_path.string());
  add("image_path", settings.image_path.string());
  add("output_path", settings.output_path.string());
  add("mask_path", settings.mask_path.string());
  add("preset", settings.preset);
  RunSettings copy = settings;
  for (const FlagSection& flags :
       {OutputFlags(&copy.output), PoseRefinementFlags(&copy.poses)}) {
    for (const Flag& flag : flags.flags) add(flag.name, flag.default_value);
  }
  add("num_threads", std::to_string(copy.options.runtime.num_threads));
  std::string section;
  for (const OptionRow& row : OptionTable(copy.options)) {
    if (row.section.empty()) continue;
    if (row.section != section) text += "[" + row.section + "]\n";
    section = row.section;
    add(row.name, ValueText(row));
  }
  return text;
}

std::string SummaryText(const RunRecord& record) {
  const ResultSummary& result = record.result;
  if (result.num_curves == 0) return EmptyText(record);
  std::string text = Plural(result.num_curves, "curve");
  if (result.num_closed > 0) {
    text += " (" + GroupDigits(result.num_closed) + " closed)";
  }
  text += ", total length " + ShortText(result.total_length, 4) +
          LengthUnit(record.alignment) + "\n";
  text += "  from " + Plural(record.input.num_views, "view");
  if (result.num_edges_3d > 0) {
    text += ", " + Plural(result.num_edges_2d, "edge") + " and " +
            Plural(result.num_edges_3d, "3D edge");
  }
  text += " in " + DurationText(record.total.wall_seconds) + " (CPU " +
          DurationText(record.total.cpu_seconds) + ", " +
          GroupDigits(std::llround(record.total.peak_memory_mb)) + " MB)\n";
  text += EdgeSigmaText(record);
  text += "\n";
  return text + FilesText(result);
}

}  // namespace curvix
