// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/undistort_edges.h"

#include <curvix/scene.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/angles.h"

namespace curvix {
namespace {

const Camera kSimpleRadial{
    CameraModel::kSimpleRadial, 640, 480, {600, 320, 240, -0.15}};
const Camera kOpenCV{CameraModel::kOpenCV,
                     640,
                     480,
                     {600, 620, 325, 236, -0.12, 0.03, 0.001, -0.002}};

// Ideal pixel to image pixel.
Eigen::Vector2d Distort(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d direction =
      PinholeCalibration(camera).inverse() * pixel.homogeneous();
  return ImageFromIdeal(camera, direction.hnormalized());
}

std::vector<Edge2d> IdealEdges() {
  std::vector<Edge2d> edges;
  for (int i = 0; i < 60; ++i) {
    Edge2d edge;
    edge.position = {40.0 + 9.3 * i, 30.0 + (i * 37) % 400};
    edge.angle = static_cast<float>(WrapDirected(0.7 * i));
    edge.strength = static_cast<float>(i + 1);
    edges.push_back(edge);
  }
  return edges;
}

TEST(UndistortEdges, UndoesTheDistortionOfPlaceAndDirectedTangent) {
  for (const Camera& camera : {kSimpleRadial, kOpenCV}) {
    const std::vector<Edge2d> ideal = IdealEdges();
    EdgeMap distorted;
    distorted.noise = 1.5;
    for (const Edge2d& edge : ideal) {
      const double h = 1e-4;
      const Eigen::Vector2d tangent(std::cos(edge.angle), std::sin(edge.angle));
      const Eigen::Vector2d step =
          Distort(camera, edge.position + h * tangent) -
          Distort(camera, edge.position - h * tangent);
      Edge2d seen = edge;
      seen.position = Distort(camera, edge.position);
      seen.angle = static_cast<float>(std::atan2(step.y(), step.x()));
      distorted.edges.push_back(seen);
    }
    distorted.neighbors.resize(ideal.size());
    const EdgeMap undistorted = UndistortEdges(distorted, camera);
    EXPECT_EQ(undistorted.noise, 1.5);
    ASSERT_EQ(undistorted.edges.size(), ideal.size());
    double largest_move = 0;
    for (std::size_t i = 0; i < ideal.size(); ++i) {
      const Edge2d& edge = undistorted.edges[i];
      EXPECT_LT((edge.position - ideal[i].position).norm(), 1e-5);
      EXPECT_NEAR(WrapDirected(edge.angle - ideal[i].angle), 0, 1e-5);
      EXPECT_EQ(edge.strength, ideal[i].strength);
      largest_move =
          std::max(largest_move,
                   (distorted.edges[i].position - ideal[i].position).norm());
    }
    EXPECT_GT(largest_move, 5) << "a distortion worth the name";
  }
}

// The finer scale's place goes through the lens, too.
TEST(UndistortEdges, OffsetsOfTheFinerScaleGrowWithTheImage) {
  const Camera fisheye{
      CameraModel::kOpenCVFisheye, 640, 480, {300, 300, 320, 240, 0, 0, 0, 0}};
  Edge2d edge;
  edge.position = {560, 240};  // 0.8 from the axis
  edge.fine_px = Eigen::half(0.5F);
  EdgeMap map;
  map.neighbors.resize(1);
  // Across the radius, tan(0.8) / 0.8 as large; along it, 1 / cos^2(0.8).
  for (const auto& [angle, growth] :
       {std::pair(0.0, std::tan(0.8) / 0.8),
        {-kPi / 2, 1 / (std::cos(0.8) * std::cos(0.8))}}) {
    edge.angle = static_cast<float>(angle);
    map.edges = {edge};
    const Edge2d ideal = UndistortEdges(map, fisheye).edges.at(0);
    EXPECT_NEAR(static_cast<double>(ideal.fine_px), 0.5 * growth, 0.01);
  }
}

TEST(UndistortEdges, LeavesPinholesAlone) {
  const Camera pinhole{CameraModel::kPinhole, 640, 480, {600, 610, 320, 240}};
  EdgeMap map;
  map.edges = IdealEdges();
  map.neighbors.resize(map.edges.size());
  map.neighbors[3].next = 4;
  const EdgeMap result = UndistortEdges(map, pinhole);
  ASSERT_EQ(result.edges.size(), map.edges.size());
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    EXPECT_EQ(result.edges[i].position, map.edges[i].position);
    EXPECT_EQ(result.edges[i].angle, map.edges[i].angle);
  }
  EXPECT_EQ(result.neighbors[3].next, 4);
}

TEST(UndistortEdges, DropsWhatHasNoIdealPlaceAndRenumbersLinks) {
  // r - 0.5 r^3 never exceeds 0.544: edges further out are not invertible.
  const Camera strong{
      CameraModel::kSimpleRadial, 640, 480, {300, 320, 240, -0.5}};
  EdgeMap map;
  for (const double x : {325.0, 5.0, 330.0, 335.0}) {
    Edge2d edge;
    edge.position = {x, 240.0};
    map.edges.push_back(edge);
  }
  map.neighbors = {{std::nullopt, 1}, {0, 2}, {1, 3}, {2, std::nullopt}};
  map.num_dropped_isolated = 7;
  map.num_dropped_over_limit = 9;
  map.num_dropped_masked = 11;
  const EdgeMap result = UndistortEdges(map, strong);
  EXPECT_EQ(result.num_dropped_isolated, 7);
  EXPECT_EQ(result.num_dropped_over_limit, 9);
  EXPECT_EQ(result.num_dropped_masked, 11);
  ASSERT_EQ(result.edges.size(), 3u);
  ASSERT_EQ(result.neighbors.size(), 3u);
  EXPECT_EQ(result.neighbors[0].next, std::nullopt);
  EXPECT_EQ(result.neighbors[1].previous, std::nullopt);
  EXPECT_EQ(result.neighbors[1].next, 2);
  EXPECT_EQ(result.neighbors[2].previous, 1);
}

TEST(FindUnseenCells, APinholeSeesAllOfItsImage) {
  const UnseenCells unseen = FindUnseenCells(
      {CameraModel::kPinhole, 100, 80, {100, 100, 50, 40}}, std::nullopt);
  EXPECT_TRUE(unseen.cells.empty());
  EXPECT_FALSE(unseen.Contain({50, 40}));
}

TEST(FindUnseenCells, HasTheCellsThatTheMaskTouches) {
  GrayImage mask{96, 80, std::vector<float>(96 * 80, 255)};
  for (std::size_t y = 20; y < 30; ++y) {
    for (std::size_t x = 41; x < 50; ++x) mask.pixels[96 * y + x] = 0;
  }
  const UnseenCells unseen = FindUnseenCells(
      {CameraModel::kPinhole, 96, 80, {100, 100, 48, 40}}, mask);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) {
      const bool is_inside = y >= 16 && y < 32 && x >= 40 && x < 56;
      EXPECT_EQ(unseen.Contain({x + 0.5, y + 0.5}), is_inside) << x << " " << y;
    }
  }
}

