// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/image_agreement.h"

#include <gtest/gtest.h>
#include <cstddef>
#include <vector>

namespace curvix {
namespace {

// Places one pixel apart on a horizontal line.
std::vector<Edge2d> PlacesOnLine(double x_begin,
                                 double x_end,
                                 double y,
                                 float strength = 1) {
  std::vector<Edge2d> places;
  for (double x = x_begin; x < x_end; ++x) {
    Edge2d place;
    place.position = {x + 0.5, y};
    place.strength = strength;
    places.push_back(place);
  }
  return places;
}

std::vector<Edge2d> Join(const std::vector<std::vector<Edge2d>>& lines) {
  std::vector<Edge2d> all;
  for (const std::vector<Edge2d>& line : lines) {
    all.insert(all.end(), line.begin(), line.end());
  }
  return all;
}

DrawnCurve Drawn(const std::vector<Edge2d>& places, bool is_expected = true) {
  DrawnCurve drawn;
  for (const Edge2d& edge : places) drawn.push_back({edge, 1, 1, is_expected});
  return drawn;
}

ImageAgreement Compare(const std::vector<DrawnCurve>& drawn,
                       const std::vector<Edge2d>& contours,
                       const std::vector<Edge2d>& long_lines = {}) {
  return CompareWithImage(drawn, contours, long_lines).Summarize();
}

TEST(CompareWithImage, WhatIsDrawnWhereAContourIsCounts) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  const ImageAgreement exact = Compare({Drawn(contour)}, contour, contour);
  for (const ShareAboveChance& share : {exact.precision,
                                        *exact.expected_precision,
                                        exact.strong_contours,
                                        exact.long_lines}) {
    EXPECT_EQ(share.share, 1);
    EXPECT_EQ(share.chance, 0);
    EXPECT_EQ(share.Lift(), 1);
  }
  EXPECT_EQ(exact.median_piece_px, 100);
}

TEST(CompareWithImage, HasTolerancesOfItsOwnForEachFigure) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  const auto beside = [&](double distance_px) {
    return Compare(
        {Drawn(PlacesOnLine(0, 100, 50 + distance_px))}, contour, contour);
  };
  EXPECT_EQ(beside(1.4).precision.share, 1);
  EXPECT_EQ(beside(1.6).precision.share, 0);
  EXPECT_EQ(beside(1.9).strong_contours.share, 1);
  EXPECT_EQ(beside(2.1).strong_contours.share, 0);
  EXPECT_EQ(beside(2.9).long_lines.share, 1);
  EXPECT_EQ(beside(3.1).long_lines.share, 0);
}

TEST(CompareWithImage, AsksForTheSameDirectionEitherWay) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  std::vector<Edge2d> curve = contour;
  for (Edge2d& place : curve) place.angle = 3.14159265f;
  EXPECT_EQ(Compare({Drawn(curve)}, contour).precision.share, 1);
  for (Edge2d& place : curve) place.angle = 0.3f;
  EXPECT_EQ(Compare({Drawn(curve)}, contour).precision.share, 0);
}

TEST(CompareWithImage, WhatIsEverywhereIsChance) {
  std::vector<std::vector<Edge2d>> lines;
  for (double y = 0; y < 100; y += 2) lines.push_back(PlacesOnLine(0, 100, y));
  const ImageAgreement agreement =
      Compare({Drawn(PlacesOnLine(0, 100, 51))}, Join(lines));
  EXPECT_EQ(agreement.precision.share, 1);
  EXPECT_EQ(agreement.precision.chance, 1);
  EXPECT_EQ(agreement.precision.Lift(), 0);
}

TEST(CompareWithImage, OfContoursTheStrongestFifthIsLookedFor) {
  const std::vector<Edge2d> strong = PlacesOnLine(0, 100, 20, 30);
  const std::vector<Edge2d> weak =
      Join({PlacesOnLine(0, 200, 50, 10), PlacesOnLine(0, 200, 80, 10)});
  const std::vector<Edge2d> contours = Join({strong, weak});
  EXPECT_EQ(Compare({Drawn(strong)}, contours).strong_contours.share, 1);
  EXPECT_EQ(
      Compare({Drawn(PlacesOnLine(0, 50, 20))}, contours).strong_contours.share,
      0.51)
      << "one more pixel lies within two pixels of the end";
  EXPECT_LT(Compare({Drawn(weak)}, contours).strong_contours.share, 0.01);
}

TEST(CompareWithImage, ExpectedPlacesAreCountedApart) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  const ImageAgreement agreement = Compare(
      {Drawn(contour, true), Drawn(PlacesOnLine(0, 300, 70), false)}, contour);
  EXPECT_EQ(agreement.precision.share, 0.25);
  EXPECT_EQ(agreement.expected_precision->share, 1);
}

TEST(CompareWithImage, StepsCountNotPlaces) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  DrawnCurve wrong = Drawn(PlacesOnLine(0, 100, 70));
  for (DrawnPlace& place : wrong) place.num_steps = 0.25;
  EXPECT_EQ(Compare({Drawn(contour), wrong}, contour).precision.share, 0.8);
}

TEST(CompareWithImage, NothingHasNoShares) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  EXPECT_EQ(Compare({}, contour, contour).precision.share, 0);
  EXPECT_EQ(Compare({}, contour, contour).long_lines.share, 0);
  EXPECT_EQ(Compare({}, contour, contour).median_piece_px, 0);
  EXPECT_EQ(Compare({Drawn(contour)}, {}).precision.share, 0);
  EXPECT_EQ(Compare({Drawn(contour)}, {}).strong_contours.share, 0);
}

TEST(ImageTally, AddsUpOverImages) {
  const std::vector<Edge2d> contour = PlacesOnLine(0, 100, 50);
  ImageTally total = CompareWithImage({Drawn(contour)}, contour, {});
  total.Add(CompareWithImage({Drawn(PlacesOnLine(0, 300, 70))}, contour, {}));
  EXPECT_EQ(total.Summarize().precision.share, 0.25);
  EXPECT_EQ(total.Summarize().strong_contours.share, 0.5);
  EXPECT_EQ(total.pieces_px, (std::vector<double>{100, 300}));
}

}  // namespace
}  // namespace curvix
