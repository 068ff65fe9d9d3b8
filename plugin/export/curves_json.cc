// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/curves_json.h"

#include <Eigen/Geometry>
#include <boost/algorithm/string/replace.hpp>
#include <utility>

#include "base/parallel.h"
#include "plugin/export/alignment_file.h"

namespace curvix {
namespace {

constexpr int kPixelDecimals = 3;
constexpr int kTangentDecimals = 7;
constexpr int kProbabilityDecimals = 4;
// Of samples. Enough for standard deviations along two axes that differ by a
// factor of 10,000.
constexpr int kCovarianceDigits = 9;

Json NodeIdxJson(int node_idx) {
  return node_idx < 0 ? Json() : Json(node_idx);
}

Json FitJson(const CurveFit& fit) {
  Json json = {{"kind", KindName(fit)},
               {"curve_kind", KindName(fit.curve_kind)},
               {"closed", fit.closed},
               {"first_sample", fit.first_sample},
               {"num_samples", fit.num_samples},
               {"start", VectorJson(fit.start)},
               {"end", VectorJson(fit.end)},
               {"start_node", NodeIdxJson(fit.start_node)},
               {"end_node", NodeIdxJson(fit.end_node)},
               {"length", Length(fit)}};
  if (!fit.closed) {
    json["start_covariance"] = Triangle(fit.start_covariance);
    json["end_covariance"] = Triangle(fit.end_covariance);
  }
  if (fit.kind == FitKind::kArc) {
    json["radius"] = fit.major.norm();
    json["radius_sigma"] = fit.radius_sigma;
    json["axis_sigma"] =
        std::sqrt(fit.arc_covariance.block<3, 3>(3, 3).trace() / 2);
  }
  if (fit.kind == FitKind::kArc || fit.kind == FitKind::kEllipse) {
    json["center"] = VectorJson(fit.center);
    json["major"] = VectorJson(fit.major);
    json["minor"] = VectorJson(fit.minor);
    json["start_angle"] = fit.start_angle;
    json["end_angle"] = fit.end_angle;
  }
  if (fit.kind == FitKind::kSpline) {
    json["degree"] = 3;
    json["control_points"] = Json::array();
    for (const Eigen::Vector3d& point : fit.control_points) {
      json["control_points"].push_back(VectorJson(point));
    }
    json["knots"] = fit.knots;
  }
  json["rms_residual"] = fit.rms_residual;
  json["max_residual"] = fit.max_residual;
  json["inlier_share"] = fit.inlier_share;
  json["sigma"] = fit.sigma;
  return json;
}

// `edge` is that of `ref`.
void AppendSupport(const Scene& scene,
                   const CurveSample& sample,
                   const EdgeRef& ref,
                   const Edge2d& edge,
                   std::string& out) {
  const auto shown = FindSupportingEdge(scene, sample, ref, edge);
  out += '[';
  AppendJson(scene.views[static_cast<std::size_t>(ref.view_idx)].image_id, out);
  const auto [pixel, residual_px] = shown.value_or(SupportingEdge());
  for (const double value : {pixel.x(), pixel.y(), residual_px}) {
    out += ',';
    AppendJson(shown ? Rounded(value, kPixelDecimals) : std::nan(""), out);
  }
  out += ']';
}

// `edge` is the first of the sample's edges; it is moved behind the last.
void AppendSample(const Scene& scene,
                  const CurveSample& sample,
                  std::vector<Edge2d>::const_iterator& edge,
                  std::string& out) {
  const auto tangent = [](double x, std::string& text) {
    AppendJson(Rounded(x, kTangentDecimals), text);
  };
  const auto digits = [](double x, std::string& text) {
    AppendJson(RoundedToDigits(x, kCovarianceDigits), text);
  };
  out += "{\"position\":";
  AppendJsonList(sample.position, AppendJson<double>, out);
  out += ",\"tangent\":";
  AppendJsonList(sample.tangent, tangent, out);
  out += ",\"sigma\":";
  digits(sample.sigma, out);
  out += ",\"covariance\":";
  AppendJsonList(Triangle(sample.covariance), digits, out);
  out += ",\"kind_probability\":";
  AppendJson(Rounded(sample.kind_probability, kProbabilityDecimals), out);
  out += ",\"support\":";
  const auto support = [&](const EdgeRef& ref, std::string& text) {
    AppendSupport(scene, sample, ref, *edge++, text);
  };
  AppendJsonList(sample.support, support, out);
  out += '}';
}

// The runs of samples of one kind.
Json KindsJson(const Curve& curve) {
  Json kinds = Json::array();
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    if (i == 0 || sample.kind != curve.samples[i - 1].kind) {
      kinds.push_back({{"kind", KindName(sample.kind)},
                       {"first_sample", i},
                       {"num_samples", 0}});
    }
    Json& num_samples = kinds.back()["num_samples"];
    num_samples = num_samples.get<std::size_t>() + 1;
  }
  return kinds;
}

// `edges` are the support of the samples, one after the other. The samples,
// most of the file, are written without Json values, which take time.
std::string CurveText(const CurveRecord& record,
                      std::size_t id,
                      const Curve& curve,
                      const std::vector<Edge2d>& edges) {
  Json json = {{"id", id},
               {"closed", curve.closed},
               {"length", Length(curve)},
               {"kind", KindName(MainKind(curve))},
               {"kinds", KindsJson(curve)},
               {"fits", Json::array()}};
  for (const CurveFit& fit : record.fitted.curves[id].fits) {
    json["fits"].push_back(FitJson(fit));
  }
  std::string text = JsonText(json);
  text.pop_back();
  text += ",\"samples\":";
  auto edge = edges.begin();
  const auto append = [&](const CurveSample& sample, std::string& out) {
    AppendSample(record.scene, sample, edge, out);
  };
  AppendJsonList(curve.samples, append, text);
  return text += '}';
}

std::vector<Edge2d> SupportOf(const CurveSource& curves, const Curve& curve) {
  std::vector<Edge2d> edges;
  for (const CurveSample& sample : curve.samples) {
    for (const EdgeRef& ref : sample.support) {
      edges.push_back(curves.EdgeOf(ref));
    }
  }
  return edges;
}

Json ImageJson(const View& view, const Camera& camera) {
  return {{"image_id", view.image_id},
          {"name", view.name},
          {"width", camera.width},
          {"height", camera.height}};
}

Json NodeJson(const CurveNode& node) {
  Json json = {{"position", VectorJson(node.position)},
               {"covariance", Triangle(node.covariance)},
               {"ends", Json::array()}};
  for (const CurveNode::End& end : node.ends) {
    json["ends"].push_back({{"curve", end.curve_idx},
                            {"fit", end.fit_idx},
                            {"at", end.at_end ? "end" : "start"}});
  }
  return json;
}

Json GroupJson(const FitGroup& group) {
  Json json = {{"kind", KindName(group.kind)},
               {"fits", Json::array()},
               {"sigma", group.sigma},
               {"chi_squared", group.chi_squared},
               {"degrees_of_freedom", group.degrees_of_freedom}};
  for (const FitIndex& index : group.fits) {
    json["fits"].push_back({index.curve_idx, index.fit_idx});
  }
  if (group.kind == GroupKind::kEqualRadius) {
    json["radius"] = group.radius;
  } else {
    json["direction"] = VectorJson(group.direction);
    if (group.kind != GroupKind::kParallel) {
      json["point"] = VectorJson(group.point);
    }
  }
  return json;
}

Json PerpendicularJson(const PerpendicularGroups& pair) {
  return {{"groups", {pair.first, pair.second}},
          {"chi_squared", pair.chi_squared}};
}

// What coordinates are; the whole of it is in alignment.json.
std::string FrameText(const WorldAlignment* alignment) {
  if (alignment == nullptr) return "";
  Json json = AlignmentJson(*alignment);
  json.erase("format");
  json.erase("version");
  return ",\"alignment\":" + JsonText(json);
}

}  // namespace

