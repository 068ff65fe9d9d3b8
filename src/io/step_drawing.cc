// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves for CAD.
#include "io/curve_formats.h"

#include <Eigen/Core>
#include <cctype>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

constexpr char kHeader[] =
    "ISO-10303-21;\n"
    "HEADER;\n"
    "FILE_DESCRIPTION(('3D curves from photographs'),'2;1');\n"
    "FILE_NAME('curves','',(''),(''),'curvix','curvix','');\n"
    "FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF "
    "{ 1 0 10303 442 1 1 4 }'));\n"
    "ENDSEC;\n"
    "DATA;\n";

// Points nearer to each other are one, in the unit of the file.
constexpr double kAccuracy = 1e-7;

// Entities, numbered from 1 as they are put.
class Writer {
 public:
  int Put(const std::string& entity) {
    out_ += '#' + std::to_string(++last_) + '=' + entity + ";\n";
    return last_;
  }
  // What was put since the last time.
  std::string Take() { return std::exchange(out_, {}); }

 private:
  std::string out_;
  int last_ = 0;
};

// The grammar asks for a point in every real, and for a capital E.
std::string Real(double value) {
  std::string text = NumberText(value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos) text[exponent] = 'E';
  if (text.find('.') == std::string::npos) {
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
  }
  return text;
}

std::string Ref(int entity) { return '#' + std::to_string(entity); }

// "(a,b,c)", some on each line.
template <typename Items, typename Text>
std::string List(const Items& items, const Text& text) {
  constexpr std::size_t kPerLine = 16;
  std::string list = "(";
  std::size_t count = 0;
  for (const auto& item : items) {
    if (count > 0) list += count % kPerLine == 0 ? ",\n" : ",";
    list += text(item);
    ++count;
  }
  return list + ')';
}

std::string Triple(const Eigen::Vector3d& v) {
  return List(std::vector<double>(v.begin(), v.end()), Real);
}

int PutPoint(const Eigen::Vector3d& position, Writer& w) {
  return w.Put("CARTESIAN_POINT(''," + Triple(position) + ')');
}

int PutDirection(const Eigen::Vector3d& direction, Writer& w) {
  return w.Put("DIRECTION(''," + Triple(direction) + ')');
}

// The part of the curve `basis` between two points, which it has at these
// parameters.
int PutTrimmed(const std::string& name,
               int basis,
               const std::pair<Eigen::Vector3d, double>& start,
               const std::pair<Eigen::Vector3d, double>& end,
               Writer& w) {
  const auto trim = [&](const std::pair<Eigen::Vector3d, double>& at) {
    return "(" + Ref(PutPoint(at.first, w)) + ",PARAMETER_VALUE(" +
           Real(at.second) + "))";
  };
  const std::string from = trim(start);
  const std::string to = trim(end);
  return w.Put("TRIMMED_CURVE(" + name + ',' + Ref(basis) + ',' + from + ',' +
               to + ",.T.,.PARAMETER.)");
}

int PutLine(const CurveFit& fit, const std::string& name, Writer& w) {
  const Eigen::Vector3d along = fit.end - fit.start;
  const int direction = PutDirection(along.normalized(), w);
  const int vector = w.Put("VECTOR(''," + Ref(direction) + ",1.)");
  const int line =
      w.Put("LINE(''," + Ref(PutPoint(fit.start, w)) + ',' + Ref(vector) + ')');
  return PutTrimmed(name, line, {fit.start, 0}, {fit.end, along.norm()}, w);
}

// Arcs, ellipses, whole or not.
int PutConic(const CurveFit& fit, const std::string& name, Writer& w) {
  const int center = PutPoint(fit.center, w);
  const int normal = PutDirection(NormalOf(fit), w);
  const int first_axis = PutDirection(fit.major.normalized(), w);
  const int frame = w.Put("AXIS2_PLACEMENT_3D(''," + Ref(center) + ',' +
                          Ref(normal) + ',' + Ref(first_axis) + ')');
  const std::string sizes =
      fit.kind == FitKind::kArc
          ? Real(fit.major.norm())
          : Real(fit.major.norm()) + ',' + Real(fit.minor.norm());
  const int whole =
      w.Put((fit.kind == FitKind::kArc ? "CIRCLE(" : "ELLIPSE(") +
            (fit.closed ? name : "''") + ',' + Ref(frame) + ',' + sizes + ')');
  if (fit.closed) return whole;
  // Parameters of a closed curve go once around.
  const auto parameter = [](double angle) {
    const double wrapped = WrapDirected(angle);
    return wrapped < 0 ? wrapped + 2 * kPi : wrapped;
  };
  return PutTrimmed(name,
                    whole,
                    {PointAt(fit, 0), parameter(fit.start_angle)},
                    {PointAt(fit, 1), parameter(fit.end_angle)},
                    w);
}

