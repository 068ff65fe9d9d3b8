// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/evaluations.h"

#include <curvix/curve_io.h>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/count_text.h"
#include "base/text_fields.h"
#include "colmap/workspace.h"
#include "measuring/moved_curves.h"
#include "plugin/align/curves_file.h"
#include "plugin/base/json.h"
#include "plugin/export/alignment_file.h"
#include "plugin/export/write_results.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// `text`, shorter than that, in so many columns.
std::string Padded(std::string text, std::size_t num_columns = 24) {
  text.resize(num_columns, ' ');
  return text;
}

// Nine columns wide, or more if need be.
std::string Column(double value, int num_decimals) {
  const std::string text = FixedText(value, num_decimals);
  return std::string(text.size() < 9 ? 9 - text.size() : 0, ' ') + text;
}

std::string Fixed(const std::optional<double>& value) {
  return value ? Column(*value, 3) : "        -";
}

std::string MeasureRow(const char* name,
                       const std::optional<double>& value,
                       const std::string& unit) {
  return Padded(name) + Fixed(value) + " " + unit + "\n";
}

std::string AgreementText(const Evaluation& e) {
  std::string text = "within                       5 mm    10 mm    20 mm\n";
  const auto row = [&](const char* name, double Agreement::*member) {
    text += Padded(name);
    for (const Agreement& a : e.agreement) text += Fixed(a.*member);
    text += " %\n";
  };
  row("precision", &Agreement::precision);
  row("recall", &Agreement::recall);
  row("F-score", &Agreement::f_score);
  row("IoU", &Agreement::iou);
  return text + "recall of visible       " + Fixed(e.visible_recall_5) +
         Fixed(e.visible_recall_10) + Fixed(std::nullopt) + " %\n" +
         "F-score of visible      " + Fixed(e.visible_f_score_5) +
         Fixed(std::nullopt) + Fixed(std::nullopt) + " %\n";
}

// "unknown", "crease", "boundary", ...
std::string NameOf(std::size_t kind) {
  return std::string(KindName(static_cast<CurveKind>(kind)));
}

std::string LengthsText(std::string_view title,
                        const LengthPerKind& lengths_mm) {
  std::string text = Padded(std::string(title));
  for (const double length : lengths_mm) text += " " + Column(length, 0);
  return text;
}

// Lengths in millimetres: rows by the true kind, columns by the kind said.
std::string KindsText(const KindAgreement& kinds) {
  std::string text = "true kind, mm              length   visible   recall\n";
  for (const TrueKind& kind : kinds.kinds) {
    text += Padded(std::string(KindName(kind.kind))) + " " +
            Column(kind.length_mm, 0) + " " +
            Column(kind.visible_length_mm, 0) + Fixed(kind.visible_recall_5) +
            " %\n";
  }
  text +=
      "said to be, mm             unknown    crease  boundary   marking   "
      "contour    right\n";
  for (const TrueKind& kind : kinds.kinds) {
    text += LengthsText(KindName(kind.kind), kind.predicted_mm) +
            Fixed(kind.right) + " %\n";
  }
  return text + LengthsText("none within 5 mm", kinds.elsewhere_mm) + "\n" +
         MeasureRow("of the right kind", kinds.right, "%");
}

std::string TableOf(const Evaluation& e) {
  return AgreementText(e) + MeasureRow("accuracy", e.accuracy_mm, "mm") +
         MeasureRow("completeness", e.completeness_mm, "mm") +
         MeasureRow(
             "completeness of visible", e.visible_completeness_mm, "mm") +
         MeasureRow("tangent error, median", e.tangent_deg, "deg") +
         MeasureRow("duplication", e.duplication, "(1 is best)") +
         MeasureRow("recall of whole curves", e.whole, "%") +
         MeasureRow("purity of curves", e.pure, "%") +
         "curves                  " + std::to_string(e.num_curves) +
         " found, " +
         (e.num_true_curves ? std::to_string(*e.num_true_curves) : "-") +
         " true\nsamples compared        " + std::to_string(e.num_predicted) +
         " found, " + std::to_string(e.num_true) + " true\n" +
         (e.kinds ? KindsText(*e.kinds) : "");
}

Json ToJson(const std::optional<double>& value) {
  if (!value) return nullptr;
  return *value;
}

Json ToJson(const LengthPerKind& lengths_mm) {
  Json json;
  for (std::size_t i = 0; i < kNumCurveKinds; ++i)
    json[NameOf(i)] = lengths_mm[i];
  return json;
}

