// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as a view sees them.
#include "io/curve_formats.h"

#include <curvix/curves.h>
#include <string>
#include <vector>

#include "base/text_fields.h"
#include "io/curve_style.h"

namespace curvix {
namespace {

constexpr int kDecimals = 2;

void AppendHexColor(const Rgb& color, std::string& out) {
  constexpr char kDigits[] = "0123456789abcdef";
  out += '#';
  for (const std::uint8_t c : color) {
    out += kDigits[c / 16];
    out += kDigits[c % 16];
  }
}

// A path of the stretches that are shown, or of the others; none if there are
// none.
void AppendPath(const std::vector<ProjectedStretch>& stretches,
                bool is_shown,
                const std::string& attributes,
                std::string& out) {
  std::string path;
  for (const ProjectedStretch& stretch : stretches) {
    if (stretch.is_shown != is_shown) continue;
    char command = 'M';
    for (const Eigen::Vector2d& point : stretch.pixels) {
      path += command + FixedText(point.x(), kDecimals) + ' ' +
              FixedText(point.y(), kDecimals);
      command = 'L';
    }
  }
  if (!path.empty()) out += "<path " + attributes + " d=\"" + path + "\"/>";
}

}  // namespace

void EncodeSvgCurves(const CurveSource& curves,
                     const Scene& scene,
                     int view_idx,
                     const ByteSink& sink) {
  const View& view = scene.views.at(static_cast<std::size_t>(view_idx));
  const Camera& camera = CameraOf(scene, view);
  const std::string size =
      std::to_string(camera.width) + " " + std::to_string(camera.height);
  sink("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
       "\" width=\"" + std::to_string(camera.width) + "\" height=\"" +
       std::to_string(camera.height) +
       "\" fill=\"none\" stroke-width=\"1.5\" stroke-linecap=\"round\" "
       "stroke-linejoin=\"round\">\n");
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    const std::vector<ProjectedStretch> stretches =
        ProjectShownAndHidden(curve, scene, view_idx);
    std::string out =
        "<g class=\"curve\" id=\"curve_" + std::to_string(id) + "\" stroke=\"";
    AppendHexColor(CurveColor(id), out);
    out += "\">";
    AppendPath(
        stretches, false, "class=\"hidden\" stroke-opacity=\"0.25\"", out);
    AppendPath(stretches, true, "class=\"shown\"", out);
    sink(out + "</g>\n");
  });
  sink("</svg>\n");
}

}  // namespace curvix
