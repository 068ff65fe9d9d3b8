// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/curves_json.h"

#include <curvix/camera_model.h>
#include <curvix/text_fields.h>

#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace curvix {
namespace {

// The file has millions of numbers: it is written straight into the text.
class JsonWriter {
 public:
  void Raw(std::string_view text) { out_ += text; }
  void Number(double value) {
    if (!std::isfinite(value)) return Raw("null");
    AppendNumber(value, out_);
  }
  void Rounded(double value, int num_decimals) {
    AppendRounded(value, num_decimals, out_);
  }
  void Count(std::size_t value) { AppendNumber(value, out_); }
  void Vector(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) {
      Raw(i == 0 ? "[" : ",");
      Number(v[i]);
    }
    Raw("]");
  }
  // ,"name":
  void Key(std::string_view name) {
    Raw(",\"");
    Raw(name);
    Raw("\":");
  }
  template <typename List, typename Item>
  void Each(const List& list, Item item) {
    Raw("[");
    bool is_first = true;
    for (const auto& element : list) {
      if (!is_first) Raw(",");
      is_first = false;
      item(element);
    }
    Raw("]");
  }
  // What was written since the last time.
  std::string Take() { return std::exchange(out_, {}); }

 private:
  std::string out_;
};

void PutFit(const CurveFit& fit, JsonWriter& w) {
  w.Raw("{\"kind\":\"");
  w.Raw(KindName(fit));
  w.Raw("\"");
  w.Key("closed");
  w.Raw(fit.closed ? "true" : "false");
  w.Key("first_sample");
  w.Count(fit.first_sample);
  w.Key("num_samples");
  w.Count(fit.num_samples);
  w.Key("start");
  w.Vector(fit.start);
  w.Key("end");
  w.Vector(fit.end);
  for (const auto& [name, node] : {std::pair{"start_node", fit.start_node},
                                   std::pair{"end_node", fit.end_node}}) {
    w.Key(name);
    w.Raw(node < 0 ? "null" : std::to_string(node));
  }
  w.Key("length");
  w.Number(Length(fit));
  if (fit.kind == FitKind::kArc) {
    w.Key("radius");
    w.Number(fit.major.norm());
    w.Key("radius_sigma");
    w.Number(fit.radius_sigma);
  }
  if (fit.kind == FitKind::kArc || fit.kind == FitKind::kEllipse) {
    w.Key("center");
    w.Vector(fit.center);
    w.Key("major");
    w.Vector(fit.major);
    w.Key("minor");
    w.Vector(fit.minor);
    w.Key("start_angle");
    w.Number(fit.start_angle);
    w.Key("end_angle");
    w.Number(fit.end_angle);
  }
  if (fit.kind == FitKind::kSpline) {
    w.Key("degree");
    w.Count(3);
    w.Key("control_points");
    w.Each(fit.control_points, [&](const auto& p) { w.Vector(p); });
    w.Key("knots");
    w.Each(fit.knots, [&](double knot) { w.Number(knot); });
  }
  for (const auto& [name, value] : {std::pair{"rms_residual", fit.rms_residual},
                                    {"max_residual", fit.max_residual},
                                    {"inlier_share", fit.inlier_share},
                                    {"sigma", fit.sigma}}) {
    w.Key(name);
    w.Number(value);
  }
  w.Raw("}");
}

void PutSample(const CurveRecord& record,
               const CurveSample& sample,
               JsonWriter& w) {
  constexpr int kPixelDecimals = 3;
  w.Raw("{\"position\":");
  w.Vector(sample.position);
  w.Key("tangent");
  w.Vector(sample.tangent);
  w.Key("sigma");
  w.Number(sample.sigma);
  w.Key("covariance");
  w.Each(Triangle(sample.covariance), [&](double entry) { w.Number(entry); });
  w.Key("support");
  w.Each(sample.support, [&](const EdgeRef& ref) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    w.Raw("[");
    w.Count(record.scene.views[view_idx].image_id);
    const auto edge = FindSupportingEdge(record, sample, ref);
    for (const double value : {edge ? edge->pixel.x() : NAN,
                               edge ? edge->pixel.y() : NAN,
                               edge ? edge->residual_px : NAN}) {
      w.Raw(",");
      w.Rounded(value, kPixelDecimals);
    }
    w.Raw("]");
  });
  w.Raw("}");
}

