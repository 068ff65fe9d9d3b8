// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/draw_workspace.h"

#include <curvix/fitting.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/infinity.h"
#include "base/text_fields.h"
#include "drawing/dimension_marks.h"
#include "drawing/drawing_plane.h"
#include "drawing/sheet.h"
#include "io/sheet_formats.h"
#include "measuring/moved_curves.h"
#include "plugin/align/curves_file.h"
#include "plugin/base/staged_output.h"
#include "plugin/base/text.h"
#include "plugin/draw/choose_dimensions.h"
#include "plugin/draw/choose_plane.h"
#include "plugin/draw/drawn_views.h"
#include "plugin/draw/map_file.h"
#include "plugin/draw/rectified_photograph.h"
#include "plugin/export/drawing_files.h"
#include "plugin/export/write_results.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Large coordinates with two digits behind the point.
std::string DepthText(double depth) {
  return std::abs(depth) < 1e4 ? ShortText(depth, 6) : FixedText(depth, 2);
}

// "front (xz)".
std::string ViewName(const std::string& plane) {
  const std::string name = plane == "xy"   ? "plan"
                           : plane == "xz" ? "front"
                           : plane == "yz" ? "side"
                                           : "plane";
  return name + " (" + plane + ")";
}

// The name of the files, without extension.
std::string NameOf(const DrawSettings& settings) {
  std::string name = settings.name;
  if (name.empty()) {
    name = "drawing_" + settings.plane;
    if (!settings.slice.empty()) name += "_section";
    if (settings.from_behind) name += "_from_behind";
  }
  for (char& c : name) c = c == ' ' || c == ',' ? '_' : c;
  return name;
}

Status CheckName(const std::string& name) {
  if (fs::path(name).filename() != name || name.front() == '.') {
    return Status::InvalidArgument(
        "--name is \"" + name +
        "\"; it takes the name of a file, without folders");
  }
  for (const OutputFormat& format : OutputFormats()) {
    for (const char* ending : {".dxf", ".svg", ".jpg", ".gpkg", ".geojson"}) {
      if (name + ending != format.file) continue;
      return Status::InvalidArgument(
          "--name is \"" + name + "\", but " + format.file +
          " is a file of the curves; choose another name");
    }
  }
  return {};
}

class Drafter {
 public:
  Drafter(const DrawSettings& settings, RunProgress& progress)
      : settings_(settings), progress_(progress), name_(NameOf(settings)) {}

  Result<std::string> Run();

 private:
  // Of the curves, for what photographs show from one side.
  bool NeedsSamples() const {
    return settings_.hidden != "solid" || !settings_.photograph.empty() ||
           HasPlaneOfNodes(settings_.plane);
  }
  Status Read();
  Status TakePlanes();
  // kInvalidArgument, with the depths of all curves.
  Status NothingInSlice(const DrawingPlane& plane) const;
  // What the view shows of the curves, without hidden ones if there are others.
  FittedCurves ShownBy(const DrawnView& view) const;
  Status TakePhotograph();
  Status LayOut();
  Status Write();
  std::string Subtitle() const;

  const DrawSettings& settings_;
  RunProgress& progress_;
  const std::string name_;  // of the files
  Workspace workspace_;
  Scene scene_;  // in the frame of the curves
  CurvesFile curves_;
  DrawWindow window_;
  std::vector<DrawnView> views_;
  std::string photograph_;  // its name
  std::string jpeg_;
  std::optional<SheetPicture> picture_;
  Sheet sheet_;
  std::string text_;
};

Status Drafter::Read() {
  CURVIX_ASSIGN_OR_RETURN(workspace_, FindInputOfResults(settings_.run));
  CURVIX_ASSIGN_OR_RETURN(
      curves_, ReadCurvesFile(workspace_.output_path, NeedsSamples()));
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene input, ReadRefinedScene(workspace_));
  for (const std::string& note : input.notes) progress_.Note(note);
  scene_ = std::move(input.scene);
  if (curves_.alignment) {
    scene_ = MoveScene(curves_.alignment->world_from_model, std::move(scene_));
  }
  window_ = *ParseWindow(settings_.slice, settings_.crop);
  return {};
}

Status Drafter::TakePlanes() {
  CURVIX_ASSIGN_OR_RETURN(std::vector<DrawingPlane> planes,
                          ChoosePlanes(settings_.plane, curves_, scene_));
  for (DrawingPlane& plane : planes) {
    if (settings_.from_behind) plane = FromBehind(plane);
    if (!AxisPlane(plane.name)) {
      plane.depth_axis = plane.toward;
    } else if (curves_.alignment) {
      // Sheets hold all digits of large coordinates.
      plane.origin -= curves_.alignment->offset;
    }
    views_.push_back({plane, window_});
  }
  FillViews({curves_,
             scene_,
             settings_.hidden,
             settings_.dimensions,
             settings_.crop.empty()},
            &views_);
  if (!settings_.slice.empty() && views_.front().curves.empty()) {
    return NothingInSlice(views_.front().plane);
  }
  if (!(curves_.alignment && curves_.alignment->has_rotation) &&
      AxisPlane(settings_.plane.substr(0, 2))) {
    progress_.Note(
        "x, y and z are those of the model, which need not be level; "
        "'colmap_curvix align --axes auto' turns them");
  }
  return {};
}

