// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/third_order_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/edge_detection/oriented_edges.h"
#include "tests/edge_detection/rendered_images.h"

namespace curvix {
namespace {

// Away from the border, where the continued image is not the true one.
std::vector<Edge2d> Detect(const GrayImage& image,
                           double min_gradient = 1,
                           const DetectionScale& scale = {}) {
  return WithoutBorder(OrientedEdges(image, scale, min_gradient), image, 8);
}

class ThirdOrderEdgesAtScale : public ::testing::TestWithParam<DetectionScale> {
};

INSTANTIATE_TEST_SUITE_P(Scales,
                         ThirdOrderEdgesAtScale,
                         ::testing::Values(DetectionScale{1, 2},
                                           DetectionScale{1.5, 1}));

Eigen::Vector2d BrightSide(const Edge2d& edge) {
  return {-std::sin(edge.angle), std::cos(edge.angle)};
}

TEST_P(ThirdOrderEdgesAtScale, LandsOnTheLineAndKeepsItsTangent) {
  for (int degrees = -180; degrees < 180; degrees += 7) {
    for (const double shift : {0.0, 0.13, 0.25, 0.5, 0.77}) {
      const double angle = DegToRad(degrees);
      const Eigen::Vector2d point(32 + shift, 32 - 0.3 * shift);
      const std::vector<Edge2d> edges =
          Detect(RenderLine(64, point, angle), 1, GetParam());
      ASSERT_GT(edges.size(), 40u) << degrees << " deg";
      const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
      for (const Edge2d& edge : edges) {
        EXPECT_LT(std::abs(normal.dot(edge.position - point)), 0.01)
            << degrees << " deg, shift " << shift;
        EXPECT_LT(RadToDeg(std::abs(WrapDirected(edge.angle - angle))), 0.1)
            << degrees << " deg, shift " << shift;
      }
    }
  }
}

TEST(ThirdOrderEdges, MeasuresTheGradient) {
  const double angle = DegToRad(20);
  const double blur = std::hypot(1.0, kRenderedBlurPx);
  const double expected = (kBright - kDark) / (std::sqrt(2 * kPi) * blur);
  for (const Edge2d& edge : Detect(RenderLine(64, {31.9, 32.2}, angle))) {
    EXPECT_NEAR(edge.strength, expected, 0.01 * expected);
  }
}

TEST_P(ThirdOrderEdgesAtScale, FollowsACircleAllTheWayRound) {
  const Eigen::Vector2d center(64.3, 63.8);
  const double radius = 45;
  const std::vector<Edge2d> edges =
      Detect(RenderDisc(128, center, radius), 1, GetParam());
  std::vector<double> bearings;
  // Blur moves the steepest place of a curved edge inwards by
  // blur^2 / (2 radius).
  const double blur = std::hypot(GetParam().sigma_px, kRenderedBlurPx);
  const double inwards = blur * blur / (2 * radius);
  for (const Edge2d& edge : edges) {
    const Eigen::Vector2d ray = edge.position - center;
    EXPECT_NEAR(ray.norm(), radius - inwards, 0.015);
    const double sine = ray.normalized().dot(BrightSide(edge));
    EXPECT_LT(sine, 0) << "the disc is bright inside";
    EXPECT_LT(RadToDeg(std::acos(std::min(1.0, -sine))), 0.1);
    bearings.push_back(std::atan2(ray.y(), ray.x()));
  }
  std::sort(bearings.begin(), bearings.end());
  ASSERT_GT(bearings.size(), 250u);
  for (std::size_t i = 1; i < bearings.size(); ++i) {
    EXPECT_LT((bearings[i] - bearings[i - 1]) * radius,
              2 * GetParam().spacing_px())
        << "a gap";
  }
}

// 90 degrees from +x towards +y.
GrayImage Rotated(const GrayImage& image) {
  GrayImage rotated{image.height, image.width, {}};
  for (int y = 0; y < rotated.height; ++y) {
    for (int x = 0; x < rotated.width; ++x) {
      rotated.pixels.push_back(image.at(y, image.height - 1 - x));
    }
  }
  return rotated;
}

TEST(ThirdOrderEdges, RotatesWithTheImage) {
  GrayImage image = RenderDisc(60, {33.2, 28.7}, 14.6);
  AddNoise(5, 1, image);
  const std::vector<Edge2d> edges = Detect(image, 3);
  const std::vector<Edge2d> rotated = Detect(Rotated(image), 3);
  ASSERT_GT(edges.size(), 100u);
  ASSERT_EQ(edges.size(), rotated.size());
  for (const Edge2d& edge : edges) {
    const Eigen::Vector2d expected(image.height - edge.position.y(),
                                   edge.position.x());
    const auto match =
        std::find_if(rotated.begin(), rotated.end(), [&](const Edge2d& other) {
          return (other.position - expected).norm() < 1e-4;
        });
    ASSERT_NE(match, rotated.end());
    EXPECT_NEAR(WrapDirected(match->angle - edge.angle - kPi / 2), 0, 1e-3);
    EXPECT_NEAR(match->strength, edge.strength, 1e-3);
  }
}

TEST(ThirdOrderEdges, GoesRowByRowAndStaysOffTheBorder) {
  const std::vector<Edge2d> edges =
      OrientedEdges(RenderLine(64, {32, 32}, 1.0), {}, 1);
  ASSERT_FALSE(edges.empty());
  EXPECT_LT(edges.front().position.y(), 5) << "no further off than it must";
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_GE(edges[i].position.minCoeff(), 4);
    EXPECT_LE(edges[i].position.maxCoeff(), 60);
    if (i > 0) {
      // Positions move by at most sqrt(2) half pixels from their grid row.
      EXPECT_GT(edges[i].position.y(), edges[i - 1].position.y() - 1.5);
    }
  }
}

TEST(ThirdOrderEdges, ThresholdsTheGradient) {
  const GrayImage image = RenderLine(64, {32, 32}, 0.3);
  EXPECT_FALSE(Detect(image, 25).empty());
  EXPECT_TRUE(Detect(image, 35).empty());
}

// Where the image is flat, nothing is computed; with 0 nothing is flat.
TEST(LocateEdges, ThresholdOnlyLeavesOutWeakerEdges) {
  GrayImage image = RenderDisc(200, {133.2, 128.7}, 44.6);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      image.pixels[static_cast<std::size_t>(200 * y + x)] +=
          static_cast<float>((x * x + 3 * y) % 7) * static_cast<float>(y) / 30;
    }
  }
  for (const DetectionScale& scale :
       {DetectionScale{1, 2}, DetectionScale{1.5, 1}}) {
    const std::vector<LocatedEdge> all = LocateEdges(image, scale, 0);
    for (const double min_gradient : {0.3, 1.0, 5.0, 20.0}) {
      std::vector<LocatedEdge> expected;
      for (const LocatedEdge& edge : all) {
        if (edge.strength() > min_gradient) expected.push_back(edge);
      }
      const auto edges = LocateEdges(image, scale, min_gradient);
      ASSERT_GT(edges.size(), 50u);
      ASSERT_EQ(edges.size(), expected.size()) << min_gradient;
      for (std::size_t i = 0; i < edges.size(); ++i) {
        EXPECT_EQ(edges[i].position, expected[i].position);
      }
    }
  }
}

