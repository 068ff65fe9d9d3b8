// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/write_results.h"

#include <curvix/curve_io.h>
#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/colmap_model.h"
#include "io/curve_style.h"
#include "measuring/moved_curves.h"
#include "plugin/export/dimensions.h"
#include "plugin/export/small_images.h"
#include "plugin/export/viewer_html.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAlignedFrame =
    "coordinates are those of alignment.json";

// Index of the view that curves.svg is to show.
Result<int> ViewOfSvg(const std::string& image,
                      const std::vector<View>& views) {
  const auto view = std::ranges::find_if(views, [&](const View& candidate) {
    return image.empty() || candidate.name == image;
  });
  if (view != views.end()) return static_cast<int>(view - views.begin());
  return Status::InvalidArgument(
      "svg_image is " + image + ", which is no image of the model" +
      (views.empty() ? "" : "; " + views.front().name + " is one"));
}

Status WriteSvg(const CurveRecord& record,
                const std::string& image,
                const fs::path& path) {
  CURVIX_ASSIGN_OR_RETURN(const int view_idx,
                          ViewOfSvg(image, record.scene.views));
  return WriteProjection(path, record.curves, record.scene, view_idx);
}

bool AsksFor(const OutputSettings& settings, const std::string& format) {
  return std::ranges::find(settings.formats, format) != settings.formats.end();
}

void AddSample(const CurveRecord& record,
               const CurveSample& sample,
               const std::array<std::uint8_t, 3>& color,
               ColmapModel& model) {
  std::vector<std::pair<EdgeRef, SupportingEdge>> edges;
  for (const EdgeRef& ref : sample.support) {
    const auto edge = FindSupportingEdge(
        record.scene, sample, ref, record.curves.EdgeOf(ref));
    if (edge && edge->pixel.allFinite()) edges.emplace_back(ref, *edge);
  }
  if (edges.size() < 2) return;
  ColmapPoint3D point;
  point.point3D_id = model.points.size() + 1;
  point.position = sample.position;
  point.rgb = color;
  point.error = 0;
  for (const auto& [ref, edge] : edges) {
    AddObservation(edge.pixel,
                   model.images[static_cast<std::size_t>(ref.view_idx)],
                   point);
    point.error += std::abs(edge.residual_px);
  }
  point.error /= static_cast<double>(edges.size());
  model.points.push_back(std::move(point));
}

// Whether the source of `curve`, which is being visited, has the 2D edges of
// its support.
bool HasEdges(const CurveSource& curves, const Curve& curve) {
  return std::ranges::any_of(curve.samples, [&](const CurveSample& sample) {
    return std::ranges::any_of(sample.support, [&](const EdgeRef& ref) {
      return curves.EdgeOf(ref).position.allFinite();
    });
  });
}

// The cameras and poses of the scene; every sample of a curve with support in
// two views or more is a point, numbered from 1, curve after curve, with the
// colour of its curve, its mean reprojection error, and a track through the
// edges that support it, which are the 2D points of the images. For COLMAP, and
// for programs that start from its points.
Status WriteModel(const CurveRecord& record, const fs::path& path) {
  ColmapModel model = ModelOfViews(record.scene);
  bool has_edges = record.curves.size() == 0;
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    has_edges = has_edges || HasEdges(record.curves, curve);
    for (const CurveSample& sample : curve.samples) {
      AddSample(record, sample, CurveColor(id), model);
    }
  });
  CURVIX_RETURN_IF_ERROR(record.curves.status());
  if (!has_edges) {
    return Status::InvalidArgument(
        "The 2D edges behind the curves are not known, so that a COLMAP model "
        "of them would have no points; write it from the run that makes the "
        "curves, since curves that were read from a file have none");
  }
  return WriteColmapModel(model, path);
}

// STEP knows units: curves whose unit is known are written in millimetres.
Status WriteStep(const CurveRecord& record, const fs::path& path) {
  const auto millimetres = record.alignment == nullptr
                               ? std::nullopt
                               : MillimetresPer(record.alignment->unit);
  if (!millimetres) return WriteDrawing(path, record.fitted);
  Similarity3 enlarge;
  enlarge.scale = *millimetres;
  return WriteDrawing(path, MoveFits(enlarge, record.fitted));
}

Status WriteOverlays(const CurveRecord& record,
                     int count,
                     const fs::path& folder) {
  for (const int idx : SpreadViews(record.scene, count)) {
    const View& view = record.scene.views[static_cast<std::size_t>(idx)];
    const Result<std::string> png =
        OverlayPng(record.curves, record.scene, idx);
    CURVIX_RETURN_IF_ERROR(record.curves.status());
    if (!png.ok()) return png.status();
    fs::path path = folder / view.name;
    path += ".png";
    fs::create_directories(path.parent_path());
    CURVIX_RETURN_IF_ERROR(WriteFileAtomically(path, *png));
  }
  return {};
}

