// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/image_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/angles.h"
#include "base/grid_index.h"
#include "base/median.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr double kBlurPx = 1.2;
constexpr float kMinUpperThreshold = 4;  // grey levels per pixel
constexpr int kMinContourPixels = 30;
constexpr double kMinLineLength = 0.02;  // of the diagonal

// From the centre of the first pixel at (0, 0), OpenCV's, to (0.5, 0.5).
const Eigen::Vector2d kHalfPixel(0.5, 0.5);

cv::Mat1b EightBits(const GrayImage& image) {
  const cv::Mat floats(image.height,
                       image.width,
                       CV_32F,
                       const_cast<float*>(image.pixels.data()));
  cv::Mat1b bytes;
  floats.convertTo(bytes, CV_8U);
  return bytes;
}

struct Gradient {
  cv::Mat1f x, y;
  cv::Mat1f magnitude;
};

Gradient FindGradient(const cv::Mat1b& image) {
  constexpr double kSobelSum = 8;
  cv::Mat1b blurred;
  cv::GaussianBlur(image, blurred, {}, kBlurPx);
  Gradient gradient;
  cv::Sobel(blurred, gradient.x, CV_32F, 1, 0, 3, 1 / kSobelSum);
  cv::Sobel(blurred, gradient.y, CV_32F, 0, 1, 3, 1 / kSobelSum);
  cv::magnitude(gradient.x, gradient.y, gradient.magnitude);
  return gradient;
}

float UpperThreshold(const cv::Mat1f& magnitude) {
  std::vector<float> values(magnitude.begin(), magnitude.end());
  const auto tenth =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), tenth, values.end());
  return std::max(kMinUpperThreshold, *tenth);
}

// Non-zero: a pixel of an edge.
cv::Mat1b Canny(const Gradient& gradient) {
  constexpr double kScale = 8;  // keeps an eighth of a grey level
  cv::Mat x, y;
  gradient.x.convertTo(x, CV_16S, kScale);
  gradient.y.convertTo(y, CV_16S, kScale);
  const double upper =
      kScale * static_cast<double>(UpperThreshold(gradient.magnitude));
  cv::Mat1b edges;
  cv::Canny(x, y, edges, upper / 2, upper, true);
  return edges;
}

constexpr double kShiftPx = 12;
constexpr double kStrongShare = 0.2;

struct Tolerance {
  double distance_px = 0;
  double angle_deg = 0;
};
constexpr Tolerance kCurveOnContour = {1.5, 15};
constexpr Tolerance kContourOnCurve = {2, 15};
constexpr Tolerance kLineOnCurve = {3, 10};

// Finds out whether there is something of the same direction nearby.
class Counterparts {
 public:
  Counterparts(const std::vector<Edge2d>& places, const Tolerance& tolerance)
      : grid_(places, tolerance.distance_px),
        distance_px_(tolerance.distance_px),
        min_cosine_(std::cos(DegToRad(tolerance.angle_deg))) {}

  bool Has(const Eigen::Vector2d& position,
           const Eigen::Vector2d& direction) const {
    bool found = false;
    grid_.VisitAround(position, distance_px_, [&](const IndexedEdge& other) {
      found = found || (std::abs(other.tangent.cast<double>().dot(direction)) >
                            min_cosine_ &&
                        (other.position.cast<double>() - position).norm() <
                            distance_px_);
    });
    return found;
  }

 private:
  GridIndex grid_;
  double distance_px_;
  double min_cosine_;
};

ShareTally Look(const Edge2d& place,
                const Counterparts& counterparts,
                double amount = 1) {
  const Eigen::Vector2d direction = TangentAt(place.angle);
  const Eigen::Vector2d across =
      kShiftPx * Eigen::Vector2d(-direction.y(), direction.x());
  ShareTally tally;
  tally.amount = amount;
  if (counterparts.Has(place.position, direction)) tally.hits = amount;
  for (const Eigen::Vector2d& shift : {across, Eigen::Vector2d(-across)}) {
    if (counterparts.Has(place.position + shift, direction)) {
      tally.hits_by_chance += amount / 2;
    }
  }
  return tally;
}

void LookForCurves(const std::vector<DrawnCurve>& drawn,
                   const std::vector<Edge2d>& contours,
                   ImageTally* tally) {
  const Counterparts on_contour(contours, kCurveOnContour);
  for (const DrawnCurve& curve : drawn) {
    for (const DrawnPlace& place : curve) {
      const ShareTally looked = Look(place.edge, on_contour, place.num_steps);
      tally->precision.Add(looked);
      if (place.is_expected) tally->expected_precision.Add(looked);
    }
  }
}

