// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves for CAD.
#include "io/dxf_drawing.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "base/angles.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

struct Layer {
  const char* name;
  int color;  // AutoCAD's index
};

constexpr std::array<Layer, 6> kLayers = {{{"0", 7},
                                           {"LINES", 7},
                                           {"ARCS", 3},
                                           {"CIRCLES", 1},
                                           {"ELLIPSES", 6},
                                           {"SPLINES", 5}}};

// Fixed handles of what entities and tables refer to.
constexpr char kBlockRecords[] = "1";
constexpr char kModelSpace[] = "1F";
constexpr char kPaperSpace[] = "1E";
constexpr int kFirstFreeHandle = 0x100;

// Pairs of a group code and a value, each on its own line.
class Writer {
 public:
  void Put(int code, std::string_view value) {
    out_ += std::to_string(code) + '\n';
    out_ += value;
    out_ += '\n';
  }
  void Put(int code, double value) {
    std::string text;
    AppendNumber(value, text);
    // A number without point is not a real for every reader.
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    Put(code, text);
  }
  void Put(int code, int value) { Put(code, std::to_string(value)); }
  void Put(int code, const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) Put(code + 10 * i, v[i]);
  }
  void PutHandle() {
    std::array<char, 16> text;
    std::snprintf(text.data(), text.size(), "%X", next_handle_++);
    Put(5, text.data());
  }
  // What was put since the last time.
  std::string Take() { return std::exchange(out_, {}); }
  int next_handle() const { return next_handle_; }

 private:
  std::string out_;
  int next_handle_ = kFirstFreeHandle;
};

void BeginTable(const char* name, const char* handle, int count, Writer& w) {
  w.Put(0, "TABLE");
  w.Put(2, name);
  w.Put(5, handle);
  w.Put(330, "0");
  w.Put(100, "AcDbSymbolTable");
  w.Put(70, count);
}

// The start of a record of the table that has `owner` as its handle.
void BeginRecord(const char* type,
                 const char* handle,
                 const char* owner,
                 const char* marker,
                 const char* name,
                 Writer& w) {
  w.Put(0, type);
  if (*handle != '\0') {
    w.Put(5, handle);
  } else {
    w.PutHandle();
  }
  w.Put(330, owner);
  w.Put(100, "AcDbSymbolTableRecord");
  w.Put(100, marker);
  w.Put(2, name);
}

void PutLayers(Writer& w) {
  BeginTable("LAYER", "2", static_cast<int>(kLayers.size()), w);
  for (const Layer& layer : kLayers) {
    BeginRecord("LAYER", "", "2", "AcDbLayerTableRecord", layer.name, w);
    w.Put(70, 0);
    w.Put(62, layer.color);
    w.Put(6, "Continuous");
    w.Put(390, "F");
  }
  w.Put(0, "ENDTAB");
}

void PutLineTypes(Writer& w) {
  BeginTable("LTYPE", "5", 3, w);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
    BeginRecord("LTYPE", "", "5", "AcDbLinetypeTableRecord", name, w);
    w.Put(70, 0);
    w.Put(3, "");
    w.Put(72, 65);
    w.Put(73, 0);
    w.Put(40, 0.0);
  }
  w.Put(0, "ENDTAB");
}

void PutViewport(Writer& w) {
  BeginTable("VPORT", "8", 1, w);
  BeginRecord("VPORT", "", "8", "AcDbViewportTableRecord", "*Active", w);
  w.Put(70, 0);
  for (const auto& [code, x, y] : {std::tuple{10, 0.0, 0.0},
                                   {11, 1.0, 1.0},
                                   {12, 0.0, 0.0},
                                   {13, 0.0, 0.0},
                                   {14, 10.0, 10.0},
                                   {15, 10.0, 10.0}}) {
    w.Put(code, x);
    w.Put(code + 10, y);
  }
  w.Put(16, Eigen::Vector3d(0, 0, 1));
  w.Put(17, Eigen::Vector3d(0, 0, 0));
  w.Put(40, 10.0);
  w.Put(41, 1.0);
  w.Put(42, 50.0);
  w.Put(0, "ENDTAB");
}

void PutStyles(Writer& w) {
  BeginTable("STYLE", "3", 1, w);
  BeginRecord("STYLE", "11", "3", "AcDbTextStyleTableRecord", "Standard", w);
  w.Put(70, 0);
  w.Put(40, 0.0);
  w.Put(41, 1.0);
  w.Put(50, 0.0);
  w.Put(71, 0);
  w.Put(42, 2.5);
  w.Put(3, "txt");
  w.Put(4, "");
  w.Put(0, "ENDTAB");
}

