// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A drawing to scale, on a sheet of paper with
// frame, title and scale bar.
#pragma once

#include <curvix/fitting.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

// A picture in the plane of the drawing.
struct SheetPicture {
  std::string file;                                // beside the drawing
  Eigen::Vector2i size = Eigen::Vector2i::Zero();  // pixels
  // Of its lower left corner: drawing units.
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  double pixel = 0;  // side of a pixel, drawing units
};

// On the paper (z = 0), in drawing units.
struct SheetCurve {
  CurveFit fit;
  bool is_hidden = false;  // dashed
};

struct SheetLine {
  Eigen::Vector2d start, end;  // mm on the paper, from its lower left corner
};

struct SheetText {
  Eigen::Vector2d start;  // of its baseline, mm on the paper
  double height = 0;      // of capitals, mm
  std::string text;       // UTF-8
};

// A length, or the radius of an arc. Drawing units.
struct SheetDimension {
  bool is_radius = false;
  Eigen::Vector2d a = Eigen::Vector2d::Zero();  // an end, or the centre
  Eigen::Vector2d b = Eigen::Vector2d::Zero();  // the other, or a point of it
  double value = 0;
  std::string text;
  // Of the dimension line from a to b, to the left, mm on the paper.
  double shift = 0;
};

struct Sheet {
  std::vector<SheetCurve> curves;       // drawing units are those of the curves
  std::optional<SheetPicture> picture;  // beneath
  std::vector<SheetLine> lines;         // frame and scale bar
  std::vector<SheetText> texts;
  std::vector<SheetDimension> dimensions;
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    // of the paper, mm
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // its lower left one,
                                                     // drawing units
  double scale = 1;        // mm on the paper per drawing unit
  std::string unit;        // as in SheetSettings
  double denominator = 0;  // 50 for 1:50; 0: no scale is known
  std::string scale_text;  // "1:50 on A3"

  // From the paper to drawing units, and back.
  Eigen::Vector2d FromPaper(const Eigen::Vector2d& mm) const {
    return corner + mm / scale;
  }
  Eigen::Vector2d ToPaper(const Eigen::Vector2d& x) const {
    return (x - corner) * scale;
  }
};

struct SheetSettings {
  std::string title;
  std::string subtitle;
  std::string unit;          // of the drawing; "": not known
  double millimetres = 0;    // that it has; 0: not known
  std::string paper = "a3";  // "a0" to "a4", broad side down
  // 50 for 1:50, 0.5 for 2:1. 0: the largest scale with which the drawing fits,
  // of those whose denominator is 1, 2 or 5 times a power of ten.
  double denominator = 0;
  bool has_dimensions = false;  // leaves room for them around the drawing
};

// 50 of "1:50" or "50", 0.5 of "2:1". nullopt: no scale.
std::optional<double> ParseScale(std::string_view text);

// Dashes and the gaps between them, mm.
constexpr double kDash = 3;
constexpr double kDashGap = 1.5;
// Height of the capitals of dimensions, mm.
constexpr double kDimensionText = 2.5;

// The bounding box of the curves, drawing units. Empty without curves.
Eigen::AlignedBox2d BoundsOf(const std::vector<SheetCurve>& curves);

// The same without what lies far away: without curves that a gap separates from
// the others, across or upwards as wide as three tenths of the longer side of
// what these take. All curves count if those have more than a tenth of the
// length.
Eigen::AlignedBox2d MainBoundsOf(const std::vector<SheetCurve>& curves);

// `curves` and `picture` in the middle of a sheet. Without a known unit there
// is no scale, and the sheet says how long a unit is. kInvalidArgument: there
// are no curves, a scale is asked for and the unit is not known, or the drawing
// is larger than the paper.
Result<Sheet> LaySheet(const SheetSettings& settings,
                       std::vector<SheetCurve> curves,
                       std::optional<SheetPicture> picture);

}  // namespace curvix
