// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/curves_file.h"

#include <algorithm>
#include <fstream>

#include "plugin/export/alignment_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Eigen::Vector3d VectorOf(const Json& json) {
  return {json.at(0).get<double>(),
          json.at(1).get<double>(),
          json.at(2).get<double>()};
}

Eigen::Matrix3d MatrixOf(const Json& json) {
  const auto at = [&](std::size_t i) { return json.at(i).get<double>(); };
  Eigen::Matrix3d m;
  m << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
  return m;
}

// All of curves.json but the samples, which are most of it, or what is not
// asked of them.
Json ReadJson(std::ifstream& file, bool with_samples) {
  return Json::parse(
      file,
      [&](int, Json::parse_event_t event, Json& parsed) {
        if (event != Json::parse_event_t::key) return true;
        if (!with_samples) return parsed != "samples";
        return parsed != "tangent" && parsed != "kind_probability";
      },
      false);
}

std::vector<SeenSample> SamplesOf(const Json& json) {
  std::vector<SeenSample> samples;
  for (const Json& sample : json) {
    SeenSample& added = samples.emplace_back();
    added.position = VectorOf(sample.at("position"));
    for (const Json& seen : sample.at("support")) {
      added.image_ids.push_back(seen.at(0).get<std::uint32_t>());
    }
    std::ranges::sort(added.image_ids);
  }
  return samples;
}

int NodeOf(const Json& json) { return json.is_null() ? -1 : json.get<int>(); }

FitKind FitKindOf(const std::string& name) {
  if (name == "line") return FitKind::kLine;
  if (name == "arc" || name == "circle") return FitKind::kArc;
  return name == "ellipse" ? FitKind::kEllipse : FitKind::kSpline;
}

// 0: not known.
double SigmaOf(const Json& json, const char* name) {
  const Json sigma = json.value(name, Json());
  return sigma.is_number() ? sigma.get<double>() : 0;
}

void TakeShape(const Json& json, CurveFit& fit) {
  if (fit.kind == FitKind::kArc || fit.kind == FitKind::kEllipse) {
    fit.center = VectorOf(json.at("center"));
    fit.major = VectorOf(json.at("major"));
    fit.minor = VectorOf(json.at("minor"));
    fit.start_angle = json.at("start_angle").get<double>();
    fit.end_angle = json.at("end_angle").get<double>();
  }
  if (fit.kind == FitKind::kArc) {
    fit.radius_sigma = SigmaOf(json, "radius_sigma");
    const Eigen::Vector3d axis = NormalOf(fit);
    const double sigma = SigmaOf(json, "axis_sigma");
    fit.arc_covariance.block<3, 3>(3, 3) =
        sigma * sigma * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
  }
  if (fit.kind == FitKind::kSpline) {
    for (const Json& point : json.at("control_points")) {
      fit.control_points.push_back(VectorOf(point));
    }
    fit.knots = json.at("knots").get<std::vector<double>>();
  }
}

CurveFit FitOf(const Json& json) {
  CurveFit fit;
  fit.kind = FitKindOf(json.at("kind").get<std::string>());
  fit.curve_kind = KindFromName(json.value("curve_kind", "unknown"))
                       .value_or(CurveKind::kUnknown);
  fit.closed = json.at("closed").get<bool>();
  fit.first_sample = json.at("first_sample").get<std::size_t>();
  fit.num_samples = json.at("num_samples").get<std::size_t>();
  fit.start = VectorOf(json.at("start"));
  fit.end = VectorOf(json.at("end"));
  fit.start_node = NodeOf(json.at("start_node"));
  fit.end_node = NodeOf(json.at("end_node"));
  if (!fit.closed) {
    fit.start_covariance = MatrixOf(json.at("start_covariance"));
    fit.end_covariance = MatrixOf(json.at("end_covariance"));
  }
  TakeShape(json, fit);
  fit.rms_residual = json.at("rms_residual").get<double>();
  fit.max_residual = json.at("max_residual").get<double>();
  fit.inlier_share = json.at("inlier_share").get<double>();
  fit.sigma = json.at("sigma").get<double>();
  return fit;
}

// Splines have enough knots.
bool IsWhole(const CurveFit& fit) {
  return fit.kind != FitKind::kSpline ||
         (fit.control_points.size() >= 4 &&
          fit.knots.size() == fit.control_points.size() + 4);
}

Result<CurvesFile> CurvesOf(const Json& json, bool with_samples) {
  CurvesFile file;
  if (json.contains("alignment")) {
    Json alignment = json["alignment"];
    alignment["format"] = "curvix alignment";
    alignment["version"] = 1;
    CURVIX_ASSIGN_OR_RETURN(file.alignment, AlignmentFromJson(alignment));
  }
  for (const Json& node : json.at("nodes")) {
    CurveNode& added = file.fitted.nodes.emplace_back();
    added.position = VectorOf(node.at("position"));
    added.covariance = MatrixOf(node.at("covariance"));
  }
  for (const Json& curve : json.at("curves")) {
    std::vector<CurveFit>& fits = file.fitted.curves.emplace_back().fits;
    for (const Json& fit : curve.at("fits")) {
      fits.push_back(FitOf(fit));
      if (!IsWhole(fits.back())) {
        return Status::DataLoss("a spline has too few knots");
      }
    }
    if (!with_samples) continue;
    file.samples.push_back(SamplesOf(curve.at("samples")));
    for (const CurveFit& fit : fits) {
      if (fit.first_sample + 1 > file.samples.back().size()) {
        return Status::DataLoss("a fit has samples that are not there");
      }
    }
  }
  return file;
}

}  // namespace

Result<CurvesFile> ReadCurvesFile(const fs::path& folder, bool with_samples) {
  const fs::path path = folder / "curves.json";
  std::ifstream file(path);
  if (!file) {
    return Status::NotFound(
        "There is no " + path.string() +
        ", which has the nodes and lines; run 'colmap_curvix reconstruct' "
        "first, with json among its --output_formats");
  }
  const auto unusable = [&](const std::string& why) {
    return Status::DataLoss(path.string() + " is " + why +
                            "; run 'colmap_curvix reconstruct' again");
  };
  const Json json = ReadJson(file, with_samples);
  if (json.is_discarded()) return unusable("not JSON");
  try {
    Result<CurvesFile> result = CurvesOf(json, with_samples);
    if (result.ok()) return result;
    return unusable("broken: " + result.status().message());
  } catch (const nlohmann::json::exception& error) {
    return unusable("broken: " + WhatOf(error));
  }
}

std::string NoSuchNode(std::string_view node, const FittedCurves& fitted) {
  const std::size_t count = fitted.nodes.size();
  return "there is no node " + std::string(node) +
         (count == 0 ? "; curves.json has none"
                     : "; curves.json has the nodes 0 to " +
                           std::to_string(count - 1));
}

}  // namespace curvix