Json ToJson(const KindAgreement& kinds) {
  Json json;
  json["right"] = ToJson(kinds.right);
  for (const TrueKind& kind : kinds.kinds) {
    json[std::string(KindName(kind.kind))] = {
        {"length", kind.length_mm},
        {"length_visible", kind.visible_length_mm},
        {"Rv5", ToJson(kind.visible_recall_5)},
        {"right", ToJson(kind.right)},
        {"said", ToJson(kind.predicted_mm)}};
  }
  json["elsewhere"] = ToJson(kinds.elsewhere_mm);
  return json;
}

std::string JsonOf(const Evaluation& e) {
  Json json;
  json["predicted"] = e.num_predicted;
  json["gt"] = e.num_true;
  json["acc"] = ToJson(e.accuracy_mm);
  json["comp"] = ToJson(e.completeness_mm);
  for (const Agreement& a : e.agreement) {
    const std::string mm = std::to_string(std::lround(a.threshold_mm));
    json["P" + mm] = a.precision;
    json["R" + mm] = a.recall;
    json["F" + mm] = a.f_score;
    json["IoU" + mm] = a.iou;
  }
  json["compv"] = ToJson(e.visible_completeness_mm);
  json["Rv5"] = ToJson(e.visible_recall_5);
  json["Rv10"] = ToJson(e.visible_recall_10);
  json["Fv5"] = ToJson(e.visible_f_score_5);
  json["tangent"] = ToJson(e.tangent_deg);
  json["dup"] = ToJson(e.duplication);
  json["whole"] = ToJson(e.whole);
  json["pure"] = ToJson(e.pure);
  json["curves"] = e.num_curves;
  json["gt_curves"] = nullptr;
  if (e.num_true_curves) json["gt_curves"] = *e.num_true_curves;
  json["kinds"] = nullptr;
  if (e.kinds) json["kinds"] = ToJson(*e.kinds);
  return json.dump() + "\n";
}

// Of the frame of the curves in a folder of results. alignment.json may be
// newer.
Result<std::optional<WorldAlignment>> AlignmentOfCurves(
    const fs::path& folder) {
  if (!fs::exists(folder / "curves.json")) return ReadAlignment(folder);
  CURVIX_ASSIGN_OR_RETURN(CurvesFile curves, ReadCurvesFile(folder));
  return std::move(curves.alignment);
}

// What curves are compared with.
struct HoldoutScene {
  Scene scene;
  fs::path model_path;
  fs::path alignment_path;  // of the frame of the scene; "": the model's
};

// The workspace; for curves of a file, with the cameras that their run refined,
// if these lie beside them and no model is given, and in their frame.
Result<HoldoutScene> ReadHoldoutScene(const RunSettings& settings,
                                      const fs::path& curves_path,
                                      RunProgress& progress) {
  CURVIX_ASSIGN_OR_RETURN(Workspace workspace, FindWorkspace(settings));
  const bool has_curves = !curves_path.empty();
  const fs::path folder = curves_path.parent_path();
  const bool has_model = FindColmapFormat(folder / "sparse").ok();
  if (has_curves && has_model && settings.input_path.empty()) {
    workspace.model_path = folder / "sparse";
  }
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene input, LoadWorkspaceScene(workspace));
  for (const std::string& note : input.notes) progress.Note(note);
  HoldoutScene result{std::move(input.scene), workspace.model_path, ""};
  if (!has_curves) return result;
  CURVIX_ASSIGN_OR_RETURN(const auto alignment, AlignmentOfCurves(folder));
  if (!alignment) return result;
  // The cameras of curves_model/ are in the frame of the curves.
  std::error_code ignored;
  if (!fs::equivalent(
          workspace.model_path, folder / kCurvesModelFolder, ignored)) {
    result.scene = MoveScene(alignment->world_from_model, result.scene);
  }
  result.alignment_path = folder / kAlignmentName;
  return result;
}

struct HoldoutResult {
  HoldoutScene input;
  int num_held_out = 0;  // views
  ResultSummary curves;
  ImageAgreement agreement;
};

std::string ShareRow(const char* name,
                     const std::optional<ShareAboveChance>& share) {
  const std::string start = Padded(name, 40);
  if (!share) return start + "        -        -        -\n";
  return start + Column(100 * share->share, 1) +
         Column(100 * share->chance, 1) + Column(100 * share->Lift(), 1) + "\n";
}

