// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Sheets as SVG.
#include "io/sheet_formats.h"

#include <cmath>
#include <string_view>
#include <vector>

#include "base/angles.h"
#include "base/text_fields.h"
#include "drawing/cut_fit.h"
#include "drawing/dimension_marks.h"
#include "io/drawing_layers.h"

namespace curvix {
namespace {

constexpr double kFrameWidth = 0.25;  // mm
constexpr double kDimensionWidth = 0.18;
constexpr double kCapitalHeight = 0.716;  // of a font's size
constexpr char kPaleness[] = "0.5";

std::string Number(double value) { return FixedText(value, 4); }

// "a b"
std::string Pair(double a, double b) { return Number(a) + ' ' + Number(b); }

// Control characters, most of which XML cannot have, are blanks.
std::string Escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    out += c == '&'     ? "&amp;"
           : c == '<'   ? "&lt;"
           : c == '"'   ? "&quot;"
           : is_control ? " "
                        : std::string(1, c);
  }
  return out;
}

// The name of a file beside the drawing, as a URL.
std::string UrlOf(std::string_view file) {
  constexpr std::string_view kReserved = "%#?:\\";
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string url;
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x80 && kReserved.find(c) == kReserved.npos) {
      url += c;
    } else {
      url += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return url;
}

// Points of the sheet in SVG's frame: mm, y down.
class Page {
 public:
  explicit Page(const Sheet& sheet) : sheet_(sheet) {}

  std::string OfPaper(const Eigen::Vector2d& mm) const {
    return Pair(mm.x(), sheet_.size.y() - mm.y());
  }
  std::string Of(const Eigen::Vector3d& x) const {
    return OfPaper(sheet_.ToPaper(x.head<2>()));
  }
  std::string Path(const CurveFit& fit) const {
    std::string path = "M" + Of(PointAt(fit, 0));
    switch (fit.kind) {
      case FitKind::kLine:
        return path + "L" + Of(fit.end);
      case FitKind::kArc:
      case FitKind::kEllipse:
        return path + ArcTo(fit);
      case FitKind::kSpline:
        break;
    }
    for (std::size_t k = 0; k + 1 < fit.knots.size(); ++k) {
      if (!(fit.knots[k] < fit.knots[k + 1])) continue;
      const CurveFit piece = PartOf(fit, fit.knots[k], fit.knots[k + 1]);
      path += "C" + Of(piece.control_points[1]) + ' ' +
              Of(piece.control_points[2]) + ' ' + Of(piece.control_points[3]);
    }
    return path;
  }

 private:
  // In two halves, since SVG has no whole arcs.
  std::string ArcTo(const CurveFit& fit) const {
    const double turn = -std::atan2(fit.major.y(), fit.major.x());
    const std::string half =
        "A" +
        Pair(sheet_.scale * fit.major.norm(), sheet_.scale * fit.minor.norm()) +
        ' ' + Number(RadToDeg(turn)) + " 0 0 ";
    return half + Of(PointAt(fit, 0.5)) + half + Of(PointAt(fit, 1));
  }

  const Sheet& sheet_;
};

std::string BeginLayer(const std::string& name, double width) {
  return "<g id=\"" + name +
         "\" inkscape:groupmode=\"layer\" "
         "inkscape:label=\"" +
         name + "\" stroke-width=\"" + Number(width) + "\">\n";
}

std::string PictureText(const Sheet& sheet) {
  const SheetPicture& picture = *sheet.picture;
  const Eigen::Vector2d size = picture.pixel * picture.size.cast<double>();
  const Eigen::Vector2d top_left =
      picture.corner + Eigen::Vector2d(0, size.y());
  const Eigen::Vector2d at = sheet.ToPaper(top_left);
  return "<image xlink:href=\"" + Escaped(UrlOf(picture.file)) + "\" x=\"" +
         Number(at.x()) + "\" y=\"" + Number(sheet.size.y() - at.y()) +
         "\" width=\"" + Number(sheet.scale * size.x()) + "\" height=\"" +
         Number(sheet.scale * size.y()) +
         "\" preserveAspectRatio=\"none\" opacity=\"" + kPaleness + "\"/>\n";
}

std::string LinesText(const std::vector<SheetLine>& lines, const Page& page) {
  std::string out;
  for (const SheetLine& line : lines) {
    out += "<path d=\"M" + page.OfPaper(line.start) + "L" +
           page.OfPaper(line.end) + "\"/>\n";
  }
  return out;
}

// `attributes` go into the element.
std::string TextText(const Sheet& sheet,
                     const SheetText& text,
                     const std::string& attributes) {
  const double y = sheet.size.y() - text.start.y();
  return "<text x=\"" + Number(text.start.x()) + "\" y=\"" + Number(y) +
         "\" font-size=\"" + Number(text.height / kCapitalHeight) +
         "\" font-family=\"sans-serif\" stroke=\"none\" fill=\"black\"" +
         attributes + ">" + Escaped(text.text) + "</text>\n";
}

std::string FrameText(const Sheet& sheet, const Page& page) {
  std::string out =
      BeginLayer("FRAME", kFrameWidth) + LinesText(sheet.lines, page);
  for (const SheetText& text : sheet.texts) out += TextText(sheet, text, "");
  return out + "</g>\n";
}

std::string DimensionsText(const Sheet& sheet, const Page& page) {
  std::string out = BeginLayer("DIMENSIONS", kDimensionWidth);
  for (const SheetDimension& dimension : sheet.dimensions) {
    const DimensionMarks marks = MarksOf(dimension, sheet);
    const std::string turn = " text-anchor=\"middle\" transform=\"rotate(" +
                             Number(-RadToDeg(marks.angle)) + ' ' +
                             page.OfPaper(marks.text.start) + ")\"";
    out += LinesText(marks.lines, page) + TextText(sheet, marks.text, turn);
  }
  return out + "</g>\n";
}

}  // namespace

std::string EncodeSvgSheet(const Sheet& sheet) {
  const Page page(sheet);
  const std::string width = Number(sheet.size.x());
  const std::string height = Number(sheet.size.y());
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
      "width=\"" +
      width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + ' ' +
      height +
      "\" fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\">\n"
      "<rect width=\"" +
      width + "\" height=\"" + height + "\" fill=\"white\" stroke=\"none\"/>\n";
  if (sheet.picture) {
    out += BeginLayer("PHOTOGRAPH", 0) + PictureText(sheet) + "</g>\n";
  }
  const std::string dashes =
      " stroke-dasharray=\"" + Pair(kDash, kDashGap) + "\"";
  for (int k = 0; k < kNumCurveKinds; ++k) {
    const auto kind = static_cast<CurveKind>(k);
    out += BeginLayer(LayerOf(kind).name, LayerOf(kind).width);
    for (const auto& [fit, is_hidden] : sheet.curves) {
      if (fit.curve_kind != kind) continue;
      out += "<path class=\"" + std::string(KindName(fit)) + "\"" +
             (is_hidden ? dashes : "") + " d=\"" + page.Path(fit) + "\"/>\n";
    }
    out += "</g>\n";
  }
  if (!sheet.dimensions.empty()) out += DimensionsText(sheet, page);
  return out + FrameText(sheet, page) + "</svg>\n";
}

bool IsSvgSheet(std::string_view text) {
  return text.starts_with("<svg ") &&
         text.find(BeginLayer("FRAME", kFrameWidth)) != text.npos;
}

}  // namespace curvix