Status Drafter::NothingInSlice(const DrawingPlane& plane) const {
  double low = kInfinity;
  double high = -kInfinity;
  for (const FittedCurve& curve : curves_.fitted.curves) {
    for (const CurveFit& fit : curve.fits) {
      for (const double t : {0.0, 0.5, 1.0}) {
        const double depth = plane.Depth(PointAt(fit, t));
        low = std::min(low, depth);
        high = std::max(high, depth);
      }
    }
  }
  return Status::InvalidArgument(
      "There is nothing to draw from " + DepthText(window_.depth.from) +
      " to " + DepthText(window_.depth.to) + "; " + plane.depth_name +
      " of the curves is from " + DepthText(low) + " to " + DepthText(high));
}

FittedCurves Drafter::ShownBy(const DrawnView& view) const {
  const auto in_window = [&](FittedCurves fitted) {
    for (FittedCurve& curve : fitted.curves) {
      std::erase_if(curve.fits, [&](const CurveFit& fit) {
        return PartsInWindow(fit, view.plane, view.window).empty();
      });
    }
    std::erase_if(fitted.curves,
                  [](const FittedCurve& curve) { return curve.fits.empty(); });
    return fitted;
  };
  FittedCurves shown =
      in_window(WithoutHidden(curves_, view.plane.toward, scene_));
  return shown.curves.empty() ? in_window(curves_.fitted) : shown;
}

Status Drafter::TakePhotograph() {
  if (settings_.photograph.empty()) return {};
  const DrawnView& view = views_.front();
  const Eigen::AlignedBox2d bounds = BoundsOf(view.curves);
  if (bounds.isEmpty()) return {};
  const bool through_nodes = view.plane.name.starts_with("nodes");
  const PictureArea area{view.plane,
                         through_nodes ? 0
                                       : MainDepth(ShownBy(view),
                                                   view.plane,
                                                   window_.depth.from,
                                                   window_.depth.to),
                         bounds};
  std::optional<std::size_t> chosen;
  if (settings_.photograph == "auto") {
    chosen = BestViewOf(scene_, area);
    if (!chosen)
      return Status::InvalidArgument("No image shows the plane from this side");
  }
  for (std::size_t i = 0; i < scene_.views.size(); ++i) {
    if (scene_.views[i].name == settings_.photograph) chosen = i;
  }
  if (!chosen || !ShowsFront(scene_, scene_.views[*chosen], area)) {
    return Status::InvalidArgument(
        "--photograph is " + settings_.photograph + ", which " +
        (chosen ? "does not show the plane from this side"
                : "is no image of the model") +
        "; --photograph auto chooses one that shows it");
  }
  CURVIX_ASSIGN_OR_RETURN(
      RectifiedPhotograph photograph,
      Rectify(
          scene_, *chosen, area, settings_.run.options.runtime.num_threads));
  photograph_ = scene_.views[*chosen].name;
  jpeg_ = std::move(photograph.jpeg);
  picture_ = std::move(photograph.place);
  picture_->file = name_ + ".jpg";
  text_ += "Photograph: " + photograph_ + ", right where " +
           view.plane.depth_name + " is " + DepthText(area.depth) + "\n";
  return {};
}

std::string Drafter::Subtitle() const {
  std::string text;
  for (const DrawnView& view : views_) {
    text += (text.empty() ? "" : ", ") + ViewName(view.plane.name) +
            (view.plane.is_from_behind ? " from behind" : "");
  }
  if (!settings_.slice.empty()) {
    text += ", " + views_.front().plane.depth_name + " from " +
            DepthText(window_.depth.from) + " to " +
            DepthText(window_.depth.to);
  }
  if (!photograph_.empty()) text += ", photograph " + photograph_;
  if (curves_.alignment && curves_.alignment->has_scale) {
    text += ", lengths known to " +
            ShortText(100 * curves_.alignment->scale_sigma(), 2) + " %";
  }
  return text;
}

