// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/viewer_html.h"

#include <curvix/scene.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/median.h"
#include "geometry/lens.h"
#include "measuring/main_axes.h"
#include "plugin/export/small_images.h"

namespace curvix {
namespace {

constexpr int kNumPhotos = 16;
constexpr int kPhotoSize = 640;          // pixels
constexpr int kNumCoordinateDigits = 6;  // with respect to the scene
constexpr int kNumCovarianceDigits = 5;

std::string Base64(std::string_view bytes) {
  constexpr char kLetters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const char c = i + k < bytes.size() ? bytes[i + k] : '\0';
      word = word << 8 | static_cast<unsigned char>(c);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k > bytes.size();
      text += is_padding ? '=' : kLetters[word >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

// Without its image where `jpeg` is empty.
Json ImageJson(const View& view,
               const Camera& camera,
               const std::string& jpeg) {
  const Eigen::Matrix3d k = PinholeCalibration(camera);
  const Eigen::Matrix3d r =
      view.cam_from_world.rotation.toRotationMatrix().transpose();  // by rows
  const Eigen::Vector3d& t = view.cam_from_world.translation;
  Json json = {{"name", view.name},
               {"w", camera.width},
               {"h", camera.height},
               {"K", {k(0, 0), k(1, 1), k(0, 2), k(1, 2)}},
               {"R", std::vector<double>(r.data(), r.data() + r.size())},
               {"t", {t.x(), t.y(), t.z()}}};
  if (!jpeg.empty()) json["photo"] = "data:image/jpeg;base64," + Base64(jpeg);
  return json;
}

// Views by the number of samples that they support, most first.
std::vector<std::pair<int, int>> SupportingViews(const Curve& curve) {
  std::map<int, int> counts;
  for (const CurveSample& sample : curve.samples) {
    for (const EdgeRef& ref : sample.support) ++counts[ref.view_idx];
  }
  std::vector<std::pair<int, int>> views(counts.begin(), counts.end());
  std::ranges::stable_sort(
      views, [](const auto& a, const auto& b) { return a.second > b.second; });
  return views;
}

double MedianSigma(const Curve& curve) {
  std::vector<double> sigmas;
  for (const CurveSample& sample : curve.samples) {
    sigmas.push_back(sample.sigma);
  }
  return MedianOrNan(std::move(sigmas));
}

std::string_view KindOf(const FittedCurve& fitted) {
  return fitted.fits.size() > 1 ? "chain" : KindName(fitted.fits.front());
}

// The upper triangle, by rows.
Json CovarianceJson(const Eigen::Matrix3d& covariance) {
  std::array<double, 6> values = Triangle(covariance);
  for (double& value : values) {
    value = RoundedToDigits(value, kNumCovarianceDigits);
  }
  return values;
}

Json ShortFitJson(const CurveFit& fit) {
  Json json = {{"k", KindName(fit)},
               {"i", {fit.first_sample, fit.num_samples}},
               {"l", Length(fit)},
               {"e", fit.rms_residual},
               {"s", fit.sigma}};
  if (fit.kind == FitKind::kLine) {
    json["a"] = VectorJson(fit.start);
    json["b"] = VectorJson(fit.end);
    json["qa"] = CovarianceJson(fit.start_covariance);
    json["qb"] = CovarianceJson(fit.end_covariance);
  } else if (fit.kind == FitKind::kArc) {
    json["r"] = fit.major.norm();
    json["rs"] = fit.radius_sigma;
    json["o"] = VectorJson(fit.center);
    json["n"] = VectorJson(NormalOf(fit));
  }
  return json;
}

Json FitsJson(const FittedCurve& fitted) {
  Json fits = Json::array();
  for (const CurveFit& fit : fitted.fits) fits.push_back(ShortFitJson(fit));
  return fits;
}

std::string ShortCurveText(const Curve& curve,
                           const FittedCurve& fitted,
                           int num_decimals) {
  std::vector<double> coordinates;
  std::vector<std::size_t> support;
  for (const CurveSample& sample : curve.samples) {
    support.push_back(sample.support.size());
    for (const double x : sample.position) {
      coordinates.push_back(Rounded(x, num_decimals));
    }
  }
  // The long lists are written without Json values, which take time.
  std::string text = curve.closed ? "{\"c\":true" : "{\"c\":false";
  text += ",\"p\":";
  AppendJsonList(coordinates, AppendJson<double>, text);
  text += ",\"s\":";
  AppendJsonList(support, AppendJson<std::size_t>, text);
  const Json rest = {{"g", MedianSigma(curve)},
                     {"l", Length(curve)},
                     {"k", KindOf(fitted)},
                     {"w", KindName(MainKind(curve))},
                     {"f", FitsJson(fitted)},
                     {"v", SupportingViews(curve)}};
  return text + ',' + JsonText(rest).substr(1);
}

// So many that the size of the curves has kNumCoordinateDigits.
int NumDecimals(const CurveSource& curves) {
  Eigen::AlignedBox3d box;
  curves.ForEach([&](std::size_t, const Curve& curve) {
    for (const CurveSample& sample : curve.samples) box.extend(sample.position);
  });
  const double size = box.isEmpty() ? 1 : box.diagonal().norm();
  if (!(size > 0)) return kNumCoordinateDigits;
  return std::clamp(
      kNumCoordinateDigits - static_cast<int>(std::floor(std::log10(size))),
      0,
      15);
}

Json NodesJson(const std::vector<CurveNode>& nodes) {
  Json json = Json::array();
  for (const CurveNode& node : nodes) {
    json.push_back(
        {VectorJson(node.position), CovarianceJson(node.covariance)});
  }
  return json;
}

// Of a point that all its views see to one pixel.
Eigen::Matrix3d CovarianceOf(const ScenePoint& point, const Scene& scene) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const int view_idx : point.view_idxs) {
    const View& view = scene.views[static_cast<std::size_t>(view_idx)];
    const Eigen::Matrix3d k = PinholeCalibration(CameraOf(scene, view));
    const Eigen::Matrix<double, 2, 3> jacobian =
        PixelJacobian(k.topLeftCorner<2, 2>(),
                      view.cam_from_world * point.position) *
        view.cam_from_world.rotation.toRotationMatrix();
    information += jacobian.transpose() * jacobian;
  }
  return information.inverse();
}

// Some of the points of the model, evenly by number, with their covariances.
Json PointsJson(const Scene& scene, int num_decimals) {
  Json json = Json::array();
  const std::size_t step = ViewerPointStep(scene.points.size());
  for (std::size_t i = 0; i < scene.points.size(); i += step) {
    const ScenePoint& point = scene.points[i];
    const Eigen::Matrix3d covariance = CovarianceOf(point, scene);
    if (!covariance.allFinite()) continue;
    Json position = Json::array();
    for (const double x : point.position) {
      position.push_back(Rounded(x, num_decimals));
    }
    json.push_back({position, CovarianceJson(covariance)});
  }
  return json;
}

// What the coordinates are: the axes are those that `align` found or else, if
// there are any, those that most lines share.
Json FrameJson(const CurveRecord& record) {
  Json json = {{"unit", ""}, {"scaleSigma", 0}};
  if (record.alignment != nullptr) {
    json["unit"] = record.alignment->unit;
    json["scaleSigma"] = record.alignment->scale_sigma();
  }
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (record.alignment == nullptr || !record.alignment->has_rotation) {
    const Result<MainAxes> found =
        FindMainAxes(record.fitted,
                     MeanUp(record.scene.views),
                     MeanViewDirection(record.scene.views));
    if (!found.ok()) return json;
    axes = found->axes.world_from_model.toRotationMatrix();
  }
  for (int i = 0; i < 3; ++i) {
    json["axes"].push_back(VectorJson(axes.row(i).transpose()));
  }
  return json;
}

}  // namespace

void EncodeViewerHtml(const CurveRecord& record,
                      int num_threads,
                      const ByteSink& sink) {
  const std::string_view page = ViewerTemplate();
  constexpr std::string_view kMark = "%CURVIX_DATA%";
  const std::size_t mark = page.find(kMark);
  sink(page.substr(0, mark));
  const Scene& scene = record.scene;
  const std::vector<int> shown = SpreadViews(scene, kNumPhotos);
  std::vector<std::string> photos =
      SmallPinholeJpegs(scene, shown, kPhotoSize, num_threads);
  std::vector<std::string> jpegs(scene.views.size());
  for (std::size_t k = 0; k < shown.size(); ++k) {
    jpegs[static_cast<std::size_t>(shown[k])] = std::move(photos[k]);
  }
  sink("{\"images\":[");
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const View& view = scene.views[i];
    if (i > 0) sink(",\n");
    sink(JsonText(ImageJson(view, CameraOf(scene, view), jpegs[i])));
  }
  const int num_decimals = NumDecimals(record.curves);
  sink("],\"frame\":" + JsonText(FrameJson(record)) +
       ",\"nodes\":" + JsonText(NodesJson(record.fitted.nodes)) +
       ",\"points\":" + JsonText(PointsJson(scene, num_decimals)) +
       ",\"curves\":[");
  JsonLines lines(num_threads, sink);
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    lines.Add([&record, num_decimals, id, curve] {
      return ShortCurveText(curve, record.fitted.curves[id], num_decimals);
    });
  });
  lines.Flush();
  sink("]}");
  sink(page.substr(mark + kMark.size()));
}

}  // namespace curvix
