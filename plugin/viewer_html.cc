// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/viewer_html.h"

#include <curvix/camera_model.h>
#include <curvix/text_fields.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "plugin/median.h"
#include "plugin/pictures.h"
#include "plugin/spread_views.h"

namespace curvix {
namespace {

constexpr int kNumPhotos = 16;
constexpr int kPhotoSize = 640;  // pixels
constexpr int kDigits = 6;       // of coordinates, with respect to the scene

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

// Numbers between brackets.
template <typename Numbers>
std::string List(const Numbers& numbers) {
  std::string text = "[";
  for (const auto& number : numbers) {
    if (text.size() > 1) text += ',';
    AppendNumber(number, text);
  }
  return text + "]";
}

std::string ImageJson(const View& view, const Camera& camera, bool has_photo) {
  const Eigen::Matrix3d k = PinholeCalibration(camera);
  const Eigen::Matrix3d r =
      view.cam_from_world.rotation.toRotationMatrix().transpose();  // by rows
  const Eigen::Vector3d& t = view.cam_from_world.translation;
  std::string text =
      "{\"name\":" + JsonText(view.name) +
      ",\"w\":" + std::to_string(camera.width) +
      ",\"h\":" + std::to_string(camera.height) + ",\"K\":" +
      List(std::vector<double>{k(0, 0), k(1, 1), k(0, 2), k(1, 2)}) +
      ",\"R\":" + List(std::vector<double>(r.data(), r.data() + 9)) +
      ",\"t\":" + List(std::vector<double>{t.x(), t.y(), t.z()});
  const auto photo = has_photo ? SmallPinholeJpeg(view, camera, kPhotoSize)
                               : Result<std::string>(Status());
  if (photo.ok()) {
    text += ",\"photo\":\"data:image/jpeg;base64," + Base64(*photo) + "\"";
  }
  return text + "}";
}

// Views by the number of samples that they support, most first.
std::vector<std::pair<int, int>> SupportingViews(const Curve& curve) {
  std::map<int, int> counts;
  for (const CurveSample& sample : curve.samples) {
    for (const EdgeRef& ref : sample.support) ++counts[ref.view_idx];
  }
  std::vector<std::pair<int, int>> views(counts.begin(), counts.end());
  std::stable_sort(
      views.begin(), views.end(), [](const auto& a, const auto& b) {
        return a.second > b.second;
      });
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

std::string FitsJson(const FittedCurve& fitted) {
  std::string text = "[";
  for (const CurveFit& fit : fitted.fits) {
    if (text.size() > 1) text += ',';
    text += "{\"k\":\"" + std::string(KindName(fit)) + "\",\"l\":";
    AppendNumber(Length(fit), text);
    if (fit.kind == FitKind::kArc) {
      text += ",\"r\":";
      AppendNumber(fit.major.norm(), text);
    }
    text += ",\"e\":";
    AppendNumber(fit.rms_residual, text);
    text += '}';
  }
  return text + "]";
}

std::string CurveJson(const Curve& curve,
                      const FittedCurve& fitted,
                      int num_decimals) {
  std::string text = std::string("{\"c\":") + (curve.closed ? "true" : "false");
  std::vector<std::size_t> support;
  text += ",\"p\":[";
  for (const CurveSample& sample : curve.samples) {
    support.push_back(sample.support.size());
    for (int i = 0; i < 3; ++i) {
      if (text.back() != '[') text += ',';
      AppendRounded(sample.position[i], num_decimals, text);
    }
  }
  text += "],\"s\":" + List(support) + ",\"g\":";
  AppendNumber(MedianSigma(curve), text);
  text += ",\"l\":";
  AppendNumber(Length(curve), text);
  text += ",\"k\":\"" + std::string(KindOf(fitted)) +
          "\",\"f\":" + FitsJson(fitted) + ",\"v\":[";
  for (const auto& [view_idx, count] : SupportingViews(curve)) {
    if (text.back() != '[') text += ',';
    text += "[" + std::to_string(view_idx) + "," + std::to_string(count) + "]";
  }
  return text + "]}";
}

// So many that the size of the curves has kDigits.
int NumDecimals(const CurveSet& curves) {
  Eigen::AlignedBox3d box;
  for (const Curve& curve : curves.curves) {
    for (const CurveSample& sample : curve.samples) box.extend(sample.position);
  }
  const double size = box.isEmpty() ? 1 : box.diagonal().norm();
  if (!(size > 0)) return kDigits;
  return std::clamp(
      kDigits - static_cast<int>(std::floor(std::log10(size))), 0, 15);
}

}  // namespace

std::string ViewerHtml(const CurveRecord& record) {
  const Scene& scene = record.scene;
  const std::vector<int> with_photo = SpreadViews(scene, kNumPhotos);
  std::vector<std::string> images(scene.views.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const View& view = scene.views[i];
    images[i] = ImageJson(
        view,
        scene.cameras[static_cast<std::size_t>(view.camera_idx)],
        std::binary_search(
            with_photo.begin(), with_photo.end(), static_cast<int>(i)));
  }
  std::string json = "{\"images\":[";
  for (const std::string& image : images) {
    if (json.back() != '[') json += ",\n";
    json += image;
  }
  json += "],\"nodes\":[";
  for (const CurveNode& node : record.fitted.nodes) {
    if (json.back() != '[') json += ',';
    json +=
        List(std::vector<double>(node.position.begin(), node.position.end()));
  }
  json += "],\"curves\":[";
  const int num_decimals = NumDecimals(record.curves);
  for (std::size_t i = 0; i < record.curves.curves.size(); ++i) {
    if (i > 0) json += ",\n";
    json += CurveJson(
        record.curves.curves[i], record.fitted.curves[i], num_decimals);
  }
  json += "]}";
  const std::string_view page = ViewerTemplate();
  constexpr std::string_view kMark = "@DATA@";
  const std::size_t mark = page.find(kMark);
  return std::string(page.substr(0, mark)) + json +
         std::string(page.substr(mark + kMark.size()));
}

}  // namespace curvix
