// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "evaluation/image_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/angles.h"
#include "base/grid_index.h"
#include "base/median.h"

namespace curvix {
namespace {

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
  const double angle = static_cast<double>(place.angle);
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
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
          expected_precision.Summarize(),
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

}  // namespace curvix