Flag FormatsFlag(std::vector<std::string>* formats) {
  std::vector<std::string> known;
  for (const OutputFormat& format : OutputFormats()) {
    known.emplace_back(format.name);
  }
  Flag flag;
  flag.name = "output_formats";
  flag.help = "files to write, with commas between";
  flag.default_value = boost::algorithm::join(*formats, ",");
  flag.range = boost::algorithm::join(known, ", ");
  flag.set = [=, range = flag.range](const std::string& text) -> Status {
    std::vector<std::string> names;
    for (const std::string_view part : SplitAt(text, ',')) {
      const std::string& name = names.emplace_back(part);
      if (std::ranges::find(known, name) == known.end()) {
        return Status::InvalidArgument(
            "output_formats has \"" + name +
            "\"; it takes, with commas between: " + range);
      }
    }
    *formats = std::move(names);
    return {};
  };
  return flag;
}

}  // namespace

const std::vector<OutputFormat>& OutputFormats() {
  static const std::vector<OutputFormat> formats = {
      {"ply", "curves.ply", "lines: MeshLab, Blender, Open3D; points: COLMAP"},
      {"obj", "curves.obj", "lines: CloudCompare, ParaView, MeshLab, Blender"},
      {"pcd", "curves.pcd", "points with tangents: PCL"},
      {"txt", "curves.txt", "text, like COLMAP's points3D.txt"},
      {"json", "curves.json", "everything: fits, junctions, 2D support"},
      {"csv", "dimensions.csv", "lengths, radii, angles: spreadsheets"},
      {"dxf", "curves.dxf", "lines, arcs, circles, ellipses, splines: CAD"},
      {"step", "curves.step", "the same in STEP: CAD"},
      {"vtp", "curves.vtp", "lines with data: ParaView, VTK"},
      {"glb", "curves.glb", "coloured lines: glTF viewers"},
      {"svg", "curves.svg", "the curves as one view sees them: browsers"},
      {"colmap", kCurvesModelFolder, "samples as points with tracks: COLMAP"},
      {"html", "viewer.html", "the curves in a browser"}};
  return formats;
}

FlagSection OutputFlags(OutputSettings* settings) {
  return {"Output",
          {FormatsFlag(&settings->formats),
           Advanced(TextFlag("svg_image",
                             &settings->svg_image,
                             "name of the image drawn in curves.svg; default: "
                             "the first")),
           RowFlag({.name = "write_overlays",
                    .field = &settings->num_overlays,
                    .max = 10000,
                    .help = "draw the curves over so many well-spread "
                            "images, into overlays/"})}};
}

Status CheckOutput(const OutputSettings& settings, const Scene& scene) {
  if (!AsksFor(settings, "svg")) return {};
  return ViewOfSvg(settings.svg_image, scene.views).status();
}

Status WriteFormat(const CurveRecord& record,
                   const OutputSettings& settings,
                   int num_threads,
                   const std::string& format,
                   const fs::path& path) {
  if (format == "json" || format == "csv" || format == "html") {
    FileWriter file(path);
    if (format == "json") EncodeCurvesJson(record, num_threads, file.Sink());
    if (format == "csv") EncodeDimensions(record, file.Sink());
    if (format == "html") EncodeViewerHtml(record, num_threads, file.Sink());
    const Status read = record.curves.status();
    return read.ok() ? file.Finish() : read;
  }
  if (format == "dxf") {
    return WriteDrawing(
        path,
        record.fitted,
        record.alignment == nullptr ? "" : record.alignment->unit);
  }
  if (format == "step") return WriteStep(record, path);
  if (format == "svg") return WriteSvg(record, settings.svg_image, path);
  if (format == "colmap") return WriteModel(record, path);
  return WriteCurves(path,
                     record.curves,
                     record.scene,
                     record.alignment == nullptr ? "" : kAlignedFrame);
}

Result<std::vector<std::string>> WriteResults(const CurveRecord& record,
                                              const OutputSettings& settings,
                                              int num_threads,
                                              const fs::path& folder) {
  std::vector<std::string> files;
  for (const OutputFormat& format : OutputFormats()) {
    if (!AsksFor(settings, format.name)) continue;
    CURVIX_RETURN_IF_ERROR(WriteFormat(
        record, settings, num_threads, format.name, folder / format.file));
    files.emplace_back(format.file);
  }
  if (settings.num_overlays > 0) {
    CURVIX_RETURN_IF_ERROR(
        WriteOverlays(record, settings.num_overlays, folder / kOverlaysFolder));
    files.emplace_back(kOverlaysFolder);
  }
  return files;
}

}  // namespace curvix