void PutCurve(const CurveRecord& record,
              std::size_t id,
              const Curve& curve,
              JsonWriter& w) {
  w.Raw("{\"id\":");
  w.Count(id);
  w.Key("closed");
  w.Raw(curve.closed ? "true" : "false");
  w.Key("length");
  w.Number(Length(curve));
  w.Key("fits");
  w.Each(record.fitted.curves[id].fits, [&](const auto& f) { PutFit(f, w); });
  w.Key("samples");
  w.Each(curve.samples, [&](const auto& s) {
    w.Raw("\n");
    PutSample(record, s, w);
  });
  w.Raw("}");
}

void PutImage(const View& view, const Camera& camera, JsonWriter& w) {
  w.Raw("\n{\"image_id\":");
  w.Count(view.image_id);
  w.Key("name");
  w.Raw(JsonText(view.name));
  w.Key("width");
  w.Raw(std::to_string(camera.width));
  w.Key("height");
  w.Raw(std::to_string(camera.height));
  w.Raw("}");
}

void PutNode(const CurveNode& node, JsonWriter& w) {
  w.Raw("\n{\"position\":");
  w.Vector(node.position);
  w.Key("ends");
  w.Each(node.ends, [&](const CurveNode::End& end) {
    w.Raw("{\"curve\":");
    w.Count(end.curve_idx);
    w.Key("fit");
    w.Count(end.fit_idx);
    w.Key("at");
    w.Raw(end.at_end ? "\"end\"" : "\"start\"");
    w.Raw("}");
  });
  w.Raw("}");
}

}  // namespace

std::optional<SupportingEdge> FindSupportingEdge(const CurveRecord& record,
                                                 const CurveSample& sample,
                                                 const EdgeRef& ref) {
  const View& view = record.scene.views[static_cast<std::size_t>(ref.view_idx)];
  const Camera& camera =
      record.scene.cameras[static_cast<std::size_t>(view.camera_idx)];
  const Edge2d edge = record.curves.EdgeOf(ref);
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Vector3d ray =
      calibration.inverse() * edge.position.homogeneous();
  const Eigen::Vector3d in_camera = view.cam_from_world * sample.position;
  if (!(in_camera.z() > 0)) return std::nullopt;
  const Eigen::Vector2d seen = (calibration * in_camera).hnormalized();
  const Eigen::Vector2d normal(-std::sin(edge.angle), std::cos(edge.angle));
  return SupportingEdge{ImageFromIdeal(camera, ray.hnormalized()),
                        normal.dot(seen - edge.position)};
}

void AppendRounded(double value, int num_decimals, std::string& out) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  const double scale = std::pow(10.0, num_decimals);
  const double scaled = std::round(value * scale);
  AppendNumber(scaled == 0 ? 0.0 : scaled / scale, out);
}

std::string JsonText(const std::string& text) {
  using Json = nlohmann::json;
  // Not UTF-8: replaced. "<" would end a script; ASCII only for the rest.
  const std::string quoted =
      Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  for (const char c : quoted) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

void EncodeCurvesJson(const CurveRecord& record, const ByteSink& sink) {
  JsonWriter w;
  w.Raw("{\"format\":\"curvix curves\",\"version\":1");
  w.Key("images");
  w.Each(record.scene.views, [&](const View& view) {
    PutImage(view,
             record.scene.cameras[static_cast<std::size_t>(view.camera_idx)],
             w);
  });
  w.Key("nodes");
  w.Each(record.fitted.nodes, [&](const auto& node) { PutNode(node, w); });
  w.Raw(",\"curves\":[");
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    w.Raw(id > 0 ? ",\n" : "\n");
    PutCurve(record, id, curve, w);
    sink(w.Take());
  });
  w.Raw("]}\n");
  sink(w.Take());
}

}  // namespace curvix