std::string TableOf(const HoldoutResult& result) {
  const ImageAgreement& agreement = result.agreement;
  const fs::path& alignment_path = result.input.alignment_path;
  return Plural(result.num_held_out, "view") + " held out, " +
         Plural(result.curves.num_curves, "curve") + " of total length " +
         ShortText(result.curves.total_length, 6) + "\nmodel " +
         result.input.model_path.string() +
         (alignment_path.empty()
              ? ""
              : ", in the frame of " + alignment_path.string()) +
         "\n\n" + Padded("in the images held out, %", 40) +
         "    share   chance     lift\n" +
         ShareRow("curves on a contour (precision)", agreement.precision) +
         ShareRow("the same where they should be seen",
                  agreement.expected_precision) +
         ShareRow("strong contours with a curve", agreement.strong_contours) +
         ShareRow("long lines with a curve", agreement.long_lines) +
         "median length of a curve: " +
         Column(agreement.median_piece_px, 1).substr(2) +
         " px\n\nChance: the same after moving by 12 pixels across. Lift: what "
         "is above chance, of\nwhat can be. Hidden curves count as being on no "
         "contour.\n";
}

std::string JsonOf(const HoldoutResult& result) {
  const ImageAgreement& agreement = result.agreement;
  Json json;
  json["held_out"] = result.num_held_out;
  json["curves"] = result.curves.num_curves;
  json["length"] = result.curves.total_length;
  json["piece_px"] = agreement.median_piece_px;
  json["model"] = result.input.model_path.string();
  json["alignment"] = result.input.alignment_path.string();
  const auto add = [&json](const std::string& name,
                           const std::optional<ShareAboveChance>& share) {
    if (!share) return;
    json[name] = 100 * share->share;
    json[name + "_chance"] = 100 * share->chance;
    json[name + "_lift"] = 100 * share->Lift();
  };
  add("precision", agreement.precision);
  add("expected_precision", agreement.expected_precision);
  add("strong", agreement.strong_contours);
  add("lines", agreement.long_lines);
  return json.dump() + "\n";
}

Result<CurveSet> ReconstructOthers(const Scene& scene,
                                   const Options& options,
                                   int every,
                                   RunProgress& progress) {
  CURVIX_ASSIGN_OR_RETURN(const std::vector<EdgeMap> edge_maps,
                          DetectEdges(scene, options, progress.Callback()));
  CURVIX_ASSIGN_OR_RETURN(
      Holdout holdout,
      ReconstructWithHoldout(
          scene, edge_maps, options, every, progress.Callback()));
  return std::move(holdout.reconstruction.curves);
}

}  // namespace

std::string EvaluationText(const Evaluation& evaluation, bool json) {
  return json ? JsonOf(evaluation) : TableOf(evaluation);
}

Result<std::string> EvaluateFiles(const std::filesystem::path& curves_path,
                                  const std::filesystem::path& truth_path,
                                  const EvaluationOptions& options,
                                  bool json) {
  CURVIX_ASSIGN_OR_RETURN(const CurveSet curves, ReadCurves(curves_path, {}));
  CURVIX_ASSIGN_OR_RETURN(const GroundTruth truth, ReadGroundTruth(truth_path));
  CURVIX_ASSIGN_OR_RETURN(const Evaluation evaluation,
                          EvaluateCurves(curves, truth, options));
  return EvaluationText(evaluation, json);
}

Result<std::string> RunHoldout(const RunSettings& settings,
                               const std::filesystem::path& curves_path,
                               int every,
                               bool json,
                               RunProgress& progress) {
  CURVIX_ASSIGN_OR_RETURN(HoldoutScene input,
                          ReadHoldoutScene(settings, curves_path, progress));
  const Scene& scene = input.scene;
  CURVIX_ASSIGN_OR_RETURN(const std::vector<int> view_idxs,
                          ViewsHeldOut(scene.views.size(), every));
  CURVIX_ASSIGN_OR_RETURN(
      const CurveSet curves,
      curves_path.empty()
          ? ReconstructOthers(scene, settings.options, every, progress)
          : ReadCurves(curves_path, scene));
  CURVIX_ASSIGN_OR_RETURN(
      const ImageAgreement agreement,
      CompareWithImages(curves.curves,
                        scene,
                        view_idxs,
                        settings.options.runtime.num_threads));
  progress.Finish("");
  const HoldoutResult result{std::move(input),
                             static_cast<int>(view_idxs.size()),
                             SummarizeCurves(curves),
                             agreement};
  return json ? JsonOf(result) : TableOf(result);
}

}  // namespace curvix