// The least strength of the strongest fifth.
float StrongFrom(const std::vector<Edge2d>& contours) {
  if (contours.empty()) return 0;
  std::vector<float> strengths;
  strengths.reserve(contours.size());
  for (const Edge2d& pixel : contours) strengths.push_back(pixel.strength);
  const auto least =
      strengths.begin() +
      static_cast<std::ptrdiff_t>(std::ceil(
          (1 - kStrongShare) * static_cast<double>(strengths.size() - 1)));
  std::nth_element(strengths.begin(), least, strengths.end());
  return *least;
}

// Chance is that of all contours: the strong ones alone are too regular.
ShareTally LookForStrongContours(const std::vector<Edge2d>& contours,
                                 const Counterparts& on_curve) {
  const float strong_from = StrongFrom(contours);
  ShareTally all, strong;
  for (const Edge2d& pixel : contours) {
    const ShareTally looked = Look(pixel, on_curve);
    all.Add(looked);
    if (pixel.strength >= strong_from) strong.Add(looked);
  }
  if (all.amount > 0) {
    strong.hits_by_chance = all.hits_by_chance * strong.amount / all.amount;
  }
  return strong;
}

}  // namespace

void ShareTally::Add(const ShareTally& other) {
  amount += other.amount;
  hits += other.hits;
  hits_by_chance += other.hits_by_chance;
}

ShareAboveChance ShareTally::Summarize() const {
  if (!(amount > 0)) return {};
  return {hits / amount, hits_by_chance / amount};
}

void ImageTally::Add(const ImageTally& other) {
  precision.Add(other.precision);
  expected_precision.Add(other.expected_precision);
  strong_contours.Add(other.strong_contours);
  long_lines.Add(other.long_lines);
  pieces_px.insert(
      pieces_px.end(), other.pieces_px.begin(), other.pieces_px.end());
}

ImageAgreement ImageTally::Summarize() const {
  return {precision.Summarize(),
          expected_precision.amount > 0
              ? std::optional(expected_precision.Summarize())
              : std::nullopt,
          strong_contours.Summarize(),
          long_lines.Summarize(),
          MedianOr(0, pieces_px)};
}

ImageTally CompareWithImage(const std::vector<DrawnCurve>& drawn,
                            const std::vector<Edge2d>& contours,
                            const std::vector<Edge2d>& long_lines) {
  ImageTally tally;
  LookForCurves(drawn, contours, &tally);
  std::vector<Edge2d> places;
  for (const DrawnCurve& curve : drawn) {
    double length_px = 0;
    for (const DrawnPlace& place : curve) {
      places.push_back(place.edge);
      length_px += place.length_px;
    }
    tally.pieces_px.push_back(length_px);
  }
  tally.strong_contours =
      LookForStrongContours(contours, Counterparts(places, kContourOnCurve));
  const Counterparts line_on_curve(places, kLineOnCurve);
  for (const Edge2d& place : long_lines) {
    tally.long_lines.Add(Look(place, line_on_curve));
  }
  return tally;
}

std::vector<Edge2d> FindContours(const GrayImage& image) {
  const Gradient gradient = FindGradient(EightBits(image));
  cv::Mat1i labels, stats;
  cv::Mat1d centroids;
  cv::connectedComponentsWithStats(
      Canny(gradient), labels, stats, centroids, 8, CV_32S);
  std::vector<Edge2d> contours;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == 0 || stats(label, cv::CC_STAT_AREA) < kMinContourPixels) {
        continue;
      }
      Edge2d pixel;
      pixel.position = Eigen::Vector2d(x, y) + kHalfPixel;
      pixel.angle = std::atan2(gradient.x(y, x), -gradient.y(y, x));
      pixel.strength = gradient.magnitude(y, x);
      contours.push_back(pixel);
    }
  }
  return contours;
}

std::vector<Edge2d> FindLongLines(const GrayImage& image) {
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_ADV)
      ->detect(EightBits(image), segments);
  const double min_length =
      kMinLineLength * std::hypot(image.width, image.height);
  std::vector<Edge2d> places;
  for (const cv::Vec4f& s : segments) {
    const Eigen::Vector2d from =
        Eigen::Vector2f(s[0], s[1]).cast<double>() + kHalfPixel;
    const Eigen::Vector2d along =
        Eigen::Vector2f(s[2] - s[0], s[3] - s[1]).cast<double>();
    const double length = along.norm();
    if (length < min_length) continue;
    const int n = static_cast<int>(length);
    for (int i = 0; i < n; ++i) {
      Edge2d place;
      place.position = from + (i + 0.5) / n * along;
      place.angle = static_cast<float>(std::atan2(along.y(), along.x()));
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace curvix
