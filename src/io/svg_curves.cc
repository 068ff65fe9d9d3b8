// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as a view sees them.
#include "io/curve_formats.h"

#include <curvix/curves.h>
#include <string>

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

}  // namespace

void EncodeSvgCurves(const CurveSource& curves,
                     const View& view,
                     const Camera& camera,
                     const ByteSink& sink) {
  const std::string size =
      std::to_string(camera.width) + " " + std::to_string(camera.height);
  sink("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
       "\" width=\"" + std::to_string(camera.width) + "\" height=\"" +
       std::to_string(camera.height) +
       "\" fill=\"none\" stroke-width=\"1.5\" stroke-linecap=\"round\" "
       "stroke-linejoin=\"round\">\n");
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    std::string out = "<path class=\"curve\" id=\"curve_" + std::to_string(id) +
                      "\" stroke=\"";
    AppendHexColor(CurveColor(id), out);
    out += "\" d=\"";
    for (const auto& segment : ProjectCurve(curve, view, camera)) {
      char command = 'M';
      for (const Eigen::Vector2d& point : segment) {
        out += command;
        AppendFixed(point.x(), kDecimals, out);
        out += ' ';
        AppendFixed(point.y(), kDecimals, out);
        command = 'L';
      }
    }
    sink(out + "\"/>\n");
  });
  sink("</svg>\n");
}

}  // namespace curvix