// A cell of which a part is outside the photograph may count as outside.
TEST(FindUnseenCells, IsWhatALensLeavesOutOfTheIdealImage) {
  for (const Camera& camera : {kSimpleRadial, kOpenCV}) {
    const UnseenCells unseen = FindUnseenCells(camera, std::nullopt);
    int num_inside = 0;
    int num_unseen_inside = 0;
    for (int y = -100; y < 580; y += 3) {
      for (int x = -100; x < 740; x += 3) {
        const Eigen::Vector2d pixel(x, y);
        if (x < -unseen.margin_px || y < -unseen.margin_px ||
            x >= 640 + unseen.margin_px || y >= 480 + unseen.margin_px) {
          continue;
        }
        const Eigen::Vector2d in_image = Distort(camera, pixel);
        const double inside = std::min({in_image.x(),
                                        in_image.y(),
                                        camera.width - in_image.x(),
                                        camera.height - in_image.y()});
        if (inside < -8) {
          EXPECT_TRUE(unseen.Contain(pixel)) << pixel.transpose();
        } else if (inside > 16) {
          EXPECT_FALSE(unseen.Contain(pixel)) << pixel.transpose();
        }
        num_inside += inside > 0;
        num_unseen_inside += inside > 0 && unseen.Contain(pixel);
      }
    }
    EXPECT_LT(num_unseen_inside, 0.05 * num_inside);
  }
}

// The distortion of this lens folds over 52 degrees off the axis: the ray at
// u = 1.9 leads to a pixel that shows another.
TEST(FindUnseenCells, IsWhatLiesBeyondAFold) {
  const Camera camera = {
      CameraModel::kSimpleRadial, 1400, 1050, {1000, 700, 525, -0.2}};
  ASSERT_LT(ImageFromIdeal(camera, {1.9, 0}).x(), 1400);
  const UnseenCells unseen = FindUnseenCells(camera, std::nullopt);
  EXPECT_TRUE(unseen.Contain({2600, 525}));
  EXPECT_FALSE(unseen.Contain({1100, 525}));
}

}  // namespace
}  // namespace curvix
