// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "base/infinity.h"
#include "geometry/nearest_edge.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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
    for (EdgeMap& map : maps_) map.edges.resize(1);
    DistinctViews distinct = AllDistinct(Overlaps(views_.size()));
    distinct.before_at_station[1] = {0};
    indices_ = IndexViews(views_, maps_, distinct, 1);
  }

  // Those queried for an edge that view 1 sees at `x`, at depth 10.
  std::vector<int> At(double x, double pixel_size = kInfinity) const {
    const SpaceEdge edge{{(x - 100) / 10, 0, 10}, Eigen::Vector3d::UnitY()};
    std::vector<int> queried;
    for (const int v : {0, 1, 2}) {
      if (ProjectIntoQueryView(v, edge, pixel_size, indices_)) {
        queried.push_back(v);
      }
    }
    return queried;
  }

  std::vector<PosedView>& views() { return views_; }
  std::vector<EdgeMap>& maps() { return maps_; }
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

TEST(ProjectIntoQueryView, ViewsAreQueriedWhereTheyMayShowEdges) {
  QueryViews views;
  // View 2 is masked left of x = 80, and sees the edges 10 pixels left of
  // where view 1 does.
  UnseenCells& unseen = views.maps()[2].unseen;
  unseen.num_columns = 25;
  unseen.cells.resize(25 * 13);
  for (std::size_t i = 0; i < unseen.cells.size(); ++i) {
    unseen.cells[i] = i % 25 < 10;
  }
  EXPECT_THAT(views.At(89), ElementsAre(0));
  EXPECT_THAT(views.At(91), ElementsAre(0, 2));
  // What view 0 does not see, view 1 at the same place may.
  views.maps()[0].unseen = unseen;
  EXPECT_THAT(views.At(79), ElementsAre(1));
  views.maps()[1].edges.clear();
  EXPECT_THAT(views.At(150), ElementsAre(2));
}

TEST(ProjectIntoQueryView, MuchCoarserViewsAreNotQueried) {
  QueryViews views;
  EXPECT_THAT(views.At(150, 0.051), ElementsAre(1, 2)) << "twice as coarse";
  EXPECT_THAT(views.At(150, 0.049), IsEmpty());
  views.views()[1].calibration(0, 0) = views.views()[1].calibration(1, 1) = 50;
  EXPECT_THAT(views.At(150, 0.051), ElementsAre(2));
  // Nor does it stand in for another of its station.
  views.indices()[0].before_at_station = {1};
  views.indices()[1].before_at_station = {};
  EXPECT_THAT(views.At(90, 0.051), ElementsAre(0, 2));
}

TEST(TypicalPixelSize, IsThatOfTheFourViewsThatSeeAPlaceLargest) {
  std::vector<PosedView> views(6);
  std::vector<ViewIndex> indices(6);
  std::vector<EdgeRef> support;
  for (std::int32_t v = 0; v < 6; ++v) {
    const auto i = static_cast<std::size_t>(v);
    views[i].calibration(0, 0) = views[i].calibration(1, 1) = 10 * (6 - v);
    indices[i].view = &views[i];
    support.push_back({v, 0});
  }
  const Eigen::Vector3d place(0, 0, 60);
  EXPECT_DOUBLE_EQ(TypicalPixelSize(place, support, indices), 2);
  EXPECT_DOUBLE_EQ(TypicalPixelSize(place, {{1, 0}, {4, 0}}, indices), 3);
  EXPECT_EQ(TypicalPixelSize(place, {}, indices), kInfinity);
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