std::optional<SupportingEdge> FindSupportingEdge(const Scene& scene,
                                                 const CurveSample& sample,
                                                 const EdgeRef& ref,
                                                 const Edge2d& edge) {
  const View& view = scene.views[static_cast<std::size_t>(ref.view_idx)];
  const Camera& camera = CameraOf(scene, view);
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

Json VectorJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

double RoundedToDigits(double value, int num_digits) {
  return ParseNumber<double>(ShortText(value, num_digits)).value_or(value);
}

std::string JsonText(const Json& json) {
  // Not UTF-8: replaced. "<" would end a script; ASCII only for the rest.
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  boost::algorithm::replace_all(text, "<", "\\u003c");
  return text;
}

void JsonLines::Add(std::function<std::string()> text) {
  constexpr std::size_t kNumAtATime = 256;
  texts_.push_back(std::move(text));
  if (texts_.size() == kNumAtATime) Flush();
}

void JsonLines::Flush() {
  std::vector<std::string> lines(texts_.size());
  ParallelFor(lines.size(), num_threads_, [&](std::size_t i) {
    lines[i] = texts_[i]();
  });
  for (const std::string& line : lines) {
    sink_(is_first_ ? "\n" : ",\n");
    sink_(line);
    is_first_ = false;
  }
  texts_.clear();
}

void EncodeCurvesJson(const CurveRecord& record,
                      int num_threads,
                      const ByteSink& sink) {
  const auto put = [&](const auto& items, const auto& json_of) {
    JsonLines lines(num_threads, sink);
    for (const auto& item : items) {
      lines.Add([&] { return JsonText(json_of(item)); });
    }
    lines.Flush();
  };
  sink("{\"format\":\"curvix curves\",\"version\":1" +
       FrameText(record.alignment) + ",\"images\":[");
  put(record.scene.views, [&](const View& view) {
    return ImageJson(view, CameraOf(record.scene, view));
  });
  sink("],\"nodes\":[");
  put(record.fitted.nodes, NodeJson);
  sink("],\"structure\":{\"groups\":[");
  put(record.fitted.structure.groups, GroupJson);
  sink("],\"perpendicular\":[");
  put(record.fitted.structure.perpendicular, PerpendicularJson);
  sink("]},\"curves\":[");
  JsonLines lines(num_threads, sink);
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    lines.Add([&record, id, curve, edges = SupportOf(record.curves, curve)] {
      return CurveText(record, id, curve, edges);
    });
  });
  lines.Flush();
  sink("]}\n");
}

}  // namespace curvix
