// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves and sheets as DXF.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/angles.h"
#include "drawing/dimension_marks.h"
#include "io/curve_formats.h"
#include "io/drawing_layers.h"
#include "io/dxf_writer.h"
#include "io/sheet_formats.h"

namespace curvix {
namespace {

constexpr char kFrameLayer[] = "FRAME";
constexpr char kPhotographLayer[] = "PHOTOGRAPH";
constexpr char kDimensionsLayer[] = "DIMENSIONS";

std::vector<DrawingLayer> KindLayers() {
  return {kDrawingLayers.begin(), kDrawingLayers.end()};
}

// ARC and CIRCLE live in a frame that follows from the normal alone: AutoCAD's
// arbitrary axis algorithm.
Eigen::Matrix3d FrameOfNormal(const Eigen::Vector3d& normal) {
  constexpr double kNearZ = 1.0 / 64;
  const bool is_near_z =
      std::abs(normal.x()) < kNearZ && std::abs(normal.y()) < kNearZ;
  Eigen::Matrix3d frame;
  frame.col(0) =
      (is_near_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ())
          .cross(normal)
          .normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

double AngleIn(const Eigen::Matrix3d& frame, const Eigen::Vector3d& offset) {
  const Eigen::Vector3d local = frame.transpose() * offset;
  const double angle = RadToDeg(std::atan2(local.y(), local.x()));
  return angle < 0 ? angle + 360 : angle;
}

void PutArc(const CurveFit& fit, bool dashed, DxfWriter& w) {
  w.BeginEntity(
      fit.closed ? "CIRCLE" : "ARC", LayerOf(fit.curve_kind).name, dashed);
  const Eigen::Vector3d normal = NormalOf(fit);
  const Eigen::Matrix3d frame = FrameOfNormal(normal);
  w.Put(100, "AcDbCircle");
  w.Put(10, Eigen::Vector3d(frame.transpose() * fit.center));
  w.Put(40, fit.major.norm());
  w.Put(210, normal);
  if (fit.closed) return;
  w.Put(100, "AcDbArc");
  w.Put(50, AngleIn(frame, PointAt(fit, 0) - fit.center));
  w.Put(51, AngleIn(frame, PointAt(fit, 1) - fit.center));
}

void PutEllipse(const CurveFit& fit, bool dashed, DxfWriter& w) {
  w.BeginEntity("ELLIPSE", LayerOf(fit.curve_kind).name, dashed);
  w.Put(100, "AcDbEllipse");
  w.Put(10, fit.center);
  w.Put(11, fit.major);
  w.Put(210, NormalOf(fit));
  w.Put(40, fit.minor.norm() / fit.major.norm());
  w.Put(41, fit.closed ? 0.0 : fit.start_angle);
  w.Put(42, fit.closed ? 2 * kPi : fit.end_angle);
}

void PutSpline(const CurveFit& fit, bool dashed, DxfWriter& w) {
  constexpr int kDegree = 3;
  w.BeginEntity("SPLINE", LayerOf(fit.curve_kind).name, dashed);
  w.Put(100, "AcDbSpline");
  w.Put(210, Eigen::Vector3d(0, 0, 1));
  // Open also where it ends where it begins: for closed ones LibreCAD does not
  // use the knots.
  w.Put(70, 0);
  w.Put(71, kDegree);
  w.Put(72, static_cast<int>(fit.knots.size()));
  w.Put(73, static_cast<int>(fit.control_points.size()));
  w.Put(74, 0);
  w.Put(42, 1e-10);
  w.Put(43, 1e-10);
  for (const double knot : fit.knots) w.Put(40, knot);
  for (const Eigen::Vector3d& point : fit.control_points) w.Put(10, point);
}

void PutFit(const CurveFit& fit, bool dashed, DxfWriter& w) {
  switch (fit.kind) {
    case FitKind::kLine:
      w.BeginEntity("LINE", LayerOf(fit.curve_kind).name, dashed);
      w.Put(100, "AcDbLine");
      w.Put(10, fit.start);
      w.Put(11, fit.end);
      return;
    case FitKind::kArc:
      return PutArc(fit, dashed, w);
    case FitKind::kEllipse:
      return PutEllipse(fit, dashed, w);
    case FitKind::kSpline:
      return PutSpline(fit, dashed, w);
  }
}

// What shows all fits from above, with a margin.
DxfView ViewOf(const FittedCurves& fitted) {
  constexpr int kSteps = 64;
  constexpr double kMargin = 1.1;
  Eigen::AlignedBox2d box;
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) {
      const int steps = fit.kind == FitKind::kLine ? 1 : kSteps;
      for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        box.extend(PointAt(fit, t).head<2>().eval());
      }
    }
  }
  DxfView view;
  if (box.isEmpty()) return view;
  view.center = box.center();
  const double size = box.sizes().maxCoeff();
  if (size > 0) view.height = kMargin * size;
  return view;
}