Status Drafter::LayOut() {
  SheetSettings sheet;
  sheet.title = settings_.title;
  if (sheet.title.empty()) {
    sheet.title = fs::absolute(settings_.run.workspace_path / ".")
                      .lexically_normal()
                      .parent_path()
                      .filename()
                      .string();
  }
  sheet.title = ValidUtf8(sheet.title);
  sheet.subtitle = ValidUtf8(Subtitle());
  sheet.paper = settings_.paper;
  sheet.has_dimensions = settings_.dimensions;
  if (curves_.alignment) sheet.unit = curves_.alignment->unit;
  sheet.millimetres = MillimetresPer(sheet.unit).value_or(0);
  if (!settings_.scale.empty()) {
    sheet.denominator = *ParseScale(settings_.scale);
  }
  std::vector<SheetCurve> curves;
  for (const DrawnView& view : views_) {
    curves.insert(curves.end(), view.curves.begin(), view.curves.end());
  }
  CURVIX_ASSIGN_OR_RETURN(sheet_, LaySheet(sheet, std::move(curves), picture_));
  std::vector<Eigen::AlignedBox2d> bounds;
  for (const DrawnView& view : views_) bounds.push_back(BoundsOf(view.curves));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    std::vector<Eigen::AlignedBox2d> others = bounds;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    PlaceDimensions(
        ChooseDimensions(views_[i].measured), bounds[i], others, sheet_);
  }
  return {};
}

Status Drafter::Write() {
  Result<StagedOutput> output = StagedOutput::Create(workspace_.output_path);
  // --output_path is also where the curves are read.
  if (!output.ok()) {
    return Status::InvalidArgument(output.status().message() +
                                   ", a copy of this one");
  }
  std::vector<std::pair<std::string, std::string>> files = {
      {name_ + ".dxf", EncodeDxfSheet(sheet_)},
      {name_ + ".svg", EncodeSvgSheet(sheet_)}};
  if (picture_) files.emplace_back(picture_->file, std::move(jpeg_));
  text_ += "Written to " + workspace_.output_path.string() + ":";
  for (const auto& [file, bytes] : files) {
    CURVIX_RETURN_IF_ERROR(WriteFileAtomically(output->folder() / file, bytes));
    text_ += " " + file;
  }
  const DrawingPlane& plane = views_.front().plane;
  const bool is_map = views_.size() == 1 && curves_.alignment &&
                      plane.right == Eigen::Vector3d::UnitX() &&
                      plane.up == Eigen::Vector3d::UnitY();
  for (const auto& [is_wanted, ending] :
       {std::pair(settings_.geopackage, ".gpkg"),
        {settings_.geojson, ".geojson"}}) {
    if (!is_wanted) continue;
    CURVIX_RETURN_IF_ERROR(WriteMapFile(output->folder() / files.front().first,
                                        is_map ? curves_.alignment->crs : "",
                                        output->folder() / (name_ + ending)));
    text_ += " " + name_ + ending;
  }
  text_ += "\n";
  return output->Publish(FilesOfDrawing(workspace_.output_path, name_));
}

Result<std::string> Drafter::Run() {
  CURVIX_RETURN_IF_ERROR(Read());
  CURVIX_RETURN_IF_ERROR(TakePlanes());
  CURVIX_RETURN_IF_ERROR(TakePhotograph());
  CURVIX_RETURN_IF_ERROR(LayOut());
  const auto num_hidden = std::ranges::count_if(
      sheet_.curves, [](const SheetCurve& curve) { return curve.is_hidden; });
  int num_unknown = 0;
  std::size_t num_far = 0;
  for (const DrawnView& view : views_) {
    num_unknown += view.num_unknown;
    num_far += view.num_far;
  }
  text_ += "Drew " + Plural(sheet_.curves.size(), "primitive") + ": " +
           Subtitle() + ", " + sheet_.scale_text + "\n";
  if (num_far > 0) {
    text_ += "Left out, far from the others: " + std::to_string(num_far) +
             " (--crop all draws them)\n";
  }
  if (settings_.hidden == "dashed") {
    text_ += "Hidden: " + std::to_string(num_hidden);
    if (num_unknown > 0) {
      text_ += "; not known: " + std::to_string(num_unknown) +
               ", at which fewer than three photographs look from this side";
    }
    text_ += "\n";
  }
  CURVIX_RETURN_IF_ERROR(Write());
  return std::move(text_);
}

}  // namespace

Status Check(const DrawSettings& s) {
  CURVIX_RETURN_IF_ERROR(CheckPlanes(s.plane));
  CURVIX_RETURN_IF_ERROR(ParseWindow(s.slice, s.crop).status());
  CURVIX_RETURN_IF_ERROR(CheckName(NameOf(s)));
  if (!s.scale.empty() && !ParseScale(s.scale)) {
    return Status::InvalidArgument("--scale is \"" + s.scale +
                                   "\"; it takes a scale such as 1:50 or 2:1");
  }
  const bool is_cropped = !s.crop.empty() && s.crop != "all";
  if (s.plane.find(',') != s.plane.npos &&
      (is_cropped || !s.slice.empty() || !s.photograph.empty())) {
    return Status::InvalidArgument(
        "--slice, --crop and --photograph need a single --plane");
  }
  return {};
}

Result<std::string> DrawWorkspace(const DrawSettings& settings,
                                  RunProgress& progress) {
  return Drafter(settings, progress).Run();
}

}  // namespace curvix