int PutSpline(const CurveFit& fit, const std::string& name, Writer& w) {
  std::vector<int> points;
  for (const Eigen::Vector3d& point : fit.control_points) {
    points.push_back(PutPoint(point, w));
  }
  std::vector<double> knots;
  std::vector<int> multiplicities;
  for (const double knot : fit.knots) {
    if (knots.empty() || knot != knots.back()) {
      knots.push_back(knot);
      multiplicities.push_back(0);
    }
    ++multiplicities.back();
  }
  return w.Put(
      "B_SPLINE_CURVE_WITH_KNOTS(" + name + ",3," + List(points, Ref) +
      ",.UNSPECIFIED.," + (fit.closed ? ".T." : ".F.") + ",.U.," +
      List(multiplicities, [](int count) { return std::to_string(count); }) +
      ',' + List(knots, Real) + ",.UNSPECIFIED.)");
}

int PutFit(const CurveFit& fit, const std::string& name, Writer& w) {
  switch (fit.kind) {
    case FitKind::kLine:
      return PutLine(fit, name, w);
    case FitKind::kArc:
    case FitKind::kEllipse:
      return PutConic(fit, name, w);
    case FitKind::kSpline:
      break;
  }
  return PutSpline(fit, name, w);
}

// No direction may be of length 0.
bool HasLength(const CurveFit& fit) {
  return fit.kind == FitKind::kSpline || Length(fit) > 0;
}

// "LINES" for a line.
std::string LayerOf(const CurveFit& fit) {
  std::string layer;
  for (const char c : KindName(fit)) {
    layer += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return layer + 'S';
}

// The product that the curves are the shape of.
int PutProductShape(Writer& w) {
  const std::string context =
      Ref(w.Put("APPLICATION_CONTEXT('managed model based 3d engineering')"));
  w.Put(
      "APPLICATION_PROTOCOL_DEFINITION('international standard',"
      "'ap242_managed_model_based_3d_engineering',2014," +
      context + ')');
  const std::string for_products =
      Ref(w.Put("PRODUCT_CONTEXT(''," + context + ",'mechanical')"));
  const std::string for_definitions =
      Ref(w.Put("PRODUCT_DEFINITION_CONTEXT('part definition'," + context +
                ",'design')"));
  const std::string product =
      Ref(w.Put("PRODUCT('curves','curves','',(" + for_products + "))"));
  w.Put("PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(" + product + "))");
  const std::string version =
      Ref(w.Put("PRODUCT_DEFINITION_FORMATION('',''," + product + ')'));
  const std::string definition =
      Ref(w.Put("PRODUCT_DEFINITION('design',''," + version + ',' +
                for_definitions + ')'));
  return w.Put("PRODUCT_DEFINITION_SHAPE('',''," + definition + ')');
}

// Millimetres, radians, and how exact the coordinates are.
int PutUnits(Writer& w) {
  const std::string length =
      Ref(w.Put("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))"));
  const std::string angle =
      Ref(w.Put("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))"));
  const std::string solid_angle =
      Ref(w.Put("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())"));
  const std::string accuracy = Ref(
      w.Put("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(" + Real(kAccuracy) +
            ")," + length + ",'distance_accuracy_value','')"));
  return w.Put(
      "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
      "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((" +
      accuracy + "))GLOBAL_UNIT_ASSIGNED_CONTEXT((" + length + ',' + angle +
      ',' + solid_angle + "))REPRESENTATION_CONTEXT('','3D'))");
}

// The curves by layer, as the shape of the product.
void PutShape(const std::map<std::string, std::vector<int>>& curves_of_layer,
              int product_shape,
              int units,
              Writer& w) {
  const int origin = PutPoint(Eigen::Vector3d::Zero(), w);
  std::vector<int> items = {
      w.Put("AXIS2_PLACEMENT_3D(''," + Ref(origin) + ",$,$)")};
  for (const auto& [layer, curves] : curves_of_layer) {
    items.push_back(w.Put("GEOMETRIC_CURVE_SET('" + layer + "'," +
                          List(curves, Ref) + ')'));
    w.Put("PRESENTATION_LAYER_ASSIGNMENT('" + layer + "','',(" +
          Ref(items.back()) + "))");
  }
  // A wireframe without curves is not allowed.
  const std::string type = curves_of_layer.empty()
                               ? "SHAPE_REPRESENTATION"
                               : "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_"
                                 "REPRESENTATION";
  const int shape =
      w.Put(type + "('curves'," + List(items, Ref) + ',' + Ref(units) + ')');
  w.Put("SHAPE_DEFINITION_REPRESENTATION(" + Ref(product_shape) + ',' +
        Ref(shape) + ')');
}

}  // namespace

void EncodeStepDrawing(const FittedCurves& fitted, const ByteSink& sink) {
  Writer w;
  sink(kHeader);
  const int product_shape = PutProductShape(w);
  const int units = PutUnits(w);
  std::map<std::string, std::vector<int>> curves_of_layer;
  for (std::size_t id = 0; id < fitted.curves.size(); ++id) {
    const std::string name = "'curve_" + std::to_string(id) + '\'';
    for (const CurveFit& fit : fitted.curves[id].fits) {
      if (!HasLength(fit)) continue;
      curves_of_layer[LayerOf(fit)].push_back(PutFit(fit, name, w));
    }
    sink(w.Take());
  }
  PutShape(curves_of_layer, product_shape, units, w);
  sink(w.Take());
  sink("ENDSEC;\nEND-ISO-10303-21;\n");
}

}  // namespace curvix