// Appends a unit of UTF-16 as \U+00E4, which every code page has.
void AppendEscape(unsigned unit, std::string& out) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "\\U+%04X", unit);
  out += text.data();
}

// With escapes for the characters beyond ASCII, for "^", which begins control
// characters, and for "%%", which begins symbols.
std::string DxfText(std::string_view utf8) {
  std::string out;
  for (std::size_t i = 0; i < utf8.size();) {
    const bool follows_percent = i > 0 && utf8[i - 1] == '%';
    const auto first = static_cast<unsigned char>(utf8[i++]);
    if (first == '%' && follows_percent) {
      AppendEscape(first, out);
      continue;
    }
    if (first < 0x80) {
      out += first < 0x20 ? ' ' : static_cast<char>(first);
      if (first == '^') out += ' ';
      continue;
    }
    const int num_more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    unsigned code = first & (0x3fU >> num_more);
    for (int k = 0; k < num_more && i < utf8.size(); ++k) {
      code = code << 6U | (static_cast<unsigned char>(utf8[i++]) & 0x3fU);
    }
    if (code >= 0x10000) {
      code -= 0x10000;
      AppendEscape(0xd800 + (code >> 10U), out);
      code = 0xdc00 + (code & 0x3ffU);
    }
    AppendEscape(code, out);
  }
  return out;
}

Eigen::Vector3d OnSheet(const Eigen::Vector2d& x) { return {x.x(), x.y(), 0}; }

// Returns the handle of the IMAGE.
std::string PutImage(const SheetPicture& picture, DxfWriter& w) {
  w.Put(0, "IMAGE");
  std::string handle = w.PutHandle();
  w.PutOwner(kPhotographLayer);
  w.Put(100, "AcDbRasterImage");
  w.Put(90, 0);
  w.Put(10, OnSheet(picture.corner));
  w.Put(11, Eigen::Vector3d(picture.pixel, 0, 0));
  w.Put(12, Eigen::Vector3d(0, picture.pixel, 0));
  const Eigen::Vector2d size = picture.size.cast<double>();
  w.Put(13, size);
  w.Put(340, kDxfPictureHandle);
  w.Put(70, 3);
  w.Put(280, 0);
  w.Put(281, 50);
  w.Put(282, 50);
  w.Put(283, 50);
  w.Put(360, kDxfReactorHandle);
  w.Put(71, 1);
  w.Put(91, 2);
  w.Put(14, Eigen::Vector2d(-0.5, -0.5));
  w.Put(14, Eigen::Vector2d(size - Eigen::Vector2d(0.5, 0.5)));
  return handle;
}

// With an angle, the text is centred above its start.
void PutText(const Sheet& sheet,
             const SheetText& text,
             const char* layer,
             std::optional<double> angle,
             DxfWriter& w) {
  w.BeginEntity("TEXT", layer);
  w.Put(100, "AcDbText");
  const Eigen::Vector3d at = OnSheet(sheet.FromPaper(text.start));
  w.Put(10, at);
  w.Put(40, text.height / sheet.scale);
  w.Put(1, DxfText(text.text));
  if (angle) {
    w.Put(50, RadToDeg(*angle));
    w.Put(72, 1);
    w.Put(11, at);
  }
  w.Put(100, "AcDbText");
}

void PutLine(const Sheet& sheet,
             const SheetLine& line,
             const char* layer,
             DxfWriter& w) {
  w.BeginEntity("LINE", layer);
  w.Put(100, "AcDbLine");
  w.Put(10, OnSheet(sheet.FromPaper(line.start)));
  w.Put(11, OnSheet(sheet.FromPaper(line.end)));
}