TEST(ThirdOrderEdges, FindsNothingInBlankImages) {
  for (const float grey : {0.0f, 77.3f, 255.0f}) {
    const GrayImage blank{40, 30, std::vector<float>(1200, grey)};
    EXPECT_TRUE(OrientedEdges(blank, {}, 0.001).empty());
  }
}

TEST(ThirdOrderEdges, SurvivesTinyImages) {
  // Below 8 px, all is border.
  for (int width = 0; width <= 12; ++width) {
    for (int height = 0; height <= 12; ++height) {
      GrayImage image{width, height, {}};
      for (int i = 0; i < width * height; ++i) {
        image.pixels.push_back(static_cast<float>(50 * (i % 3)));
      }
      const std::vector<Edge2d> edges = OrientedEdges(image, {}, 1);
      if (width < 8 || height < 8) {
        EXPECT_TRUE(edges.empty());
      }
      if (width == 12 && height == 12) {
        EXPECT_FALSE(edges.empty());
      }
      for (const Edge2d& edge : edges) EXPECT_TRUE(edge.position.allFinite());
    }
  }
}

TEST(ThirdOrderEdges, TurnsAtACornerWithoutLosingIt) {
  const GrayImage corner =
      RenderStep(64, 64, [](const Eigen::Vector2d& p) -> double {
        return std::min(p.x() - 30.2, p.y() - 33.4);
      });
  const std::vector<Edge2d> edges = Detect(corner);
  int along_x = 0, along_y = 0;
  for (const Edge2d& edge : edges) {
    EXPECT_TRUE(std::isfinite(edge.angle));
    if ((edge.position - Eigen::Vector2d(30.2, 33.4)).norm() < 4) continue;
    const bool horizontal = edge.position.x() > 33;
    const double across =
        horizontal ? edge.position.y() - 33.4 : edge.position.x() - 30.2;
    EXPECT_LT(std::abs(across), 0.02);
    ++(horizontal ? along_x : along_y);
  }
  EXPECT_GT(along_x, 30);
  EXPECT_GT(along_y, 30);
}

TEST(ThirdOrderEdges, WidensWithSigma) {
  const double angle = DegToRad(33);
  const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
  const auto edges = OrientedEdges(RenderLine(80, {40, 40}, angle), {2, 2}, 1);
  ASSERT_GT(edges.size(), 80u);
  for (const Edge2d& edge : edges) {
    EXPECT_LT(std::abs(normal.dot(edge.position - Eigen::Vector2d(40, 40))),
              0.02);
  }
}

// Those of hundreds of images are in memory at once.
TEST(Edge2d, TakesFortyBytes) { EXPECT_EQ(sizeof(Edge2d), 40u); }

}  // namespace
}  // namespace curvix