void PutDimensionStyles(Writer& w) {
  BeginTable("DIMSTYLE", "A", 1, w);
  w.Put(100, "AcDbDimStyleTable");
  w.Put(0, "DIMSTYLE");
  w.Put(105, "27");
  w.Put(330, "A");
  w.Put(100, "AcDbSymbolTableRecord");
  w.Put(100, "AcDbDimStyleTableRecord");
  w.Put(2, "Standard");
  w.Put(70, 0);
  w.Put(340, "11");
  w.Put(0, "ENDTAB");
}

void PutTables(Writer& w) {
  w.Put(0, "SECTION");
  w.Put(2, "TABLES");
  PutViewport(w);
  PutLineTypes(w);
  PutLayers(w);
  PutStyles(w);
  for (const auto& [name, handle] :
       {std::pair{"VIEW", "6"}, std::pair{"UCS", "7"}}) {
    BeginTable(name, handle, 0, w);
    w.Put(0, "ENDTAB");
  }
  BeginTable("APPID", "9", 1, w);
  BeginRecord("APPID", "12", "9", "AcDbRegAppTableRecord", "ACAD", w);
  w.Put(70, 0);
  w.Put(0, "ENDTAB");
  PutDimensionStyles(w);
  BeginTable("BLOCK_RECORD", kBlockRecords, 2, w);
  for (const auto& [name, handle] : {std::pair{"*Model_Space", kModelSpace},
                                     std::pair{"*Paper_Space", kPaperSpace}}) {
    BeginRecord(
        "BLOCK_RECORD", handle, kBlockRecords, "AcDbBlockTableRecord", name, w);
    w.Put(340, "0");
  }
  w.Put(0, "ENDTAB");
  w.Put(0, "ENDSEC");
}

void PutBlocks(Writer& w) {
  w.Put(0, "SECTION");
  w.Put(2, "BLOCKS");
  for (const auto& [name, record] : {std::pair{"*Model_Space", kModelSpace},
                                     std::pair{"*Paper_Space", kPaperSpace}}) {
    w.Put(0, "BLOCK");
    w.PutHandle();
    w.Put(330, record);
    w.Put(100, "AcDbEntity");
    if (std::string_view(record) == kPaperSpace) w.Put(67, 1);
    w.Put(8, "0");
    w.Put(100, "AcDbBlockBegin");
    w.Put(2, name);
    w.Put(70, 0);
    w.Put(10, Eigen::Vector3d(0, 0, 0));
    w.Put(3, name);
    w.Put(1, "");
    w.Put(0, "ENDBLK");
    w.PutHandle();
    w.Put(330, record);
    w.Put(100, "AcDbEntity");
    if (std::string_view(record) == kPaperSpace) w.Put(67, 1);
    w.Put(8, "0");
    w.Put(100, "AcDbBlockEnd");
  }
  w.Put(0, "ENDSEC");
}