// What programs that do not draw dimensions themselves show of them.
std::vector<DxfBlock> BlocksOf(const Sheet& sheet, DxfWriter& w) {
  std::vector<DxfBlock> blocks;
  for (const SheetDimension& dimension : sheet.dimensions) {
    const DimensionMarks marks = MarksOf(dimension, sheet);
    const std::string handle = w.NewHandle();
    w.SetBlock(handle);
    for (const SheetLine& line : marks.lines) {
      PutLine(sheet, line, kDimensionsLayer, w);
    }
    PutText(sheet, marks.text, kDimensionsLayer, marks.angle, w);
    blocks.push_back(
        {"*D" + std::to_string(blocks.size() + 1), handle, w.Take()});
  }
  w.SetBlock("");
  return blocks;
}

void PutDimension(const Sheet& sheet,
                  const SheetDimension& dimension,
                  const std::string& block,
                  DxfWriter& w) {
  const DimensionMarks marks = MarksOf(dimension, sheet);
  const bool is_radius = dimension.is_radius;
  w.BeginEntity("DIMENSION", kDimensionsLayer);
  w.Put(100, "AcDbDimension");
  w.Put(2, block);
  // The centre, or where the dimension line ends.
  w.Put(10,
        OnSheet(is_radius ? dimension.a : sheet.FromPaper(marks.lines[0].end)));
  // Its middle.
  const Eigen::Vector2d up(-std::sin(marks.angle), std::cos(marks.angle));
  w.Put(
      11,
      OnSheet(sheet.FromPaper(marks.text.start + marks.text.height / 2 * up)));
  w.Put(70, (is_radius ? 4 : 1) + 32);
  w.Put(1, DxfText(dimension.text));
  w.Put(71, 5);
  w.Put(42, dimension.value);
  w.Put(3, "Standard");
  w.Put(100, is_radius ? "AcDbRadialDimension" : "AcDbAlignedDimension");
  if (is_radius) {
    w.Put(15, OnSheet(dimension.b));
    w.Put(40, (marks.lines[0].end - marks.lines[0].start).norm() / sheet.scale);
  } else {
    w.Put(13, OnSheet(dimension.a));
    w.Put(14, OnSheet(dimension.b));
  }
}

}  // namespace

void EncodeDxfDrawing(const FittedCurves& fitted,
                      std::string_view unit,
                      const ByteSink& sink) {
  DxfWriter w;
  PutDxfTables(KindLayers(), ViewOf(fitted), 1, {}, w);
  int next_handle = w.next_handle();
  for (const FittedCurve& curve : fitted.curves) {
    next_handle += static_cast<int>(curve.fits.size());
  }
  sink(DxfHeader(next_handle, unit, 1, nullptr));
  w.BeginSection("ENTITIES");
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) PutFit(fit, false, w);
    sink(w.Take());
  }
  w.Put(0, "ENDSEC");
  PutDxfObjects(nullptr, w);
  sink(w.Take());
}

std::string EncodeDxfSheet(const Sheet& sheet) {
  DxfWriter w;
  std::vector<DrawingLayer> layers = KindLayers();
  layers.push_back({kFrameLayer, 7, 0.25});
  layers.push_back({kPhotographLayer, 7, 0});
  layers.push_back({kDimensionsLayer, 1, 0.18});
  const double mm = 1 / sheet.scale;
  const std::vector<DxfBlock> blocks = BlocksOf(sheet, w);
  PutDxfTables(
      layers,
      {sheet.FromPaper(sheet.size / 2), sheet.size.maxCoeff() / sheet.scale},
      mm,
      blocks,
      w);
  w.BeginSection("ENTITIES");
  DxfPicture picture;
  if (sheet.picture) {
    picture = {DxfText(sheet.picture->file),
               sheet.picture->size.cast<double>(),
               PutImage(*sheet.picture, w)};
  }
  for (const auto& [fit, is_hidden] : sheet.curves) PutFit(fit, is_hidden, w);
  for (const SheetLine& line : sheet.lines) {
    PutLine(sheet, line, kFrameLayer, w);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    PutDimension(sheet, sheet.dimensions[i], blocks[i].name, w);
  }
  for (const SheetText& text : sheet.texts) {
    PutText(sheet, text, kFrameLayer, std::nullopt, w);
  }
  w.Put(0, "ENDSEC");
  PutDxfObjects(sheet.picture ? &picture : nullptr, w);
  // mm on the paper to drawing units.
  const double to_units = 1 / (sheet.scale * sheet.denominator);
  const DxfPaper paper{to_units * sheet.size,
                       -sheet.corner / sheet.denominator,
                       1 / sheet.denominator};
  return DxfHeader(w.next_handle(),
                   sheet.unit,
                   mm,
                   sheet.denominator > 0 ? &paper : nullptr) +
         w.Take();
}

}  // namespace curvix
