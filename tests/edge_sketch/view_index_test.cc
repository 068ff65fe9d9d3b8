// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "geometry/nearest_edge.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;

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

// View 0 shows the left half of what view 1 from the same place shows; view 2
// stands elsewhere.
class QueryViews {
 public:
  QueryViews() {
    views_[0].width = 100;
    views_[1].width = 200;
    views_[2].width = 200;
    views_[2].center = {1, 0, 0};
    views_[2].translation = {-1, 0, 0};
    for (PosedView& view : views_) {
      view.height = 100;
      view.calibration << 100, 0, 100, 0, 100, 50, 0, 0, 1;
    }
    DistinctViews distinct = AllDistinct(Overlaps(views_.size()));
    distinct.before_at_station[1] = {0};
    indices_ = IndexViews(views_, maps_, distinct, 1);
  }

  // Those queried for an edge that view 1 sees at `x`, at depth 10.
  std::vector<int> At(double x) const {
    const SpaceEdge edge{{(x - 100) / 10, 0, 10}, Eigen::Vector3d::UnitY()};
    std::vector<int> queried;
    for (const int v : {0, 1, 2}) {
      if (ProjectIntoQueryView(v, edge, indices_)) queried.push_back(v);
    }
    return queried;
  }

  std::vector<ViewIndex>& indices() { return indices_; }

 private:
  std::vector<PosedView> views_ = std::vector<PosedView>(3);
  std::vector<EdgeMap> maps_ = std::vector<EdgeMap>(3);
  std::vector<ViewIndex> indices_;
};

TEST(ProjectIntoQueryView, OneViewOfAStationIsQueried) {
  const QueryViews views;
  EXPECT_THAT(views.At(50), ElementsAre(0, 2));
  EXPECT_THAT(views.At(150), ElementsAre(1, 2));
  EXPECT_THAT(views.At(5), ElementsAre(0)) << "view 2 does not see it";
}

TEST(ProjectIntoQueryView, RepeatedViewsAreNotQueried) {
  QueryViews views;
  views.indices()[2].is_repeated = true;
  EXPECT_THAT(views.At(150), ElementsAre(1));
}

TEST(NeighborsInDirection, AreOfTheFourNearestStations) {
  // Of view 0. Views 1, 4 and 6 are a station.
  Overlaps overlaps(8);
  for (int other = 1; other < 8; ++other) {
    overlaps[0].push_back({other, 1, DegToRad(10.0 * other)});
  }
  const NeighborsByView neighbors =
      NeighborsInDirection(overlaps, {0, 1, 2, 3, 1, 5, 1, 7});
  std::vector<int> of_view_0;
  for (const ViewNeighbor& neighbor : neighbors[0]) {
    of_view_0.push_back(neighbor.view_idx);
  }
  EXPECT_THAT(of_view_0, ElementsAre(1, 2, 3, 4, 5, 6));
}

}  // namespace
}  // namespace curvix
