// SPDX-License-Identifier: BSD-3-Clause
#include "base/grid_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;
using ::testing::IsSupersetOf;

std::vector<Edge2d> RandomEdges(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Edge2d> edges(static_cast<std::size_t>(count));
  for (Edge2d& edge : edges) {
    edge.position = {random.Uniform(-20, 320), random.Uniform(10, 200)};
    edge.angle = static_cast<float>(random.Uniform(-3.1, 3.1));
  }
  return edges;
}

// `reach_px`: of a square or a rectangle.
template <typename Reach>
std::vector<std::int32_t> Visited(const GridIndex& index,
                                  const Eigen::Vector2d& center,
                                  const Reach& reach_px) {
  std::vector<std::int32_t> visited;
  index.VisitAround(center, reach_px, [&](const IndexedEdge& edge) {
    visited.push_back(edge.edge_idx);
  });
  return visited;
}

std::vector<std::int32_t> InsideSquare(const std::vector<Edge2d>& edges,
                                       const Eigen::Vector2d& center,
                                       double radius_px) {
  std::vector<std::int32_t> inside;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if ((edges[i].position - center).lpNorm<Eigen::Infinity>() <= radius_px) {
      inside.push_back(static_cast<std::int32_t>(i));
    }
  }
  return inside;
}

TEST(GridIndex, FindsEverythingInsideTheSquareAndNothingTwice) {
  const std::vector<Edge2d> edges = RandomEdges(2000, 1);
  Random random(2);
  for (const double cell_size_px : {0.7, 4.0, 50.0, 1000.0}) {
    const GridIndex index(edges, cell_size_px);
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Vector2d center(random.Uniform(-100, 400),
                                   random.Uniform(-100, 300));
      const double radius_px = random.Uniform(0, 30);
      std::vector<std::int32_t> visited = Visited(index, center, radius_px);
      std::sort(visited.begin(), visited.end());
      EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()),
                visited.end());
      EXPECT_THAT(visited,
                  IsSupersetOf(InsideSquare(edges, center, radius_px)));
    }
  }
}

TEST(GridIndex, VisitsOnlyTheBucketsAroundTheSquare) {
  const std::vector<Edge2d> edges = RandomEdges(5000, 3);
  const GridIndex index(edges, 4);
  for (const std::int32_t idx : Visited(index, {150, 100}, 6)) {
    const Edge2d& edge = edges[static_cast<std::size_t>(idx)];
    EXPECT_LE(
        (edge.position - Eigen::Vector2d(150, 100)).lpNorm<Eigen::Infinity>(),
        6 + 4);
  }
}

TEST(GridIndex, VisitsTheBucketsOfARectangle) {
  const std::vector<Edge2d> edges = RandomEdges(5000, 3);
  const Eigen::Vector2d center(150, 100), reach_px(20, 3);
  const std::vector<std::int32_t> visited =
      Visited(GridIndex(edges, 4), center, reach_px);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Array2d off = (edges[i].position - center).cwiseAbs();
    const bool is_visited =
        std::ranges::count(visited, static_cast<std::int32_t>(i)) == 1;
    if (is_visited) {
      EXPECT_TRUE((off <= reach_px.array() + 4).all());
    } else {
      EXPECT_TRUE((off > reach_px.array()).any());
    }
  }
}

TEST(GridIndex, VisitsRowByRowAndEachBucketInEdgeOrder) {
  std::vector<Edge2d> edges(6);
  edges[0].position = {15, 15};  // second row, second column
  edges[1].position = {1, 2};    // first row, first column
  edges[2].position = {12, 0};   // first row, second column
  edges[3].position = {0, 19};   // second row, first column
  edges[4].position = {2, 1};    // first row, first column
  edges[5].position = {19, 11};  // second row, second column
  EXPECT_THAT(Visited(GridIndex(edges, 10), {10, 10}, 20),
              ElementsAre(1, 4, 2, 3, 0, 5));
}

TEST(GridIndex, ClampsSquaresOutsideToTheNearestBuckets) {
  std::vector<Edge2d> edges(2);
  edges[0].position = {0, 0};
  edges[1].position = {35, 0};
  const GridIndex index(edges, 10);
  EXPECT_THAT(Visited(index, {-1e12, 5}, 1), ElementsAre(0));
  EXPECT_THAT(Visited(index, {1e12, 1e12}, 1), ElementsAre(1));
}

TEST(GridIndex, KeepsPlaceAndDirectionOfEachEdge) {
  const std::vector<Edge2d> edges = RandomEdges(100, 4);
  GridIndex(edges, 8).VisitAround({150, 100}, 1e3, [&](const IndexedEdge& e) {
    const Edge2d& edge = edges[static_cast<std::size_t>(e.edge_idx)];
    EXPECT_LT((e.position.cast<double>() - edge.position).norm(), 1e-4);
    EXPECT_NEAR(e.tangent.x(), std::cos(edge.angle), 1e-6);
    EXPECT_NEAR(e.tangent.y(), std::sin(edge.angle), 1e-6);
  });
}

TEST(GridIndex, HoldsNothingWithoutEdges) {
  EXPECT_THAT(Visited(GridIndex(), {0, 0}, 10), ElementsAre());
  EXPECT_THAT(Visited(GridIndex({}, 4), {0, 0}, 10), ElementsAre());
}

TEST(GridIndex, TakesEdgesFarApartWithoutABucketForEveryPlace) {
  std::vector<Edge2d> edges(3);
  edges[0].position = {-1e7, 3};
  edges[1].position = {2, -1e7};
  edges[2].position = {1e7, 1e7};
  const GridIndex index(edges, 1);
  EXPECT_THAT(Visited(index, {2, -1e7}, 1), ::testing::Contains(1));
}

TEST(GridIndex, RefusesCellsWithoutSize) {
  EXPECT_THROW(GridIndex({}, 0), std::logic_error);
}

TEST(GridIndex, ShowsEveryTwoNearEdgesToEachOtherOnce) {
  const std::vector<Edge2d> edges = RandomEdges(500, 3);
  for (const double cell_size_px : {0.7, 4.0, 50.0, 1000.0}) {
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    GridIndex(edges, cell_size_px)
        .VisitPairs([&](const IndexedEdge& edge,
                        const IndexedEdge* begin,
                        const IndexedEdge* end) {
          for (; begin != end; ++begin) {
            const auto pair = std::minmax(edge.edge_idx, begin->edge_idx);
            EXPECT_LT(pair.first, pair.second);
            EXPECT_TRUE(pairs.insert(pair).second) << "met before";
          }
        });
    for (std::int32_t i = 0; i < 500; ++i) {
      const Eigen::Vector2d& center =
          edges[static_cast<std::size_t>(i)].position;
      for (const std::int32_t j : InsideSquare(edges, center, cell_size_px)) {
        if (i < j) {
          EXPECT_EQ(pairs.count({i, j}), 1u) << cell_size_px;
        }
      }
    }
  }
  GridIndex().VisitPairs([](auto&&...) { FAIL() << "there are no edges"; });
}

}  // namespace
}  // namespace curvix