void BeginEntity(const char* type, const char* layer, Writer& w) {
  w.Put(0, type);
  w.PutHandle();
  w.Put(330, kModelSpace);
  w.Put(100, "AcDbEntity");
  w.Put(8, layer);
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

void PutArc(const CurveFit& fit, Writer& w) {
  BeginEntity(
      fit.closed ? "CIRCLE" : "ARC", fit.closed ? "CIRCLES" : "ARCS", w);
  const Eigen::Vector3d normal = fit.major.cross(fit.minor).normalized();
  const Eigen::Matrix3d frame = FrameOfNormal(normal);
  w.Put(100, "AcDbCircle");
  w.Put(10, frame.transpose() * fit.center);
  w.Put(40, fit.major.norm());
  w.Put(210, normal);
  if (fit.closed) return;
  w.Put(100, "AcDbArc");
  w.Put(50, AngleIn(frame, PointAt(fit, 0) - fit.center));
  w.Put(51, AngleIn(frame, PointAt(fit, 1) - fit.center));
}

void PutEllipse(const CurveFit& fit, Writer& w) {
  BeginEntity("ELLIPSE", "ELLIPSES", w);
  w.Put(100, "AcDbEllipse");
  w.Put(10, fit.center);
  w.Put(11, fit.major);
  w.Put(210, fit.major.cross(fit.minor).normalized());
  w.Put(40, fit.minor.norm() / fit.major.norm());
  w.Put(41, fit.closed ? 0.0 : fit.start_angle);
  w.Put(42, fit.closed ? 2 * kPi : fit.end_angle);
}

void PutSpline(const CurveFit& fit, Writer& w) {
  constexpr int kDegree = 3;
  BeginEntity("SPLINE", "SPLINES", w);
  w.Put(100, "AcDbSpline");
  w.Put(210, Eigen::Vector3d(0, 0, 1));
  w.Put(70, fit.closed ? 1 : 0);
  w.Put(71, kDegree);
  w.Put(72, static_cast<int>(fit.knots.size()));
  w.Put(73, static_cast<int>(fit.control_points.size()));
  w.Put(74, 0);
  w.Put(42, 1e-10);
  w.Put(43, 1e-10);
  for (const double knot : fit.knots) w.Put(40, knot);
  for (const Eigen::Vector3d& point : fit.control_points) w.Put(10, point);
}

void PutFit(const CurveFit& fit, Writer& w) {
  switch (fit.kind) {
    case FitKind::kLine:
      BeginEntity("LINE", "LINES", w);
      w.Put(100, "AcDbLine");
      w.Put(10, fit.start);
      w.Put(11, fit.end);
      return;
    case FitKind::kArc:
      return PutArc(fit, w);
    case FitKind::kEllipse:
      return PutEllipse(fit, w);
    case FitKind::kSpline:
      return PutSpline(fit, w);
  }
}

void PutObjects(Writer& w) {
  w.Put(0, "SECTION");
  w.Put(2, "OBJECTS");
  const auto dictionary = [&](const char* handle, const char* owner) {
    w.Put(0, "DICTIONARY");
    w.Put(5, handle);
    w.Put(330, owner);
    w.Put(100, "AcDbDictionary");
    w.Put(281, 1);
  };
  dictionary("C", "0");
  w.Put(3, "ACAD_GROUP");
  w.Put(350, "D");
  w.Put(3, "ACAD_PLOTSTYLENAME");
  w.Put(350, "E");
  dictionary("D", "C");
  w.Put(0, "ACDBDICTIONARYWDFLT");
  w.Put(5, "E");
  w.Put(330, "C");
  w.Put(100, "AcDbDictionary");
  w.Put(281, 1);
  w.Put(3, "Normal");
  w.Put(350, "F");
  w.Put(100, "AcDbDictionaryWithDefault");
  w.Put(340, "F");
  w.Put(0, "ACDBPLACEHOLDER");
  w.Put(5, "F");
  w.Put(330, "E");
  w.Put(0, "ENDSEC");
}

std::string Header(int next_handle) {
  Writer w;
  std::array<char, 16> handle;
  std::snprintf(handle.data(), handle.size(), "%X", next_handle);
  w.Put(0, "SECTION");
  w.Put(2, "HEADER");
  w.Put(9, "$ACADVER");
  w.Put(1, "AC1015");
  w.Put(9, "$HANDSEED");
  w.Put(5, handle.data());
  w.Put(9, "$INSUNITS");
  w.Put(70, 0);
  w.Put(0, "ENDSEC");
  w.Put(0, "SECTION");
  w.Put(2, "CLASSES");
  w.Put(0, "CLASS");
  w.Put(1, "ACDBDICTIONARYWDFLT");
  w.Put(2, "AcDbDictionaryWithDefault");
  w.Put(3, "ObjectDBX Classes");
  w.Put(90, 0);
  w.Put(280, 0);
  w.Put(281, 0);
  w.Put(0, "ENDSEC");
  return w.Take();
}

}  // namespace

void EncodeDxfDrawing(const FittedCurves& fitted, const ByteSink& sink) {
  Writer w;
  PutTables(w);
  PutBlocks(w);
  int next_handle = w.next_handle();
  for (const FittedCurve& curve : fitted.curves) {
    next_handle += static_cast<int>(curve.fits.size());
  }
  sink(Header(next_handle));
  w.Put(0, "SECTION");
  w.Put(2, "ENTITIES");
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) PutFit(fit, w);
    sink(w.Take());
  }
  w.Put(0, "ENDSEC");
  PutObjects(w);
  w.Put(0, "EOF");
  sink(w.Take());
}

}  // namespace curvix
