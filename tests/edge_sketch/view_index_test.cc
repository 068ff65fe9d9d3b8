// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "geometry/nearest_edge.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

Edge2d EdgeAt(double x, double y, double degrees) {
  Edge2d edge;
  edge.position = {x, y};
  edge.angle = static_cast<float>(DegToRad(degrees));
  return edge;
}

std::optional<std::int32_t> Nearest(const std::vector<Edge2d>& edges,
                                    const Gate& gate) {
  return NearestEdge(GridIndex(edges, 4), {{50, 50}, {1, 0}}, gate);
}

const Gate kGate{1, 2, std::cos(DegToRad(15))};

TEST(NearestEdge, HasToBeInsideTheGate) {
  EXPECT_EQ(Nearest({EdgeAt(50, 50.9, 0)}, kGate), 0);
  EXPECT_EQ(Nearest({EdgeAt(50, 51.1, 0)}, kGate), std::nullopt);
  EXPECT_EQ(Nearest({EdgeAt(51.9, 50, 0)}, kGate), 0);
  EXPECT_EQ(Nearest({EdgeAt(52.1, 50, 0)}, kGate), std::nullopt);
  EXPECT_EQ(Nearest({EdgeAt(50, 50, 14.9)}, kGate), 0);
  EXPECT_EQ(Nearest({EdgeAt(50, 50, -165.1)}, kGate), 0);
  EXPECT_EQ(Nearest({EdgeAt(50, 50, 15.1)}, kGate), std::nullopt);
  EXPECT_EQ(Nearest({}, kGate), std::nullopt);
}

TEST(NearestEdge, CountsDistancesAlongTheTangentHalf) {
  EXPECT_EQ(Nearest({EdgeAt(50, 50.5, 0), EdgeAt(50.9, 50, 0)}, kGate), 1);
  EXPECT_EQ(Nearest({EdgeAt(50, 50.5, 0), EdgeAt(51.1, 50, 0)}, kGate), 0);
}

TEST(NearestEdge, IsTheFirstOfEquals) {
  EXPECT_EQ(Nearest({EdgeAt(70, 70, 0),
                     EdgeAt(50.5, 50, 0),
                     EdgeAt(49.5, 50, 0),
                     EdgeAt(50.5, 50, 0)},
                    kGate),
            1);
}

TEST(NearestEdge, AgreesWithLookingAtAllEdges) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Edge2d> edges;
    for (int i = 0; i < 100; ++i) {
      edges.push_back(EdgeAt(random.Uniform(45, 55),
                             random.Uniform(45, 55),
                             random.Uniform(-180, 180)));
    }
    std::optional<std::int32_t> expected;
    double least = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double angle = static_cast<double>(edges[i].angle);
      const Vector2d t(std::cos(angle), std::sin(angle));
      const Vector2d offset = edges[i].position - Vector2d(50, 50);
      const double along = std::abs(offset.dot(t));
      const double across = std::abs(offset.dot(Vector2d(-t.y(), t.x())));
      if (std::abs(t.x()) < kGate.min_cosine || across > kGate.normal_px ||
          along > kGate.tangential_px) {
        continue;
      }
      const double distance = std::hypot(across, along / 2);
      if (!expected || distance < least) {
        expected = static_cast<std::int32_t>(i);
        least = distance;
      }
    }
    EXPECT_EQ(Nearest(edges, kGate), expected);
  }
}

}  // namespace
}  // namespace curvix
